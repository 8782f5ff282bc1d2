#include "extract/certify/vertex_trial.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "extract/certify/brute_force.h"
#include "extract/certify/uncertified_mesh.h"
#include "extract/conflicts/near_faces.h"

namespace pdc::detail {
namespace {

/// What was compared.
struct Compared {
  int exactly = 0, withinBounds = 0, without = 0, more = 0;  ///< The last two: with no conflicts, with some.
};

/// Places about a vertex: its own, its safe one, between the two, and some in its neighbourhood, on the lattice too,
/// where faces are likely to touch.
std::vector<Vec3f> placesAbout(const SuspectVertex& v, const FaceTests& faces, std::mt19937& random) {
  std::uniform_real_distribution<float> offset(-1, 1);
  std::vector<Vec3f> places{v.place, v.safe, (v.place + v.safe) * 0.5F, {0.5F, 0.5F, 0.5F}, {0.5F, 0, -0.5F}};
  for (const float reach : {0.01F, 0.1F, 0.5F, 2.0F})
    places.push_back(v.place + Vec3f{offset(random), offset(random), offset(random)} * reach);
  std::vector<Vec3f> world(places.size());
  std::transform(places.begin(), places.end(), world.begin(),
                 [&](const Vec3f& p) { return faces.worldPosition(v, p); });
  return world;
}

/// Tries every `step`-th suspect vertex at several places, and compares with brute force.
Compared compareWithBruteForce(UncertifiedMesh& input, std::size_t step, std::mt19937& random) {
  const FaceTests& faces = input.working.faces();
  RoundProgress& progress = input.progress;
  NearFaces near(faces, progress);
  std::vector<std::size_t> all(input.suspects.vertices.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  const FaceBoxes& boxes = near.boxesAbout(input.working.vertices(), all);
  BruteForce bruteForce(input);
  Compared compared;
  constexpr std::size_t kAll = 1'000'000;
  for (std::size_t i = 0; i < input.suspects.vertices.size(); i += step) {
    const VertexState& v = input.working.vertices()[i];
    const std::vector<Vec3f> places = placesAbout(v, faces, random);
    VertexTrial trial(boxes, faces, v, places);
    for (std::size_t p = 0; p < places.size(); ++p) {
      const BruteForce::Count expected = bruteForce.countConflicts(static_cast<std::uint32_t>(v.vertex), places[p]);
      const std::size_t count = trial.countConflicts(p, kAll);
      EXPECT_GE(count, expected.least) << "vertex " << i << ", place " << p;
      EXPECT_LE(count, expected.most) << "vertex " << i << ", place " << p;
      // What is cached must not depend on where a count ended.
      for (const std::size_t most : {std::size_t{1}, std::size_t{3}}) {
        const bool reached = trial.countConflicts(p, most) >= most;
        EXPECT_TRUE(reached || expected.least < most) << "vertex " << i << ", place " << p;
        EXPECT_TRUE(!reached || expected.most >= most) << "vertex " << i << ", place " << p;
      }
      ++(expected.least == expected.most ? compared.exactly : compared.withinBounds);
      ++(count == 0 ? compared.without : compared.more);
    }
    if (testing::Test::HasFailure()) break;
  }
  return compared;
}

TEST(VertexTrial, CountsWhatBruteForceCountsInNoise) {
  std::mt19937 random(11);
  for (const bool exactNormals : {false, true}) {
    const SignSource source = randomGrid(random, 7, exactNormals);
    UncertifiedMesh input(source, 0.02);
    const Compared compared = compareWithBruteForce(input, 3, random);
    EXPECT_GT(compared.exactly, 100);
    EXPECT_GT(compared.more, 200);
  }
}

TEST(VertexTrial, CountsWhatBruteForceCountsAtCreases) {
  std::mt19937 random(12);
  const FieldSource source = creasedSolid(24);
  UncertifiedMesh input(source, 0);
  const Compared compared = compareWithBruteForce(input, 5, random);
  EXPECT_GT(compared.exactly, 100);
  EXPECT_GT(compared.without, 50);
  EXPECT_GT(compared.more, 50);
}

TEST(VertexTrial, CountsTheTrianglesOfFans) {
  std::mt19937 random(13);
  const SignSource source = randomGrid(random, 6, true);
  UncertifiedMesh input(source, 0.02);
  const std::vector<EdgeRef> edges = input.edges();
  for (std::size_t i = 0; i < edges.size(); i += 3) input.working.fans().add(edges[i]);
  const Compared compared = compareWithBruteForce(input, 3, random);
  EXPECT_GT(compared.exactly, 50);
  EXPECT_GT(compared.more, 100);
}

}  // namespace
}  // namespace pdc::detail
