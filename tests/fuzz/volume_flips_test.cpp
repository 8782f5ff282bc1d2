#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "fuzz/forked.h"
#include "fuzz/mutate.h"
#include "fuzz/targets.h"
#include "io/volume/test_volumes.h"

namespace pdc {
namespace {

TEST(VolumeFlips, DamagedFilesGiveASoundMeshOrAnError) {
  constexpr int kSide = 10;
  const auto files = ballFiles(kSide);
  const ForkedResult whole = runForked(files.size(), files.size(), [&](std::size_t i) { fuzzVolume(files[i].second); });
  ASSERT_EQ(whole.successes, files.size()) << whole.failure;

  constexpr std::size_t kAttempts = 2000, kPerChild = 250;
  const ForkedResult result = runForked(kAttempts, kPerChild, [&](std::size_t i) {
    fuzzVolume(mutate(files[i % files.size()].second, static_cast<std::uint32_t>(i)));
  });
  EXPECT_EQ(result.failure, "");
  EXPECT_EQ(result.successes + result.errors, kAttempts);
  EXPECT_GT(result.successes, kAttempts / 20);
  EXPECT_GT(result.errors, kAttempts / 4);
}

}  // namespace
}  // namespace pdc
