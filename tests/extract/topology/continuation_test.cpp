#include "extract/topology/continuation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <stdexcept>

#include "extract/sign_source.h"
#include "pdc/extract/contour.h"
#include "pdc/field/primitives.h"
#include "pdc/sample/implicit/field_source.h"
#include "sample/wrapped_source.h"

namespace pdc {
namespace {

/// A sphere on 5³ blocks, less one of them.
class WithoutBlock final : public WrappedSource {
 public:
  WithoutBlock(const HermiteSource& source, std::size_t missing) : WrappedSource(source), mMissing(missing) {}

  [[nodiscard]] SurfaceBlocks surfaceBlocks(const Monitor& monitor) const override {
    SurfaceBlocks blocks = WrappedSource::surfaceBlocks(monitor);
    blocks.coords.erase(blocks.coords.begin() + static_cast<std::ptrdiff_t>(mMissing));
    blocks.signs.erase(blocks.signs.begin() + static_cast<std::ptrdiff_t>(mMissing));
    return blocks;
  }

 private:
  std::size_t mMissing;
};

SignSource randomSigns(bool open) {
  std::mt19937 engine(3);
  std::bernoulli_distribution inside(0.5);
  SignSource source(26, open);
  for (int i = 0; i < 26 * 26 * 26; ++i) source.set(i / 676, i / 26 % 26, i % 26, inside(engine));
  return source;
}

TEST(Continuation, SoundSourcesPass) {
  for (const bool open : {false, true}) {
    const SurfaceBlocks blocks = randomSigns(open).surfaceBlocks({});
    ASSERT_GT(blocks.coords.size(), 20u);
    EXPECT_NO_THROW(detail::checkContinuation(blocks, detail::buildTopology(blocks, {})));
  }
}

TEST(Continuation, WhicheverBlockIsMissingIsNoticed) {
  const SignSource source = randomSigns(false);
  const std::size_t count = source.surfaceBlocks({}).coords.size();
  std::size_t refused = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const SurfaceBlocks blocks = WithoutBlock(source, i).surfaceBlocks({});
    try {
      detail::checkContinuation(blocks, detail::buildTopology(blocks, {}));
    } catch (const std::invalid_argument&) {
      ++refused;
    }
  }
  // Nothing reaches down into the block with the largest coordinates.
  EXPECT_EQ(refused, count - 1);
}

TEST(Continuation, ContourRefusesASourceThatIsNotClosed) {
  const FieldSource sphereSource(sphere({}, 0.8), {.box = {{-1, -1, -1}, {1, 1, 1}}, .voxelSize = 0.05});
  for (const Placement placement : {Placement::kCertified, Placement::kCell, Placement::kFree})
    EXPECT_THROW(static_cast<void>(contour(WithoutBlock(sphereSource, 0), {.placement = placement})),
                 std::invalid_argument);
}

/// Shared points of neighbouring blocks differ.
TEST(Continuation, SignsThatDoNotAgreeAreNoticed) {
  const SignSource source = randomSigns(false);
  SurfaceBlocks blocks = source.surfaceBlocks({});
  const auto middle = std::find(blocks.coords.begin(), blocks.coords.end(), Coord{1, 1, 1});
  ASSERT_NE(middle, blocks.coords.end());
  const auto i = static_cast<std::size_t>(middle - blocks.coords.begin());
  blocks.signs[i] = BlockSigns{};
  blocks.signs[i].row[40] = 1;
  EXPECT_THROW(detail::checkContinuation(blocks, detail::buildTopology(blocks, {})), std::invalid_argument);
}

}  // namespace
}  // namespace pdc
