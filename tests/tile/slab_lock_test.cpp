#include "tile/slab_lock.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>

#include "io/file/temporary_folder.h"
#include "pdc/error.h"

namespace pdc::detail {
namespace {

/// A process that holds a lock until it is killed.
class Holder {
 public:
  explicit Holder(const std::filesystem::path& path) {
    int ready[2];
    EXPECT_EQ(::pipe(ready), 0);
    mProcess = ::fork();
    if (mProcess == 0) {
      const std::optional<SlabLock> lock = SlabLock::take(path);
      const char answer = lock ? 'y' : 'n';
      (void)!::write(ready[1], &answer, 1);
      for (;;) ::pause();
    }
    char answer = 0;
    EXPECT_EQ(::read(ready[0], &answer, 1), 1);
    EXPECT_EQ(answer, 'y');
    ::close(ready[0]);
    ::close(ready[1]);
  }
  ~Holder() { kill(); }
  void kill() {
    if (mProcess <= 0) return;
    ::kill(mProcess, SIGKILL);
    ::waitpid(mProcess, nullptr, 0);
    mProcess = -1;
  }

 private:
  pid_t mProcess;
};

TEST(SlabLock, OneProcessHoldsItAndTheSystemTakesItFromTheDead) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder / "slab.lock";
  EXPECT_EQ(SlabLock::holder(path), "");
  Holder other(path);
  EXPECT_NE(SlabLock::holder(path).find("process"), std::string::npos);
  EXPECT_FALSE(SlabLock::take(path));
  other.kill();
  EXPECT_EQ(SlabLock::holder(path), "");
  {
    const std::optional<SlabLock> lock = SlabLock::take(path);
    EXPECT_TRUE(lock);
    EXPECT_TRUE(std::filesystem::exists(path));
  }
  EXPECT_FALSE(std::filesystem::exists(path));
}

TEST(SlabLock, AFolderThatIsNotThereIsAnError) { EXPECT_THROW((void)SlabLock::take("/nowhere/slab.lock"), Error); }

}  // namespace
}  // namespace pdc::detail
