#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <random>

#include "parallel/with_threads.h"
#include "pdc/mesh/mesh_report.h"
#include "pdc/simplify/decimate.h"
#include "simplify/quadric_kinds.h"
#include "simplify/shapes.h"

namespace pdc {
namespace {

using Random = std::mt19937;

std::uint32_t below(Random& random, std::size_t n) { return static_cast<std::uint32_t>(random() % n); }

/// A small mesh of one of several kinds.
Mesh someMesh(Random& random) {
  const int n = 2 + static_cast<int>(below(random, 6));
  switch (below(random, 4)) {
    case 0:
      return test::plate(2 * n);
    case 1:
      return test::cube(n);
    case 2:
      return test::sphere(n);
    default:
      return test::torus(n + 2);
  }
}

/// Some corners get vertices of their own, as all of them have in a soup.
void unweld(Mesh& mesh, Random& random, std::uint32_t percent) {
  for (Triangle& t : mesh.triangles)
    for (std::uint32_t& v : t) {
      if (below(random, 100) >= percent) continue;
      mesh.positions.push_back(mesh.positions[v]);
      v = static_cast<std::uint32_t>(mesh.positions.size() - 1);
    }
}

Mesh damagedMesh(Random& random) {
  Mesh mesh = someMesh(random);
  const std::size_t faces = mesh.triangles.size();
  if (below(random, 2) == 0) unweld(mesh, random, below(random, 2) == 0 ? 100 : 10);
  for (std::size_t i = below(random, faces / 4); i > 0; --i)
    std::swap(mesh.triangles[below(random, faces)][0], mesh.triangles[below(random, faces)][1]);
  for (std::size_t i = below(random, faces / 8); i > 0; --i) {
    Triangle t = mesh.triangles[below(random, faces)];
    if (below(random, 2) == 0) std::swap(t[0], t[1]);
    mesh.triangles.push_back(t);
  }
  for (std::size_t i = below(random, 4); i > 0; --i)
    mesh.positions[below(random, mesh.positions.size())].y = std::numeric_limits<float>::quiet_NaN();
  if (below(random, 8) == 0) mesh.positions[0] = {3e38F, -3e38F, 1e-38F};
  if (below(random, 4) == 0)
    for (Vec3f& p : mesh.positions) p.z = 0;
  return mesh;
}

DecimateOptions someOptions(const Mesh& mesh, Random& random) {
  constexpr double kDistances[] = {1e-300, 1e-6, 0.1, 0.6, 1.1, 2};  // In mean edge lengths.
  DecimateOptions options;
  options.faces = below(random, 2) == 0 ? 0 : mesh.triangles.size() / 3;
  options.quadric = test::kQuadricKinds[below(random, 5)];
  options.placement = below(random, 3) == 0 ? CollapsePlacement::kSubset : CollapsePlacement::kMinimizer;
  options.lockBoundary = below(random, 5) == 0;
  options.maxTurn = below(random, 4) == 0 ? 90 : 75;
  options.pairDistance = MeshLength{kDistances[below(random, 6)], true};
  return options;
}

TEST(DamagedMeshes, PairsAreContractedAllTheSame) {
  std::size_t merged = 0, reached = 0;
  for (std::uint32_t seed = 0; seed < 300; ++seed) {
    Random random(seed);
    const Mesh mesh = damagedMesh(random);
    const DecimateOptions options = someOptions(mesh, random);
    DecimateReport report;
    const Mesh fewer = decimate(mesh, options, &report);
    const MeshReport facts = analyze(fewer);  // Throws for indices that do not exist.
    EXPECT_EQ(facts.degenerateFaces + facts.duplicateFaces + facts.unusedVertices + facts.nonFiniteVertices, 0u)
        << seed;
    EXPECT_LE(fewer.triangles.size(), mesh.triangles.size());
    EXPECT_EQ(facts.components, report.pairs->componentsAfter) << seed;
    merged += report.pairs->merges > 0;
    reached += report.end == DecimateEnd::kReached;
    if (seed % 10 != 0) continue;
    const Mesh again = detail::withThreads(3, [&] { return decimate(mesh, options); });
    ASSERT_EQ(again.triangles, fewer.triangles) << seed;
    EXPECT_EQ(std::memcmp(again.positions.data(), fewer.positions.data(), fewer.positions.size() * sizeof(Vec3f)), 0);
  }
  EXPECT_GT(merged, 100u) << "or the test shows little";
  EXPECT_GT(reached, 100u);
}

}  // namespace
}  // namespace pdc
