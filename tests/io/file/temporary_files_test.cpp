#include "io/file/temporary_files.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <optional>

#include "io/file/atomic_file.h"

namespace pdc::detail {
namespace {

namespace fs = std::filesystem;

class TemporaryFiles : public ::testing::Test {
 protected:
  void SetUp() override { fs::create_directories(mFolder); }
  void TearDown() override { fs::remove_all(mFolder); }
  void make(const fs::path& path) const { std::ofstream(path) << "content"; }

  fs::path mFolder = fs::path(::testing::TempDir()) / "pdc_temporary_files_test";
  fs::path mFile = mFolder / "file";
};

TEST_F(TemporaryFiles, AreRemovedWhileTheirEntryLives) {
  make(mFile);
  std::optional<TemporaryFileEntry> entry(mFile);
  removeTemporaryFiles();
  EXPECT_FALSE(fs::exists(mFile));
  make(mFile);
  entry.reset();
  removeTemporaryFiles();
  EXPECT_TRUE(fs::exists(mFile));
}

TEST_F(TemporaryFiles, MoreThanThereAreSlotsForDoNoHarm) {
  constexpr int kMany = 100;
  std::optional<TemporaryFileEntry> entries[kMany];
  for (auto& entry : entries) entry.emplace(mFile);
  removeTemporaryFiles();
  for (auto& entry : entries) entry.reset();
  make(mFile);
  const TemporaryFileEntry entry(mFile);
  removeTemporaryFiles();
  EXPECT_FALSE(fs::exists(mFile));
}

TEST_F(TemporaryFiles, AnAtomicFileIsOneUntilItIsCommitted) {
  AtomicFile unfinished(mFile);
  unfinished.write("abc", 3);
  ASSERT_FALSE(fs::is_empty(mFolder));
  removeTemporaryFiles();
  EXPECT_TRUE(fs::is_empty(mFolder));

  AtomicFile finished(mFolder / "finished");
  finished.write("abc", 3);
  finished.commit();
  removeTemporaryFiles();
  EXPECT_TRUE(fs::exists(mFolder / "finished"));
}

}  // namespace
}  // namespace pdc::detail
