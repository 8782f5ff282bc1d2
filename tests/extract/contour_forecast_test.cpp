#include "pdc/extract/contour_forecast.h"

#include <gtest/gtest.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/LevelSetSphere.h>

#include <string>

#include "extract/sign_source.h"
#include "pdc/error.h"
#include "pdc/field/function_field.h"
#include "pdc/field/noise.h"
#include "pdc/field/primitives.h"
#include "pdc/sample/implicit/field_source.h"
#include "pdc/sample/vdb/grid_source.h"

namespace pdc {
namespace {

const Box kBox{{-2, -2, -2}, {2, 2, 2}};

/// Expects the forecast to be near the number of vertices that the source's contour has.
void expectNear(const HermiteSource& source) {
  const auto forecast = forecastContour(source);
  ASSERT_TRUE(forecast);
  const auto vertices = static_cast<double>(contour(source).positions.size());
  EXPECT_GT(forecast->vertices, 0.7 * vertices);
  EXPECT_LT(forecast->vertices, 1.4 * vertices);
  EXPECT_GT(forecast->memory, 40 * vertices);
  EXPECT_LT(forecast->memory, 160 * vertices);
}

TEST(ContourForecast, IsNearWhatComes) {
  openvdb::initialize();
  expectNear(FieldSource(sphere({0, 0.1, 0}, 1.3), {.box = kBox, .voxelSize = 4.0 / 400}));
  expectNear(FieldSource(simplexNoise({.frequency = 2}), {.box = kBox, .voxelSize = 4.0 / 200}));
  expectNear(GridSource(openvdb::tools::createLevelSetSphere<openvdb::FloatGrid>(150, openvdb::Vec3f(0), 1, 3)));
}

TEST(ContourForecast, OfHugeLatticesComesAtOnce) {
  const FieldSource source(sphere({0, 0, 0}, 1), {.box = kBox, .voxelSize = 4.0 / kMaxVoxelsPerAxis});
  const double side = kMaxVoxelsPerAxis / 4.0;  // A sphere's crossings are 1.5 times its area, its vertices as many.
  const double expected = 1.5 * 4 * 3.14159265 * side * side;
  const auto forecast = forecastContour(source);
  ASSERT_TRUE(forecast);
  EXPECT_GT(forecast->vertices, 0.6 * expected);
  EXPECT_LT(forecast->vertices, 1.6 * expected);
}

TEST(ContourForecast, WithoutBoundsTheSearchIsCounted) {
  const FieldSource source(functionField({.value = [](const Vec3d& p) { return length(p) - 1; }}),
                           {.box = kBox, .voxelSize = 4.0 / 65536});
  const auto forecast = forecastContour(source);
  ASSERT_TRUE(forecast);
  EXPECT_GT(forecast->memory, 1e12);
}

TEST(ContourForecast, SourcesNeedNotKnow) { EXPECT_FALSE(forecastContour(SignSource(8, false))); }

TEST(ContourForecast, CanBeStopped) {
  const FieldSource source(sphere({0, 0, 0}, 1), {.box = kBox, .voxelSize = 0.01});
  std::atomic<bool> stop = true;
  EXPECT_THROW((void)forecastContour(source, {}, {.stop = &stop}), Cancelled);
}

TEST(MaxMemory, RefusesWithBothFigures) {
  const FieldSource source(sphere({0, 0, 0}, 1), {.box = kBox, .voxelSize = 0.05});
  try {
    (void)contour(source, {.maxMemory = 1'000'000});
    FAIL() << "not refused";
  } catch (const Error& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("vertices"), std::string::npos) << text;
    EXPECT_NE(text.find("1 MB that are allowed"), std::string::npos) << text;
    EXPECT_EQ(text.find('\n'), std::string::npos);
  }
  EXPECT_FALSE(contour(source, {.maxMemory = std::size_t{4} << 30}).empty());
}

}  // namespace
}  // namespace pdc
