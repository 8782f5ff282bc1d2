#include "pdc/sample/dense/dense_source.h"

#include <gtest/gtest.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Dense.h>

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>

#include "pdc/extract/contour.h"
#include "pdc/mesh/mesh_report.h"
#include "pdc/sample/vdb/grid_source.h"
#include "sample/dense/volumes.h"

namespace pdc {
namespace {

using test::Layout;
using test::makeVolume;
using test::sameBytes;
using test::Size;
using test::sphere;
using test::unitMap;
using test::Value;
using test::Volume;

Mesh meshOf(const Volume& volume, const DenseSourceOptions& options = {}, const LatticeMap& map = unitMap()) {
  return contour(DenseSource(volume.view(), map, options));
}

Mesh meshOfGrid(const Volume& floats, float background, const GridSourceOptions& options) {
  const Size& n = floats.form.size;
  auto grid = openvdb::FloatGrid::create(background);
  const openvdb::CoordBBox box({0, 0, 0}, {int(n[0]) - 1, int(n[1]) - 1, int(n[2]) - 1});
  std::vector<float> values(floats.bytes.size() / sizeof(float));
  std::memcpy(values.data(), floats.bytes.data(), floats.bytes.size());
  openvdb::tools::copyFromDense(openvdb::tools::Dense<float>(box, values.data()), *grid, 0.0F);
  return contour(GridSource(grid, options));
}

/// A smooth function of both signs around a positive border, whose slopes vary.
double waves(std::int64_t x, std::int64_t y, std::int64_t z) {
  const double r = std::hypot(double(x) - 20, double(y) - 20, double(z) - 20);
  return 0.05 * (r * r - 150) + 2 * std::sin(0.6 * double(x)) * std::sin(0.7 * double(y)) * std::cos(0.5 * double(z));
}

std::string errorOf(const std::function<void()>& f) {
  try {
    f();
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

TEST(DenseSourceTest, DistancesGiveTheMeshOfTheSameGrid) {
  // A box has creases, for which planes come from distances.
  const auto box = [](std::int64_t x, std::int64_t y, std::int64_t z) {
    const double d = std::max({std::abs(double(x) - 19.7), std::abs(double(y) - 20.1), std::abs(double(z) - 20.4)});
    return d - 11.2;
  };
  const Volume volume = makeVolume<float>({40, 40, 40}, box);
  EXPECT_TRUE(DenseSource(volume.view(), unitMap()).usesDistances());
  EXPECT_TRUE(sameBytes(meshOf(volume), meshOfGrid(volume, 100, {})));
}

TEST(DenseSourceTest, NarrowBandGivesTheMeshOfTheSameGrid) {
  const Volume volume = makeVolume<float>({48, 40, 56}, [](std::int64_t x, std::int64_t y, std::int64_t z) {
    return std::clamp(sphere(24.3, 20.1, 28.2, 12.6)(x, y, z), -3.0, 3.0);
  });
  EXPECT_TRUE(sameBytes(meshOf(volume), meshOfGrid(volume, 3, {})));
}

TEST(DenseSourceTest, FogGivesTheMeshOfTheSameGrid) {
  const Volume volume = makeVolume<float>(
      {40, 48, 40}, [](std::int64_t x, std::int64_t y, std::int64_t z) { return std::max(0.0, 5 - waves(x, y, z)); });
  const Mesh dense = meshOf(volume, {.iso = 4.5, .gridClass = GridClass::kFogVolume});
  EXPECT_GT(dense.positions.size(), 1000U);
  EXPECT_TRUE(sameBytes(dense, meshOfGrid(volume, 0, {.iso = 4.5, .gridClass = GridClass::kFogVolume})));
}

TEST(DenseSourceTest, WholeNumbersOnTheIsovalueGiveTheMeshOfTheSameGrid) {
  const Volume volume = makeVolume<float>({40, 40, 40}, [](std::int64_t x, std::int64_t y, std::int64_t z) {
    return std::round(std::clamp(waves(x, y, z), -5.0, 5.0));
  });
  const Mesh dense = meshOf(volume, {.iso = 0, .gridClass = GridClass::kLevelSet, .inside = InsideValues::kLow});
  EXPECT_TRUE(
      sameBytes(dense, meshOfGrid(volume, 5, {.gridClass = GridClass::kLevelSet, .inside = InsideValues::kLow})));
}

template <typename T>
class DenseSourceTypeTest : public testing::Test {};
using Types = testing::Types<std::int8_t, std::uint8_t, std::int16_t, std::uint16_t, std::int32_t, std::uint32_t,
                             std::int64_t, std::uint64_t, double>;
TYPED_TEST_SUITE(DenseSourceTypeTest, Types);

TYPED_TEST(DenseSourceTypeTest, GivesTheMeshOfTheSameFloats) {
  const auto whole = [](std::int64_t x, std::int64_t y, std::int64_t z) {
    return std::round(std::clamp(60 - 4 * waves(x, y, z), 0.0, 120.0));
  };
  const DenseSourceOptions options{.iso = 60.25, .gridClass = GridClass::kFogVolume};
  const Mesh expected = meshOf(makeVolume<float>({41, 39, 37}, whole), options);
  EXPECT_GT(expected.positions.size(), 1000U);
  EXPECT_TRUE(sameBytes(meshOf(makeVolume<TypeParam>({41, 39, 37}, whole), options), expected));
  EXPECT_TRUE(sameBytes(meshOf(makeVolume<TypeParam>({41, 39, 37}, whole, {.swapped = true}), options), expected));
}

TEST(DenseSourceTest, AnyOrderOfMemoryGivesTheSameMesh) {
  const Size size{41, 37, 43};
  const DenseSourceOptions options{.iso = 0.3, .gridClass = GridClass::kLevelSet, .inside = InsideValues::kLow};
  const Mesh expected = meshOf(makeVolume<float>(size, waves), options);
  EXPECT_GT(expected.positions.size(), 1000U);
  std::array<int, 3> order{0, 1, 2};
  do {
    EXPECT_TRUE(sameBytes(meshOf(makeVolume<float>(size, waves, {.order = order}), options), expected));
    EXPECT_TRUE(sameBytes(
        meshOf(makeVolume<float>(size, waves, {.order = order, .reversed = {true, false, true}}), options), expected));
    EXPECT_TRUE(sameBytes(meshOf(makeVolume<float>(size, waves, {.order = order, .gap = 3, .swapped = true}), options),
                          expected));
  } while (std::next_permutation(order.begin(), order.end()));
}

TEST(DenseSourceTest, LinesLongerThanARunAreReadWhole) {
  const auto rod = [](std::int64_t x, std::int64_t y, std::int64_t z) {
    return std::max(std::hypot(double(y) - 5.2, double(z) - 4.9) - 3, std::abs(double(x) - 2500) - 2400.3);
  };
  const DenseSourceOptions options{.iso = 0, .hermite = HermiteMode::kGradient, .gridClass = GridClass::kLevelSet};
  const Mesh along = meshOf(makeVolume<float>({5000, 11, 10}, rod, {.order = {2, 1, 0}}), options);
  EXPECT_TRUE(sameBytes(along, meshOf(makeVolume<float>({5000, 11, 10}, rod), options)));
  EXPECT_EQ(analyze(along).eulerNumber, 2);
}

TEST(DenseSourceTest, BooleansAreParted) {
  const Volume volume = makeVolume<bool>({20, 20, 20}, [](std::int64_t x, std::int64_t y, std::int64_t z) {
    return x > 4 && x < 15 && y > 4 && y < 15 && z > 4 && z < 15 ? 1 : 0;
  });
  const DenseSource source(volume.view(), unitMap());
  EXPECT_EQ(source.iso(), 0.5);
  EXPECT_TRUE(source.insideIsHigher());
  EXPECT_TRUE(source.meaning().doubts.empty());
  const MeshReport report = analyze(contour(source));
  EXPECT_EQ(report.eulerNumber, 2);
  EXPECT_EQ(report.boundaryEdges, 0U);
}

TEST(DenseSourceTest, SlopeAndInterceptAreMeant) {
  const Volume floats = makeVolume<float>({40, 40, 40}, waves);
  Volume stored = makeVolume<float>({40, 40, 40}, [](std::int64_t x, std::int64_t y, std::int64_t z) {
    return double(float(waves(x, y, z))) * 4 + 8;
  });
  stored.form.slope = -0.25;
  stored.form.intercept = 2;
  const DenseSourceOptions options{.iso = 0, .gridClass = GridClass::kLevelSet, .inside = InsideValues::kLow};
  const DenseSourceOptions turned{.iso = 0, .gridClass = GridClass::kLevelSet, .inside = InsideValues::kHigh};
  const Mesh a = meshOf(floats, options), b = meshOf(stored, turned);
  ASSERT_EQ(a.positions.size(), b.positions.size());
  for (std::size_t i = 0; i < a.positions.size(); ++i) ASSERT_LT(length(a.positions[i] - b.positions[i]), 1e-3) << i;
}

TEST(DenseSourceTest, SolidsThatReachTheBorderGetFlatCaps) {
  const Volume volume = makeVolume<float>({16, 24, 24}, sphere(0, 11.6, 11.8, 9));
  const Mesh mesh = meshOf(volume);
  const MeshReport report = analyze(mesh);
  EXPECT_EQ(report.boundaryEdges, 0U);
  EXPECT_EQ(report.eulerNumber, 2);
  float least = 0;
  std::size_t onCap = 0, crease = 0;
  for (const Vec3f& p : mesh.positions) {
    least = std::min(least, p.x);
    const double radius = std::hypot(double(p.y) - 11.6, double(p.z) - 11.8);
    if (std::abs(p.x + 0.5F) < 1e-4F) {
      ++onCap;
      crease += std::abs(radius - std::sqrt(81 - 0.25)) < 0.1 ? 1 : 0;
    }
  }
  EXPECT_NEAR(least, -0.5, 1e-4);
  EXPECT_GT(onCap, 200U);
  EXPECT_GT(crease, 40U);
}

TEST(DenseSourceTest, WholeVolumesAreBoxes) {
  const Volume volume = makeVolume<std::uint8_t>({9, 8, 1}, [](auto, auto, auto) { return 7; });
  const MeshReport report = analyze(meshOf(volume, {.iso = 3}));
  EXPECT_NEAR(report.volume, 9 * 8 * 1, 1e-3);
  EXPECT_EQ(report.eulerNumber, 2);
}

TEST(DenseSourceTest, OneVoxelIsACube) {
  const Volume volume = makeVolume<float>({1, 1, 1}, [](auto, auto, auto) { return 1; });
  const MeshReport report = analyze(meshOf(volume, {.iso = 0.5}));
  EXPECT_NEAR(report.volume, 1, 1e-4);
}

TEST(DenseSourceTest, OpenSurfacesEndAtTheBorder) {
  const Volume volume = makeVolume<float>({16, 24, 24}, sphere(0, 11.6, 11.8, 9));
  const Mesh mesh = meshOf(volume, {.open = true});
  EXPECT_GT(analyze(mesh).boundaryEdges, 10U);
  for (const Vec3f& p : mesh.positions) EXPECT_GE(p.x, 0);
}

TEST(DenseSourceTest, MaskEndsTheData) {
  const Size size{24, 24, 24};
  const Volume volume = makeVolume<float>(size, sphere(11.6, 11.6, 11.8, 9));
  const Volume mask = makeVolume<bool>(size, [](std::int64_t x, auto, auto) { return x >= 12 ? 1 : 0; });
  const Mesh closed = meshOf(volume, {.mask = mask.view()}), open = meshOf(volume, {.open = true, .mask = mask.view()});
  EXPECT_EQ(analyze(closed).boundaryEdges, 0U);
  float least = 100, leastOpen = 100;
  for (const Vec3f& p : closed.positions) least = std::min(least, p.x);
  for (const Vec3f& p : open.positions) leastOpen = std::min(leastOpen, p.x);
  EXPECT_NEAR(least, 11.5, 1e-4);
  EXPECT_GE(leastOpen, 12);
  EXPECT_GT(analyze(open).boundaryEdges, 10U);
}

TEST(DenseSourceTest, PlanesLieWhereTheMapSays) {
  const Vec3d normal = Vec3d{0.36, 0.48, 0.8};
  const double offset = 13.37;
  const Volume volume = makeVolume<double>({24, 24, 24}, [&](std::int64_t x, std::int64_t y, std::int64_t z) {
    return dot(normal, Vec3d{double(x), double(y), double(z)}) - offset;
  });
  const std::array maps{LatticeMap(Mat3d::diagonal(0.5, 2, 1.25), {3, -4, 5}),
                        LatticeMap(Mat3d::diagonal(-1, 1, 1), {10, 0, 0}),
                        LatticeMap(Mat3d{{Vec3d{1, 0.3, 0}, Vec3d{0, 1.5, -0.2}, Vec3d{0.1, 0, 0.8}}}, {1, 2, 3})};
  for (const LatticeMap& map : maps) {
    const Mesh mesh = meshOf(volume, {.iso = 0, .open = true}, map);
    EXPECT_GT(mesh.positions.size(), 100U);
    const Mat3d back = inverse(map.jacobian({}));
    for (const Vec3f& p : mesh.positions) {
      const Vec3d at = back * (vecCast<double>(p) - map.position({}));
      ASSERT_NEAR(dot(normal, at), offset, 1e-5);
    }
  }
}

TEST(DenseSourceTest, NonFiniteValuesAreNamed) {
  const auto holes = [](std::int64_t x, std::int64_t y, std::int64_t z) {
    if (x == 3 && y == 4 && z == 5) return std::numeric_limits<double>::quiet_NaN();
    if (x == 12 && y == 1 && z == 2) return std::numeric_limits<double>::infinity();
    return sphere(8, 8, 8, 5)(x, y, z);
  };
  const Volume volume = makeVolume<float>({17, 17, 17}, holes);
  const std::string what = errorOf([&] { static_cast<void>(meshOf(volume)); });
  EXPECT_NE(what.find("2 voxels are not finite, the first at (3, 4, 5) is nan"), std::string::npos) << what;
  EXPECT_EQ(analyze(meshOf(volume, {.acceptNonFinite = true})).eulerNumber, 2);
  const Volume mask = makeVolume<bool>({17, 17, 17}, [&](std::int64_t x, std::int64_t y, std::int64_t z) {
    return std::isfinite(holes(x, y, z)) ? 1 : 0;
  });
  EXPECT_FALSE(meshOf(volume, {.mask = mask.view()}).empty());
}

TEST(DenseSourceTest, SignedMeasurementsAreFogs) {
  // As computed tomography has them: air -1000, tissue 50, bone 800.
  const auto scan = [](std::int64_t x, std::int64_t y, std::int64_t z) {
    const double r = std::hypot(double(x) - 20, double(y) - 20, double(z) - 20);
    return (r < 6 ? 800 : r < 14 ? 50 : -1000) + 10 * std::sin(double(x * 7 + y * 13 + z * 5));
  };
  for (const bool integers : {false, true}) {
    const Volume volume =
        integers ? makeVolume<std::int16_t>({40, 40, 40}, scan) : makeVolume<float>({40, 40, 40}, scan);
    const DenseSource source(volume.view(), unitMap());
    EXPECT_EQ(source.meaning().gridClass, GridClass::kFogVolume);
    EXPECT_TRUE(source.insideIsHigher());
    EXPECT_GT(source.iso(), -950);
    EXPECT_LT(source.iso(), 40);
    EXPECT_FALSE(source.meaning().doubts.empty());
  }
}

TEST(DenseSourceTest, DistancesThatArePositiveInsideAreTurned) {
  const Volume volume = makeVolume<float>(
      {40, 40, 40}, [](std::int64_t x, std::int64_t y, std::int64_t z) { return -sphere(20.2, 20, 20, 11)(x, y, z); });
  const DenseSource source(volume.view(), unitMap());
  EXPECT_EQ(source.meaning().gridClass, GridClass::kLevelSet);
  EXPECT_TRUE(source.insideIsHigher());
}

TEST(DenseSourceTest, SigmaMakesPlanesNoisier) {
  const Size size{32, 32, 32};
  const Volume volume = makeVolume<float>(size, sphere(15.6, 15.6, 15.8, 9));
  const Volume sigma = makeVolume<double>(size, [](auto, auto, auto) { return 0.1; });
  const Volume bad = makeVolume<float>(size, [](std::int64_t x, auto, auto) { return x == 0 ? -1 : 0.1; });
  const DenseSource source(volume.view(), unitMap(), {.sigma = sigma.view()});
  EXPECT_EQ(source.knowledge().noise, SourceKnowledge::Noise::kSigma);
  EXPECT_EQ(source.refusedNoise(), 0U);
  EXPECT_EQ(DenseSource(volume.view(), unitMap(), {.sigma = bad.view()}).refusedNoise(), 32U * 32U);
  const SurfaceBlocks blocks = source.surfaceBlocks({});
  const auto hermite = std::make_unique<HermiteBlock>();
  const auto noise = std::make_unique<PlaneNoise>();
  const EdgeIndex edges(blocks.signs[0]);
  const SurfaceBlock block{blocks.coords[0], blocks.signs[0], edges};
  source.fillHermite(block, *hermite);
  source.fillNoise(block, *hermite, *noise);
  for (int i = 0; i < edges.size(); ++i) EXPECT_NEAR(noise->sigma[i], 0.09, 0.02);
}

TEST(DenseSourceTest, ImpossibleVolumesAreRefused) {
  const Volume volume = makeVolume<float>({8, 8, 8}, sphere(4, 4, 4, 2));
  const auto refuse = [&](const std::function<void(VolumeView&, DenseSourceOptions&)>& spoil) {
    VolumeView view = volume.view();
    DenseSourceOptions options;
    spoil(view, options);
    return errorOf([&] { DenseSource(view, unitMap(), options); });
  };
  EXPECT_NE(refuse([](VolumeView& v, auto&) { v.size[1] = 0; }).find("not 0"), std::string::npos);
  EXPECT_NE(refuse([](VolumeView& v, auto&) { v.size[2] = kMostVolumePoints + 1; }).find("1073741824"),
            std::string::npos);
  EXPECT_NE(refuse([](VolumeView& v, auto&) { v.slope = 0; }).find("slope"), std::string::npos);
  EXPECT_NE(refuse([](VolumeView& v, auto&) { v.intercept = std::nan(""); }).find("intercept"), std::string::npos);
  EXPECT_NE(refuse([](auto&, DenseSourceOptions& o) { o.iso = std::nan(""); }).find("isovalue"), std::string::npos);
  const Volume other = makeVolume<float>({8, 8, 7}, sphere(4, 4, 4, 2));
  EXPECT_NE(refuse([&](auto&, DenseSourceOptions& o) { o.weight = other.view(); }).find("8×8×7"), std::string::npos);
  EXPECT_THROW(DenseSource({.size = {1, 1, 1}}, unitMap()), std::invalid_argument);
}

TEST(DenseSourceTest, OwnerLivesAsLongAsTheSource) {
  auto owner = std::make_shared<Volume>(makeVolume<float>({8, 8, 8}, sphere(4, 4, 4, 2)));
  const std::weak_ptr<const Volume> watched = owner;
  {
    const VolumeView view = owner->view();
    const DenseSource source(view, unitMap(), {}, std::move(owner));
    EXPECT_FALSE(watched.expired());
    EXPECT_FALSE(contour(source).empty());
  }
  EXPECT_TRUE(watched.expired());
}

TEST(DenseSourceTest, ThreadsMakeNoDifference) {
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0, 0.4);
  const Volume volume = makeVolume<std::uint16_t>({70, 65, 75}, [&](std::int64_t x, std::int64_t y, std::int64_t z) {
    return std::max(0.0, 1000 - 300 * (sphere(35, 33, 36, 24)(x, y, z) + noise(random)));
  });
  const DenseSource source(volume.view(), unitMap());
  EXPECT_TRUE(sameBytes(contour(source, {.threads = 1}), contour(source, {.threads = 3})));
}

}  // namespace
}  // namespace pdc
