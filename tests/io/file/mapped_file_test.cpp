#include "io/file/mapped_file.h"

#include <gtest/gtest.h>

#include <string>

#include "io/file/temporary_folder.h"
#include "pdc/error.h"

namespace pdc::detail {
namespace {

TEST(MappedFile, HoldsTheBytesAndForgetsWhatWasWritten) {
  const TemporaryFolder folder;
  const std::string content(100'000, 'a');
  writeContents(folder / "file", content);
  const MappedFile file(folder / "file");
  ASSERT_EQ(file.bytes().size(), content.size());
  for (char& c : file.bytes()) c = 'b';
  file.forget(10, 90'000);
  EXPECT_EQ(file.bytes()[0], 'b') << "shares a page with what is kept";
  EXPECT_EQ(file.bytes()[70'000], 'a');
  EXPECT_EQ(file.bytes()[99'999], 'b');
  EXPECT_EQ(contentsOf(folder / "file"), content);
}

TEST(MappedFile, RefusesWhatIsNoFile) {
  const TemporaryFolder folder;
  writeContents(folder / "empty", "");
  for (const char* name : {"none", "empty", "."}) EXPECT_THROW(MappedFile(folder / name), Error) << name;
}

}  // namespace
}  // namespace pdc::detail
