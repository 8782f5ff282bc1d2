#include "pdc/sample/vdb/grid_attribute.h"

#include <gtest/gtest.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Interpolation.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <random>
#include <stdexcept>

#include "folders.h"
#include "pdc/error.h"
#include "pdc/io/vdb/vdb_reader.h"
#include "pdc/sample/vdb/grid_function.h"

namespace pdc {
namespace {

using openvdb::math::Transform;

/// Points in and around the ball of radius 12, relative to an origin.
Mesh points(const Vec3d& origin = {}) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> uniform(-14, 14);
  Mesh mesh;
  mesh.origin = origin;
  for (int i = 0; i < 2000; ++i) mesh.positions.push_back({uniform(random), uniform(random), uniform(random)});
  return mesh;
}

/// A grid of random values in [-10, 10] within a box, with a transform that is turned, moved and stretched.
template <typename Grid>
typename Grid::Ptr randomGrid(unsigned seed) {
  using Value = typename Grid::ValueType;
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-10, 10);
  auto grid = Grid::create(Value(7));
  auto transform = Transform::createLinearTransform(1.3);
  transform->preScale(openvdb::Vec3d(1, 0.7, 2));
  transform->postRotate(0.4 + seed, openvdb::math::Y_AXIS);
  transform->postTranslate({0.3, -2, 1});
  grid->setTransform(transform);
  for (openvdb::Coord c(-8); c.x() <= 8; ++c.x())
    for (c.y() = -8; c.y() <= 8; ++c.y())
      for (c.z() = -8; c.z() <= 8; ++c.z()) {
        Value value(0);
        if constexpr (openvdb::VecTraits<Value>::IsVec)
          for (int k = 0; k < 3; ++k)
            value[k] = static_cast<typename openvdb::VecTraits<Value>::ElementType>(uniform(random));
        else
          value = static_cast<Value>(uniform(random));
        grid->tree().setValue(c, value);
      }
  return grid;
}

/// Expects that a property has what OpenVDB's own sampler for world space gives at each vertex.
template <typename Sampler, typename Number, typename Grid>
void expectSampled(const Grid& grid, const Mesh& mesh) {
  using Value = typename Grid::ValueType;
  const std::vector<VertexProperty> properties = gridAttribute(grid, "a", mesh);
  ASSERT_EQ(properties.size(), 1u);
  EXPECT_EQ(properties[0].name, "a");
  const auto* const numbers = std::get_if<Buffer<Number>>(&properties[0].values);
  ASSERT_NE(numbers, nullptr) << typeName(properties[0]);
  const openvdb::tools::GridSampler<Grid, Sampler> sampler(grid);
  std::size_t differences = 0;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const Vec3d p = mesh.origin + vecCast<double>(mesh.positions[v]);
    const Value value = sampler.wsSample(openvdb::Vec3d(p.x, p.y, p.z));
    if constexpr (openvdb::VecTraits<Value>::IsVec)
      for (std::size_t k = 0; k < 3; ++k) differences += (*numbers)[3 * v + k] != value[static_cast<int>(k)];
    else
      differences += (*numbers)[v] != static_cast<Number>(value);
  }
  EXPECT_EQ(differences, 0u);
}

TEST(GridAttribute, HasWhatOpenVdbSamples) {
  openvdb::initialize();
  using namespace openvdb::tools;
  const Mesh mesh = points(), far = points({1e5, 0, 0});
  expectSampled<BoxSampler, float>(*randomGrid<openvdb::FloatGrid>(1), mesh);
  expectSampled<BoxSampler, double>(*randomGrid<openvdb::DoubleGrid>(2), mesh);
  expectSampled<BoxSampler, float>(*randomGrid<openvdb::Vec3SGrid>(3), mesh);
  expectSampled<BoxSampler, double>(*randomGrid<openvdb::Vec3DGrid>(4), mesh);
  expectSampled<PointSampler, std::int32_t>(*randomGrid<openvdb::Int32Grid>(5), mesh);
  expectSampled<PointSampler, double>(*randomGrid<openvdb::Int64Grid>(6), mesh);
  expectSampled<PointSampler, std::uint8_t>(*randomGrid<openvdb::BoolGrid>(7), mesh);
  expectSampled<PointSampler, std::int32_t>(*randomGrid<openvdb::Vec3IGrid>(8), mesh);
  const auto moved = randomGrid<openvdb::FloatGrid>(9);
  moved->transform().postTranslate({1e5, 0, 0});
  expectSampled<BoxSampler, float>(*moved, far);
}

