#include "pdc/sample/implicit/field_source.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "pdc/error.h"
#include "sample/implicit/counting_field.h"

namespace pdc {
namespace {

using test::CountingField;
using test::fieldOfX;
using test::sphereField;
using test::unknownBound;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr Box kUnitBox{{-1, -1, -1}, {1, 1, 1}};

struct Crossing {
  Vec3d position;  ///< World.
  Vec3d normal;
  float t;
};

/// A lattice edge: axis, then the lower end.
using EdgeName = std::array<int, 4>;

/// All crossings of a source by edge, and a check that blocks sharing an edge agree on it, bit for bit.
std::map<EdgeName, Crossing> crossings(const FieldSource& source, const SurfaceBlocks& surface) {
  std::map<EdgeName, Crossing> result;
  auto hermite = std::make_unique<HermiteBlock>();
  for (std::size_t b = 0; b < surface.coords.size(); ++b) {
    const Coord& block = surface.coords[b];
    const EdgeIndex edges(surface.signs[b]);
    source.fillHermite({block, surface.signs[b], edges}, *hermite);
    edges.forEach([&](int i, int axis, int x, int y, int z) {
      Vec3d p{8.0 * block[0] + x, 8.0 * block[1] + y, 8.0 * block[2] + z};
      const EdgeName name{axis, 8 * block[0] + x, 8 * block[1] + y, 8 * block[2] + z};
      p[axis] += hermite->t[i];
      const Crossing crossing{
          source.map().position(p), {hermite->nx[i], hermite->ny[i], hermite->nz[i]}, hermite->t[i]};
      const auto [old, isNew] = result.emplace(name, crossing);
      EXPECT_TRUE(isNew ||
                  std::memcmp(&old->second, &crossing, sizeof crossing.position + sizeof crossing.normal) == 0);
    });
  }
  return result;
}

std::map<EdgeName, Crossing> crossings(const FieldSource& source) {
  return crossings(source, source.surfaceBlocks({}));
}

bool mixed(const BlockSigns& signs, int axis, int end) {
  int inside = 0;
  for (int i = 0; i < kBlockPoints; ++i)
    for (int j = 0; j < kBlockPoints; ++j)
      inside += axis == 0 ? signs.inside(end, i, j) : axis == 1 ? signs.inside(i, end, j) : signs.inside(i, j, end);
  return inside != 0 && inside != kBlockPoints * kBlockPoints;
}

/// Sorted, without repetition, each block mixed, and every neighbour across a mixed face there too.
void expectWellFormed(const SurfaceBlocks& surface, const Coord& blocks) {
  ASSERT_EQ(surface.coords.size(), surface.signs.size());
  EXPECT_TRUE(std::is_sorted(surface.coords.begin(), surface.coords.end()));
  EXPECT_EQ(std::adjacent_find(surface.coords.begin(), surface.coords.end()), surface.coords.end());
  for (std::size_t i = 0; i < surface.coords.size(); ++i) {
    EXPECT_FALSE(surface.signs[i].uniform());
    for (int axis = 0; axis < 3; ++axis)
      for (const int side : {-1, 1}) {
        Coord neighbour = surface.coords[i];
        neighbour[axis] += side;
        if (neighbour[axis] < 0 || neighbour[axis] >= blocks[axis]) continue;
        if (!mixed(surface.signs[i], axis, side < 0 ? 0 : kBlockSize)) continue;
        EXPECT_TRUE(std::binary_search(surface.coords.begin(), surface.coords.end(), neighbour));
      }
  }
}

std::string messageOf(const FieldSourceOptions& options) {
  try {
    const FieldSource source(sphereField({0, 0, 0}, 0.5), options);
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(FieldSource, SphereCrossingsAndNormalsAreExact) {
  const double radius = 0.77, voxel = 2.0 / 50;
  const FieldSource source(sphereField({0.03, 0.01, -0.02}, radius), {.box = kUnitBox, .voxelSize = voxel});
  const SurfaceBlocks surface = source.surfaceBlocks({});
  EXPECT_FALSE(surface.open);
  expectWellFormed(surface, {7, 7, 7});
  const auto found = crossings(source, surface);
  EXPECT_GT(found.size(), 5000u);
  for (const auto& [edge, crossing] : found) {
    const Vec3d r = crossing.position - Vec3d{0.03, 0.01, -0.02};
    EXPECT_NEAR(length(r), radius, voxel * 0x1p-19);
    EXPECT_NEAR(length(crossing.normal - r * (1 / length(r))), 0, 1e-6);
  }
}

TEST(FieldSource, SteepFlatAndBrokenFunctionsAreBracketed) {
  const double root = 0.1234567, voxel = 0.125;
  const std::function<double(double)> functions[] = {
      [=](double x) { return std::pow(x - root, 3); },
      [=](double x) { return std::tanh(1e6 * (x - root)); },
      [=](double x) { return x < root ? -1.0 : 1.0; },
      [=](double x) { return x < root ? -1.0 : kInfinity; },
  };
  for (const auto& f : functions) {
    const FieldSource source(fieldOfX(f), {.box = kUnitBox, .voxelSize = voxel, .open = true, .acceptNonFinite = true});
    const auto found = crossings(source);
    EXPECT_EQ(found.size(), 17u * 17u);
    for (const auto& [edge, crossing] : found) EXPECT_NEAR(crossing.position.x, root, voxel * 0x1p-19);
  }
}

TEST(FieldSource, MissingGradientsAreReplacedByDifferences) {
  const auto value = [](const Vec3d& p) { return p.x + 2 * p.y - 2 * p.z - 0.1; };
  const CountingField::GradientFunction gradients[] = {
      [](const Vec3d&) {
        return Vec3d{0, 0, 0};
      },
      [](const Vec3d&) {
        return Vec3d{1, kNan, 0};
      },
      [](const Vec3d&) {
        return Vec3d{kInfinity, 0, 0};
      },
  };
  for (const auto& gradient : gradients) {
    const auto field = std::make_shared<CountingField>(value, gradient, unknownBound);
    const auto found = crossings(FieldSource(field, {.box = kUnitBox, .voxelSize = 0.25, .open = true}));
    EXPECT_FALSE(found.empty());
    for (const auto& [edge, crossing] : found)
      EXPECT_NEAR(length(crossing.normal - Vec3d{1, 2, -2} * (1.0 / 3)), 0, 1e-6);
  }
}

TEST(FieldSource, OneSidedDifferencesAtTheEdgeOfTheDomain) {
  const auto found =
      crossings(FieldSource(fieldOfX([](double x) { return x < 0.1 ? 2 * x - 1 : kNan; }),
                            {.box = kUnitBox, .voxelSize = 0.25, .open = true, .acceptNonFinite = true}));
  EXPECT_FALSE(found.empty());
  for (const auto& [edge, crossing] : found) EXPECT_LE(length(crossing.normal - Vec3d{1, 0, 0}), 1e-6);
}

TEST(FieldSource, WhatIsNotFiniteIsOutsideWhereAccepted) {
  for (const double value : {kNan, kInfinity, -kInfinity}) {
    const auto field = fieldOfX([value](double x) { return x < 0.1 ? -1.0 : value; });
    const auto found =
        crossings(FieldSource(field, {.box = kUnitBox, .voxelSize = 0.25, .open = true, .acceptNonFinite = true}));
    EXPECT_EQ(found.size(), 81u);
    for (const auto& [edge, crossing] : found) EXPECT_NEAR(crossing.position.x, 0.1, 1e-6);
  }
}

TEST(FieldSource, NoNormalIsZero) {
  const auto found =
      crossings(FieldSource(fieldOfX([](double x) { return x < 0.1 ? -1.0 : kNan; }),
                            {.box = kUnitBox, .voxelSize = 0.25, .open = true, .acceptNonFinite = true}));
  EXPECT_FALSE(found.empty());
  for (const auto& [edge, crossing] : found) EXPECT_EQ(crossing.normal, (Vec3d{0, 0, 0}));
}

TEST(FieldSource, WorkGrowsWithTheSurface) {
  std::size_t previous = 0;
  for (const int resolution : {64, 128, 256}) {
    const auto field = sphereField({0.02, 0.01, 0}, 0.7);
    const FieldSource source(field, {.box = kUnitBox, .voxelSize = 2.0 / resolution});
    EXPECT_FALSE(source.surfaceBlocks({}).coords.empty());
    const std::size_t points = field->points();
    if (previous != 0) {
      EXPECT_NEAR(static_cast<double>(points) / static_cast<double>(previous), 4, 1);
    }
    previous = points;
  }
}

TEST(FieldSource, BoundsThatExcludeTheSurfaceCostNoSamples) {
  const auto far = sphereField({10, 10, 10}, 0.5);
  EXPECT_TRUE(FieldSource(far, {.box = kUnitBox, .voxelSize = 1.0 / 64}).surfaceBlocks({}).coords.empty());
  EXPECT_EQ(far->points(), 0u);
  const auto halfKnown =
      std::make_shared<CountingField>([](const Vec3d&) { return 1.0; }, [](const Vec3d&) { return Vec3d{}; },
                                      [](const Box&) {
                                        return Interval{0.2, kInfinity};
                                      });
  EXPECT_TRUE(FieldSource(halfKnown, {.box = kUnitBox, .voxelSize = 1.0 / 64}).surfaceBlocks({}).coords.empty());
  EXPECT_EQ(halfKnown->points(), 0u);
}

TEST(FieldSource, BoundedFieldsKeepTheirSmallestParts) {
  // Off every fourth lattice point, around one lattice point only.
  const auto speck = sphereField({0.03, 0.031, 0.033}, 0.01);
  const FieldSource source(speck, {.box = kUnitBox, .voxelSize = 1.0 / 64});
  EXPECT_EQ(crossings(source).size(), 6u);
}

TEST(FieldSource, UnboundedFieldsAreFoundOnTheCoarseLattice) {
  const FieldSourceOptions options{.box = kUnitBox, .voxelSize = 1.0 / 32};
  const SurfaceBlocks known = FieldSource(sphereField({0, 0, 0}, 0.6), options).surfaceBlocks({});
  const auto field = sphereField({0, 0, 0}, 0.6, false);
  const SurfaceBlocks found = FieldSource(field, options).surfaceBlocks({});
  EXPECT_EQ(found.coords, known.coords);
  EXPECT_EQ(field->points(), 8u * 8 * 8 * 27 + found.coords.size() * 729);
}

TEST(FieldSource, SurfaceIsFollowedFromWhereItWasSeen) {
  // A rod thinner than the coarse lattice and off all its points, with a knob at one end that is not.
  const double voxel = 2.0 / 128;
  const auto field = [=](const CountingField::BoundFunction& bound) {
    const auto value = [=](const Vec3d& p) {
      const double rod = std::max(std::hypot(p.y - 0.03, p.z + 0.47 * p.x) - 0.8 * voxel, std::abs(p.x) - 0.9);
      return std::min(rod, length(p - Vec3d{0.85, 0.03, -0.4}) - 0.06);
    };
    return std::make_shared<CountingField>(
        value, [](const Vec3d&) { return Vec3d{}; }, bound);
  };
  const auto halfKnown = [](const Box&) { return Interval{-100, 100}; };
  const FieldSourceOptions options{.box = kUnitBox, .voxelSize = voxel};
  const SurfaceBlocks all = FieldSource(field(halfKnown), options).surfaceBlocks({});
  const SurfaceBlocks followed = FieldSource(field(unknownBound), options).surfaceBlocks({});
  EXPECT_GT(all.coords.size(), 15u);
  EXPECT_EQ(followed.coords, all.coords);
  for (std::size_t i = 0; i < std::min(all.signs.size(), followed.signs.size()); ++i)
    EXPECT_EQ(all.signs[i].row, followed.signs[i].row);
  expectWellFormed(followed, {16, 16, 16});
}

TEST(FieldSource, SolidIsCappedAtTheBox) {
  // The box is no whole number of voxels; its corner is at a place that rounds.
  const Box box{{0.1, -0.3, 7.7}, {1.13, 0.91, 9.3}};
  for (const double voxel : {0.07, 0.1}) {
    const FieldSource source(fieldOfX([](double) { return -1.0; }), {.box = box, .voxelSize = voxel});
    const SurfaceBlocks surface = source.surfaceBlocks({});
    expectWellFormed(surface, {1000, 1000, 1000});
    const auto found = crossings(source, surface);
    EXPECT_FALSE(found.empty());
    Vec3d lo{kInfinity, kInfinity, kInfinity}, hi = -lo;
    for (const auto& [edge, crossing] : found) {
      const int axis = edge[0];
      Vec3d outward{};
      outward[axis] = crossing.position[axis] > box.center()[axis] ? 1 : -1;
      EXPECT_EQ(crossing.normal, outward);
      const double wall = outward[axis] > 0 ? box.hi[axis] : box.lo[axis];
      EXPECT_NEAR(crossing.position[axis], wall, voxel * 0x1p-19);
      lo[axis] = std::min(lo[axis], crossing.position[axis]);
      hi[axis] = std::max(hi[axis], crossing.position[axis]);
    }
    for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(hi[axis] - lo[axis], box.hi[axis] - box.lo[axis], 1e-6);
  }
}

TEST(FieldSource, ClosedLatticeHasNoSurfaceOnItsLimits) {
  for (const int resolution : {7, 8, 61, 63, 64, 65}) {
    const Box box{{-0.1, -0.1, -0.1}, {0.7, 0.7, 0.7}};
    const FieldSource source(fieldOfX([](double) { return -1.0; }), {.box = box, .voxelSize = 0.8 / resolution});
    for (const auto& [edge, crossing] : crossings(source)) {
      for (int axis = 0; axis < 3; ++axis) {
        const int at = edge[static_cast<std::size_t>(axis) + 1];
        EXPECT_GE(at, axis == edge[0] ? 0 : 1);
        EXPECT_LT(at, resolution);
      }
    }
  }
}

TEST(FieldSource, OpenSurfaceEndsAtTheLattice) {
  const FieldSource source(sphereField({0, 0, 0}, 1.2), {.box = kUnitBox, .voxelSize = 0.1, .open = true});
  const SurfaceBlocks surface = source.surfaceBlocks({});
  EXPECT_TRUE(surface.open);
  expectWellFormed(surface, {3, 3, 3});
  int cells = 0;
  for (std::size_t i = 0; i < surface.coords.size(); ++i) {
    EXPECT_FALSE(surface.signs[i].cells.none());
    for (int x = 0; x < 8; ++x)
      for (int y = 0; y < 8; ++y)
        for (int z = 0; z < 8; ++z) {
          const Coord& b = surface.coords[i];
          const bool within = 8 * b[0] + x < 20 && 8 * b[1] + y < 20 && 8 * b[2] + z < 20;
          EXPECT_EQ(surface.signs[i].cells.test(x, y, z), within);
          cells += within;
        }
  }
  EXPECT_GT(cells, 0);
  for (const auto& [edge, crossing] : crossings(source, surface))
    EXPECT_NEAR(length(crossing.position), 1.2, 0.1 * 0x1p-19);
}

TEST(FieldSource, IsoMovesTheSurface) {
  const FieldSource source(sphereField({0, 0, 0}, 0.5), {.box = kUnitBox, .voxelSize = 0.1, .iso = 0.25});
  const auto found = crossings(source);
  EXPECT_FALSE(found.empty());
  for (const auto& [edge, crossing] : found) EXPECT_NEAR(length(crossing.position), 0.75, 0.1 * 0x1p-19);
}

TEST(FieldSource, ZeroIsOutsideAndNanIsOutside) {
  const auto empty = [](std::function<double(double)> f) {
    return FieldSource(fieldOfX(std::move(f)), {.box = kUnitBox, .voxelSize = 0.1, .acceptNonFinite = true})
        .surfaceBlocks({})
        .coords.empty();
  };
  EXPECT_TRUE(empty([](double) { return 0.0; }));
  EXPECT_TRUE(empty([](double) { return kNan; }));
  EXPECT_FALSE(empty([](double) { return -std::numeric_limits<double>::min(); }));
}

TEST(FieldSource, SameBlocksForAnyNumberOfThreads) {
  const FieldSource source(sphereField({0.1, 0, 0}, 0.8, false), {.box = kUnitBox, .voxelSize = 1.0 / 64});
  SurfaceBlocks one, many;
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, 4);
  tbb::task_arena(1).execute([&] { one = source.surfaceBlocks({}); });
  tbb::task_arena(4).execute([&] { many = source.surfaceBlocks({}); });
  EXPECT_EQ(one.coords, many.coords);
  ASSERT_EQ(one.signs.size(), many.signs.size());
  for (std::size_t i = 0; i < one.signs.size(); ++i) EXPECT_EQ(one.signs[i].row, many.signs[i].row);
}

TEST(FieldSource, StopEndsTheWorkWithinABlock) {
  std::atomic<bool> stop{false};
  std::atomic<std::size_t> evaluatedAfterStop{0};
  const auto value = [&](const Vec3d& p) {
    if (stop) ++evaluatedAfterStop;
    if (length(p) < 0.1) stop = true;
    return length(p) - 0.5;
  };
  const auto field = std::make_shared<CountingField>(
      value, [](const Vec3d&) { return Vec3d{}; }, unknownBound);
  const FieldSource source(field, {.box = kUnitBox, .voxelSize = 1.0 / 256});
  const Monitor monitor{.progress = {}, .stop = &stop};
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, 4);
  tbb::task_arena(4).execute([&] { EXPECT_THROW((void)source.surfaceBlocks(monitor), Cancelled); });
  EXPECT_LE(evaluatedAfterStop, 4u * (729 + 27));
}

TEST(FieldSource, ExceptionsOfTheFieldPassThrough) {
  const FieldSource source(fieldOfX([](double) -> double { throw std::domain_error("no"); }),
                           {.box = kUnitBox, .voxelSize = 0.1});
  EXPECT_THROW((void)source.surfaceBlocks({}), std::domain_error);
}

TEST(FieldSource, ReportsProgressUpToTheWhole) {
  std::vector<double> shares;
  Monitor monitor;
  monitor.progress = [&](const char* stage, double share) {
    EXPECT_STREQ(stage, "sample");
    shares.push_back(share);
  };
  (void)FieldSource(sphereField({0, 0, 0}, 0.7, false), {.box = kUnitBox, .voxelSize = 1.0 / 128})
      .surfaceBlocks(monitor);
  ASSERT_GE(shares.size(), 2u);
  EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
  EXPECT_EQ(shares.back(), 1);
}

TEST(FieldSource, BadOptionsNameValueAndLimit) {
  EXPECT_EQ(messageOf({.box = kUnitBox, .voxelSize = 0}), "voxel size must be positive and finite, not 0");
  EXPECT_EQ(messageOf({.box = kUnitBox, .voxelSize = kNan}), "voxel size must be positive and finite, not nan");
  EXPECT_EQ(messageOf({.box = {{0, 0, 0}, {1, 0, 1}}, .voxelSize = 1}),
            "box must be finite and not empty, not go from 0 to 0 along y");
  EXPECT_EQ(messageOf({.box = {{0, 0, 0}, {1, 1, kInfinity}}, .voxelSize = 1}),
            "box must be finite and not empty, not go from 0 to inf along z");
  EXPECT_EQ(messageOf({.box = kUnitBox, .voxelSize = 1e-6}),
            "voxels per axis must be at most 1048576, not 2000000 along x");
  EXPECT_EQ(messageOf({.box = {{1e9, 0, 0}, {1e9 + 1, 1, 1}}, .voxelSize = 0.1}),
            "voxel size must be at least 0.23283064388670027 at these coordinates, not 0.1");
  EXPECT_EQ(messageOf({.box = kUnitBox, .voxelSize = 1, .iso = kNan}), "iso value must be finite, not nan");
  EXPECT_EQ(messageOf({.box = kUnitBox, .voxelSize = 1e9}), "no error");
  EXPECT_THROW(FieldSource(nullptr, {.box = kUnitBox, .voxelSize = 1}), std::invalid_argument);
}

}  // namespace
}  // namespace pdc
