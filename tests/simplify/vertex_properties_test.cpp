#include "simplify/vertex_properties.h"

#include <gtest/gtest.h>

namespace pdc::detail {
namespace {

TEST(InterpolatedProperties, BlendAndRound) {
  Mesh mesh;
  mesh.positions.resize(3);
  mesh.properties = {{"color", 3, Buffer<std::uint8_t>{0, 100, 255, 10, 200, 0, 7, 8, 9}},
                     {"depth", 1, Buffer<double>{1, 2, 5}},
                     {"step", 1, Buffer<std::int32_t>{-3, 4, 0}}};
  InterpolatedProperties properties(mesh);
  properties.blend(0, 1, 0.25);
  const std::vector<std::uint32_t> kept{0, 2};
  const std::vector<VertexProperty> result = properties.of(kept);
  ASSERT_EQ(result.size(), 3u);
  EXPECT_EQ(result[0].values, PropertyValues(Buffer<std::uint8_t>{3, 125, 191, 7, 8, 9}));
  EXPECT_EQ(result[1].values, PropertyValues(Buffer<double>{1.25, 5}));
  EXPECT_EQ(result[2].values, PropertyValues(Buffer<std::int32_t>{-1, 0}));
}

}  // namespace
}  // namespace pdc::detail