TEST(GridAttribute, SamplesStaggeredVectorsByComponents) {
  const auto grid = randomGrid<openvdb::Vec3SGrid>(1);
  grid->setGridClass(openvdb::GRID_STAGGERED);
  expectSampled<openvdb::tools::StaggeredBoxSampler, float>(*grid, points());
}

TEST(GridAttribute, IsTheBackgroundFarOut) {
  openvdb::initialize();
  const auto grid = openvdb::FloatGrid::create(7);
  grid->setTransform(Transform::createLinearTransform(1e-3));
  Mesh mesh;
  mesh.positions = {{1e20F, 0, 0}, {0, -1e30F, 3}};
  EXPECT_EQ(std::get<Buffer<float>>(gridAttribute(*grid, "a", mesh)[0].values), (Buffer<float>{7, 7}));
  EXPECT_EQ(gridFunction(grid)({1e300, 0, 0}), 7);
}

TEST(GridAttribute, MakesBytesOfColours) {
  openvdb::initialize();
  const auto grid = openvdb::Vec3SGrid::create(openvdb::Vec3s(0.5F, -1, 2));
  const std::vector<VertexProperty> colours = gridAttribute(*grid, "Cd", points());
  ASSERT_EQ(colours.size(), 3u);
  const std::array<std::pair<const char*, int>, 3> expected{{{"red", 128}, {"green", 0}, {"blue", 255}}};
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(colours[k].name, expected[k].first);
    EXPECT_EQ(std::get<Buffer<std::uint8_t>>(colours[k].values).at(11), expected[k].second);
  }
  const auto nan = openvdb::Vec3DGrid::create(openvdb::Vec3d(std::numeric_limits<double>::quiet_NaN()));
  EXPECT_EQ(std::get<Buffer<std::uint8_t>>(gridAttribute(*nan, "Cd", points())[0].values).at(0), 0);
  EXPECT_EQ(gridAttribute(*openvdb::Vec3IGrid::create(), "Cd", points())[0].name, "Cd")
      << "whole numbers are no colour";
}

TEST(GridAttribute, RefusesOtherTypesAndNamesWithoutLetters) {
  openvdb::initialize();
  const auto pairs = openvdb::createGrid<openvdb::Grid<openvdb::tree::Tree4<openvdb::Vec2s, 5, 4, 3>::Type>>();
  try {
    (void)gridAttribute(*pairs, "uv", points());
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(),
                 "grid \"uv\" of type vec2s cannot be sampled; float, double, int32, int64, bool, vec3s, vec3d and "
                 "vec3i can");
  }
  EXPECT_THROW((void)gridAttribute(*openvdb::FloatGrid::create(), "", points()), std::invalid_argument);
  EXPECT_EQ(gridAttribute(*openvdb::FloatGrid::create(), "two words", points())[0].name, "two_words");
}

TEST(GridFunction, IsTheSampledValueAnywhere) {
  const auto grid = randomGrid<openvdb::DoubleGrid>(1);
  const auto function = gridFunction(grid);
  const openvdb::tools::GridSampler<openvdb::DoubleGrid, openvdb::tools::BoxSampler> sampler(*grid);
  for (const Vec3f& p : points().positions)
    ASSERT_EQ(function(vecCast<double>(p)), sampler.wsSample(openvdb::Vec3d(p.x, p.y, p.z)));
  EXPECT_THROW((void)gridFunction(openvdb::BoolGrid::create()), Error);
  EXPECT_THROW((void)gridFunction(nullptr), std::invalid_argument);
}

TEST(GridAttribute, ReadsTheColoursOfARealFile) {
  const std::filesystem::path path = test::dataFolder() / "vdb/oiio_sphere_cd_vec3s.vdb";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
  const auto grid = openvdb::gridPtrCast<openvdb::Vec3SGrid>(readVdbAttribute(path, "Cd"));
  ASSERT_NE(grid, nullptr);
  Mesh mesh = points();
  for (Vec3f& p : mesh.positions) p *= 0.1F;
  expectSampled<openvdb::tools::BoxSampler, float>(*grid, mesh);
  EXPECT_EQ(gridAttribute(*grid, "Cd", mesh).size(), 3u);
}

}  // namespace
}  // namespace pdc
