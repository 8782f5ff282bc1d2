#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "folders.h"
#include "fuzz/forked.h"
#include "fuzz/mutate.h"
#include "fuzz/targets.h"
#include "io/file/temporary_folder.h"

namespace pdc {
namespace {

namespace fs = std::filesystem;

TEST(SceneFlips, DamagedScenesGiveASoundMeshOrAnError) {
  std::vector<fs::path> scenes;
  for (const auto& entry : fs::directory_iterator(test::sourceFolder() / "scenes"))
    if (entry.path().extension() == ".yaml") scenes.push_back(entry.path());
  std::sort(scenes.begin(), scenes.end());
  ASSERT_FALSE(scenes.empty());

  constexpr std::size_t kAttempts = 400, kPerChild = 50;
  const ForkedResult result = runForked(kAttempts, kPerChild, [&](std::size_t i) {
    fuzzScene(mutate(contentsOf(scenes[i % scenes.size()]), static_cast<std::uint32_t>(i)));
  });
  EXPECT_EQ(result.failure, "");
  EXPECT_EQ(result.successes + result.errors, kAttempts);
  EXPECT_GT(result.successes, kAttempts / 20) << "numbers may change";
  EXPECT_GT(result.errors, kAttempts / 4);
}

}  // namespace
}  // namespace pdc
