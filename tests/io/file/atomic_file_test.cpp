#include "io/file/atomic_file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <string>
#include <thread>

#include "io/file/temporary_folder.h"
#include "pdc/error.h"

namespace pdc::detail {
namespace {

namespace fs = std::filesystem;

void writeText(const fs::path& path, std::string_view text) {
  AtomicFile file(path);
  file.write(text.data(), text.size());
  file.commit();
}

/// The message of the Error that `action` throws; empty if it throws none.
template <typename Action>
std::string errorOf(Action&& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

mode_t permissionsOf(const fs::path& path) { return static_cast<mode_t>(fs::status(path).permissions()); }

TEST(AtomicFile, AppearsOnlyWhenCommitted) {
  const TemporaryFolder folder;
  {
    AtomicFile file(folder / "a");
    file.write("hello ", 6);
    file.write("world", 5);
    EXPECT_FALSE(fs::exists(folder / "a"));
    EXPECT_EQ(file.bytesWritten(), 11u);
    file.commit();
    EXPECT_EQ(contentsOf(folder / "a"), "hello world");
  }
  EXPECT_EQ(folder.entries(), 1u);
}

TEST(AtomicFile, LeavesNothingWithoutCommit) {
  const TemporaryFolder folder;
  {
    AtomicFile file(folder / "a");
    file.write("hello", 5);
    EXPECT_EQ(folder.entries(), 1u);
  }
  EXPECT_EQ(folder.entries(), 0u);
}

TEST(AtomicFile, ReplacesAndKeepsPermissions) {
  const TemporaryFolder folder;
  writeContents(folder / "a", "old");
  fs::permissions(folder / "a", fs::perms(0640));
  writeText(folder / "a", "new");
  EXPECT_EQ(contentsOf(folder / "a"), "new");
  EXPECT_EQ(permissionsOf(folder / "a"), 0640u);
}

TEST(AtomicFile, NewFileFollowsTheUmask) {
  const TemporaryFolder folder;
  const mode_t before = ::umask(027);
  writeText(folder / "a", "new");
  ::umask(before);
  EXPECT_EQ(permissionsOf(folder / "a"), 0640u);
}

TEST(AtomicFile, FollowsLinks) {
  const TemporaryFolder folder;
  fs::create_directory(folder / "sub");
  writeContents(folder / "sub/target", "old");
  fs::create_symlink("sub/target", folder / "link");
  fs::create_symlink(folder / "link", folder / "link_to_link");
  writeText(folder / "link_to_link", "new");
  EXPECT_TRUE(fs::is_symlink(folder / "link"));
  EXPECT_TRUE(fs::is_symlink(folder / "link_to_link"));
  EXPECT_EQ(contentsOf(folder / "sub/target"), "new");
}

TEST(AtomicFile, MakesTheFileThatALinkMisses) {
  const TemporaryFolder folder;
  fs::create_symlink("target", folder / "link");
  writeText(folder / "link", "new");
  EXPECT_TRUE(fs::is_symlink(folder / "link"));
  EXPECT_EQ(contentsOf(folder / "target"), "new");
}

TEST(AtomicFile, LinkToItselfIsAnError) {
  const TemporaryFolder folder;
  fs::create_symlink("link", folder / "link");
  EXPECT_NE(errorOf([&] { AtomicFile file(folder / "link"); }).find("symbolic links"), std::string::npos);
}

TEST(AtomicFile, RelativePathWithoutFolder) {
  const TemporaryFolder folder;
  const fs::path before = fs::current_path();
  fs::current_path(folder.path());
  writeText("a", "new");
  fs::current_path(before);
  EXPECT_EQ(contentsOf(folder / "a"), "new");
}

TEST(AtomicFile, FolderAsTargetIsAnError) {
  const TemporaryFolder folder;
  EXPECT_EQ(errorOf([&] { AtomicFile file(folder.path()); }),
            folder.path().string() + ": cannot be written: Is a directory");
}

TEST(AtomicFile, MissingFolderIsAnError) {
  const TemporaryFolder folder;
  const fs::path path = folder / "missing/a";
  EXPECT_EQ(errorOf([&] { AtomicFile file(path); }),
            path.string() + ": folder " + (folder / "missing").string() + ": No such file or directory");
}

TEST(AtomicFile, EmptyPathIsAnError) {
  EXPECT_NE(errorOf([] { AtomicFile file(""); }), "");
}

TEST(AtomicFile, ReadOnlyFolderAndFileAreErrors) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
  const TemporaryFolder folder;
  writeContents(folder / "a", "old");
  fs::permissions(folder / "a", fs::perms(0444));
  EXPECT_NE(errorOf([&] { AtomicFile file(folder / "a"); }).find("Permission denied"), std::string::npos);
  fs::permissions(folder.path(), fs::perms(0555));
  EXPECT_NE(errorOf([&] { AtomicFile file(folder / "b"); }).find("Permission denied"), std::string::npos);
  EXPECT_EQ(contentsOf(folder / "a"), "old");
}

TEST(AtomicFile, FullDeviceIsAnError) {
  EXPECT_EQ(errorOf([] { writeText("/dev/full", "new"); }), "/dev/full: cannot be written: No space left on device");
}

TEST(AtomicFile, DeviceIsWrittenDirectly) {
  writeText("/dev/null", "new");
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST(AtomicFile, PipeIsWrittenDirectly) {
  const TemporaryFolder folder;
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  std::string received;
  std::thread reader([&] { received = contentsOf(folder / "pipe"); });
  writeText(folder / "pipe", "through the pipe");
  reader.join();
  EXPECT_EQ(received, "through the pipe");
  EXPECT_TRUE(fs::is_fifo(folder / "pipe"));
}

/// Lowers the size that files of this process may have, which makes write() fail halfway.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : mHandler(std::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &mBefore);
    const rlimit limit{bytes, mBefore.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    ::setrlimit(RLIMIT_FSIZE, &mBefore);
    std::signal(SIGXFSZ, mHandler);
  }

 private:
  rlimit mBefore{};
  void (*mHandler)(int);
};

TEST(AtomicFile, FailureHalfwayKeepsWhatWasThere) {
  const TemporaryFolder folder;
  writeContents(folder / "a", "old");
  const std::string large(1 << 20, 'x');
  std::string error;
  {
    const FileSizeLimit limit(1 << 16);
    error = errorOf([&] { writeText(folder / "a", large); });
  }
  EXPECT_EQ(error, (folder / "a").string() + ": cannot be written: File too large");
  EXPECT_EQ(contentsOf(folder / "a"), "old");
  EXPECT_EQ(folder.entries(), 1u);
}

TEST(AtomicFile, ManyAtOnceDoNotMeet) {
  const TemporaryFolder folder;
  AtomicFile a(folder / "x"), b(folder / "x"), c(folder / "y");
  a.write("a", 1);
  b.write("b", 1);
  c.write("c", 1);
  a.commit();
  c.commit();
  b.commit();
  EXPECT_EQ(contentsOf(folder / "x"), "b");
  EXPECT_EQ(contentsOf(folder / "y"), "c");
  EXPECT_EQ(folder.entries(), 2u);
}

TEST(CheckWritable, SaysTheSameAndMakesNothing) {
  const TemporaryFolder folder;
  EXPECT_EQ(errorOf([&] { checkWritable(folder / "a"); }), "");
  EXPECT_NE(errorOf([&] { checkWritable(folder / "missing/a"); }), "");
  EXPECT_NE(errorOf([&] { checkWritable(folder.path()); }), "");
  EXPECT_EQ(folder.entries(), 0u);
}

}  // namespace
}  // namespace pdc::detail
