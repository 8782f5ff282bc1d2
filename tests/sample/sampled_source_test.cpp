#include "pdc/sample/sampled_source.h"

#include <gtest/gtest.h>

#include <atomic>
#include <memory>

#include "pdc/sample/implicit/field_source.h"
#include "sample/creases/noisy_part.h"

namespace pdc {
namespace {

FieldSource sourceOf(const FieldPtr& field) { return {field, {.box = test::kDrilledBoxBounds, .voxelSize = 0.05}}; }

TEST(SampledSource, GivesWhatTheSourceGivesWithoutAskingIt) {
  const FieldSource source = sourceOf(test::drilledBox());
  const SampledSource sampled(source);
  const SurfaceBlocks blocks = source.surfaceBlocks({}), kept = sampled.surfaceBlocks({});
  ASSERT_EQ(kept.coords, blocks.coords);
  auto expected = std::make_unique<HermiteBlock>(), found = std::make_unique<HermiteBlock>();
  std::size_t crossings = 0;
  for (std::size_t i = 0; i < blocks.coords.size(); ++i) {
    ASSERT_EQ(kept.signs[i].row, blocks.signs[i].row);
    const EdgeIndex edges(blocks.signs[i]);
    source.fillHermite({blocks.coords[i], blocks.signs[i], edges}, *expected);
    sampled.fillHermite({blocks.coords[i], blocks.signs[i], edges}, *found);
    for (int e = 0; e < edges.size(); ++e) {
      ASSERT_EQ(found->t[e], expected->t[e]);
      ASSERT_EQ((Vec3f{found->nx[e], found->ny[e], found->nz[e]}),
                (Vec3f{expected->nx[e], expected->ny[e], expected->nz[e]}));
    }
    crossings += static_cast<std::size_t>(edges.size());
  }
  EXPECT_EQ(sampled.crossings(), crossings);
  EXPECT_GT(crossings, 8000u);
}

TEST(SampledSource, StopsWhenAsked) {
  const std::atomic<bool> stop = true;
  EXPECT_THROW(SampledSource(sourceOf(test::drilledBox()), {.stop = &stop}), Cancelled);
}

}  // namespace
}  // namespace pdc
