// Whatever is decimated or clustered, there is a mesh or an Error.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <random>
#include <set>
#include <stdexcept>
#include <string>

#include "mesh/faces.h"
#include "pdc/error.h"
#include "pdc/mesh/mesh_report.h"
#include "pdc/mesh/self_intersections.h"
#include "pdc/simplify/cluster.h"
#include "pdc/simplify/decimate.h"
#include "simplify/damage/damaged_meshes.h"

namespace pdc {
namespace {

constexpr std::array kKinds{QuadricKind::kPlane, QuadricKind::kTriangle, QuadricKind::kProbabilisticPlane,
                            QuadricKind::kProbabilisticTriangle, QuadricKind::kPoint};

/// Options of all kinds, the extreme ones included.
class SomeOptions {
 public:
  explicit SomeOptions(std::uint32_t seed) : mEngine(~seed) {}

  DecimateOptions decimate() {
    DecimateOptions o;
    if (mEngine() % 2 == 0) {
      o.faces = mEngine() % 40;
    } else {
      o.ratio = oneOf(1e-9, 0.1, 0.5, 0.9);
    }
    o.quadric = kKinds[mEngine() % kKinds.size()];
    o.placement = mEngine() % 4 == 0 ? CollapsePlacement::kSubset : CollapsePlacement::kMinimizer;
    if (mEngine() % 2 == 0) o.sigmaNormal = oneOf(0, 1e-200, 0.05, 1e30);
    if (mEngine() % 2 == 0) o.sigmaPosition = oneOf(0, 1e-200, 0.05, 1e30);
    if (mEngine() % 2 == 0) o.memory = oneOf(0, 1e-9, 0.5, 1);
    o.maxTurn = oneOf(1e-3, 20, 75, 90);
    o.boundaryWeight = oneOf(0, 1, 10, 1e30);
    o.lockBoundary = mEngine() % 4 == 0;
    o.sound = mEngine() % 4 == 0;
    o.fit = mEngine() % 4 != 0;
    return o;
  }

  ClusterOptions cluster() {
    ClusterOptions o;
    o.cell = oneOf(0.01, 0.3, 3, 3e38);
    o.quadric = kKinds[mEngine() % kKinds.size()];
    o.sigmaNormal = oneOf(0, 1e-200, 0.05, 1e30);
    o.sigmaPosition = oneOf(0, 1e-200, 0.05, 1e30);
    o.free = mEngine() % 2 == 0;
    o.clean = mEngine() % 2 == 0;
    return o;
  }

 private:
  double oneOf(double a, double b, double c, double d) { return std::array{a, b, c, d}[mEngine() % 4]; }

  std::mt19937 mEngine;
};

/// The triangles that a mesh's faces stand for and that name three vertices with finite places.
Mesh usableTriangles(const Mesh& mesh) {
  Mesh usable;
  usable.positions = mesh.positions;
  for (std::size_t i = 0; i < detail::triangleCount(mesh); ++i) {
    const Triangle t = detail::triangle(mesh, i);
    const auto isUsable = [&](std::uint32_t v) { return detail::isFinite(mesh.positions[v]); };
    if (std::all_of(t.begin(), t.end(), isUsable) && t[0] != t[1] && t[1] != t[2] && t[2] != t[0])
      usable.triangles.push_back(t);
  }
  return usable;
}

void expectWhole(const Mesh& mesh) {
  for (const Triangle& t : mesh.triangles)
    for (const std::uint32_t v : t) ASSERT_LT(v, mesh.positions.size());
  EXPECT_TRUE(mesh.quads.empty());
  const MeshReport report = analyze(mesh);
  EXPECT_EQ(report.degenerateFaces + report.unusedVertices, 0u);
  EXPECT_EQ(report.nonFiniteVertices, 0u);
  for (const VertexProperty& p : mesh.properties)
    EXPECT_EQ(std::visit([](const auto& values) { return values.size(); }, p.values),
              mesh.positions.size() * static_cast<std::size_t>(p.components));
  EXPECT_TRUE(mesh.normals.empty() || mesh.normals.size() == mesh.positions.size());
}

void expectDecimated(const Mesh& mesh, const DecimateOptions& options) {
  DecimateReport report;
  const Mesh fewer = decimate(mesh, options, &report);
  expectWhole(fewer);
  EXPECT_EQ(report.facesAfter, fewer.triangles.size());
  EXPECT_EQ(report.verticesAfter, fewer.positions.size());
  EXPECT_LE(report.facesAfter + report.degenerateFaces, report.facesBefore);
  const Mesh usable = usableTriangles(mesh);
  EXPECT_LE(analyze(fewer).nonManifoldEdges, analyze(usable).nonManifoldEdges);
  if (!options.sound) return;
  const SelfIntersections before = selfIntersections(usable), after = selfIntersections(fewer);
  if (before.pairs.empty() && before.degenerateTriangles == 0) {
    EXPECT_TRUE(after.pairs.empty());
  }
}

struct Counts {
  std::size_t meshes = 0, errors = 0;
};

/// Decimates and clusters meshes, of which each has a number.
template <typename Make>
Counts simplifyAll(std::uint32_t count, const Make& make) {
  Counts counts;
  for (std::uint32_t seed = 0; seed < count && !testing::Test::HasFailure(); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Mesh mesh = make(seed);
    SomeOptions some(seed);
    try {
      expectDecimated(mesh, some.decimate());
      ++counts.meshes;
    } catch (const Error&) {
      ++counts.errors;
    }
    try {
      expectWhole(cluster(mesh, some.cluster()));
      ++counts.meshes;
    } catch (const Error&) {
      ++counts.errors;
    }
  }
  return counts;
}

std::uint32_t times(std::uint32_t usual, std::uint32_t most) {
  return std::getenv("PDC_LONG_TESTS") != nullptr ? most : usual;
}

TEST(Damage, DamagedMeshesGiveAMeshOrAnError) {
  const Counts counts = simplifyAll(times(1000, 4000), test::damagedMesh);
  EXPECT_GT(counts.meshes, 10 * counts.errors);
  EXPECT_GT(counts.errors, 10u);
}

TEST(Damage, DegenerateMeshesGiveAMesh) {
  const Counts counts = simplifyAll(times(400, 1600), test::degenerateMesh);
  EXPECT_GT(counts.meshes, counts.errors) << "clustering refuses what is too far away for its cells";
}

}  // namespace
}  // namespace pdc
