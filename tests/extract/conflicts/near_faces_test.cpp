#include "extract/conflicts/near_faces.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <atomic>
#include <random>

#include "extract/certify/brute_force.h"
#include "extract/certify/uncertified_mesh.h"
#include "simd_levels.h"

namespace pdc::detail {
namespace {

std::vector<EdgeRef> facesOf(const std::vector<Conflict>& conflicts) {
  std::vector<EdgeRef> edges;
  for (const Conflict& c : conflicts) edges.insert(edges.end(), {c.edge0, c.edge1});
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

/// Compares with brute force, with all suspect vertices where they are, and again after some have been retracted and
/// some faces became fans. \returns the number of conflicts compared.
std::size_t compareWithBruteForce(const HermiteSource& source, double sigma, SimdLevel level) {
  UncertifiedMesh input(source, sigma);
  const std::vector<EdgeRef> active = input.active();
  NearFaces near(input.working.faces(), input.progress, level);
  const std::vector<Conflict> found = near.findConflicts(active);
  EXPECT_EQ(found, BruteForce(input).conflicts(active));

  std::vector<std::size_t> retracted;
  for (std::size_t i = 0; i < input.suspects.vertices.size(); i += 3) retracted.push_back(i);
  for (const std::size_t i : retracted) input.working.retract(i);
  std::vector<EdgeRef> changed = input.working.quadsAt(retracted);
  const std::vector<EdgeRef> conflicting = facesOf(found);
  for (std::size_t i = 0; i < conflicting.size(); i += 2) {
    input.working.fans().add(conflicting[i]);
    changed.push_back(conflicting[i]);
  }
  std::sort(changed.begin(), changed.end());
  changed.erase(std::unique(changed.begin(), changed.end()), changed.end());
  const std::vector<Conflict> again = near.findConflicts(changed);
  EXPECT_EQ(again, BruteForce(input).conflicts(changed));
  return found.size() + again.size();
}

TEST(NearFaces, FindWhatBruteForceFinds) {
  std::mt19937 random(1);
  const SignSource noisy = randomGrid(random, 7, false), noisyCreases = randomGrid(random, 7, true);
  const FieldSource creased = creasedSolid(24);
  for (const SimdLevel level : test::simdLevels()) {
    EXPECT_GT(compareWithBruteForce(noisy, 0.02, level), 100U);
    EXPECT_GT(compareWithBruteForce(noisyCreases, 0.02, level), 100U);
    EXPECT_GT(compareWithBruteForce(creased, 0, level), 10U);
  }
}

TEST(NearFaces, TurnedQuadsAreSoundWhereBruteForceFindsNoConflict) {
  std::mt19937 random(2);
  const SignSource source = randomGrid(random, 6, true);
  UncertifiedMesh input(source, 0.02);
  const std::vector<EdgeRef> active = input.active();
  NearFaces near(input.working.faces(), input.progress);
  (void)near.findConflicts(active);
  std::vector<Quad> turned;
  for (const EdgeRef& e : active) turned.push_back(input.working.turned(e));
  const std::vector<std::uint8_t> sound = near.soundWhenTurned(active, turned);
  ASSERT_EQ(sound.size(), active.size());
  int seen[2] = {0, 0};
  for (std::size_t i = 0; i < active.size(); ++i) {
    Quad& quad = input.mesh.quads[input.working.edgeCells().face(active[i])];
    const Quad before = std::exchange(quad, turned[i]);
    ASSERT_EQ(sound[i] != 0, BruteForce(input).conflicts({active[i]}).empty()) << "quad " << i;
    quad = before;
    ++seen[sound[i]];
  }
  EXPECT_GT(seen[0], 10);
  EXPECT_GT(seen[1], 10);
}

TEST(NearFaces, StopWhenAsked) {
  std::mt19937 random(3);
  const SignSource source = randomGrid(random, 5, false);
  std::atomic<bool> stop{false};
  const Monitor monitor{.progress = {}, .stop = &stop};
  UncertifiedMesh input(source, 0.02, monitor);
  const std::vector<EdgeRef> active = input.active();
  ASSERT_FALSE(active.empty());
  NearFaces near(input.working.faces(), input.progress);
  std::vector<Quad> turned;
  for (const EdgeRef& e : active) turned.push_back(input.working.turned(e));
  stop = true;
  EXPECT_THROW((void)near.findConflicts(active), Cancelled);
  EXPECT_THROW((void)near.soundWhenTurned(active, turned), Cancelled);
}

TEST(NearFaces, StopInTheMiddleOfARound) {
  std::mt19937 random(3);
  const SignSource source = randomGrid(random, 20, false);
  std::atomic<bool> stop{false};
  std::atomic<int> calls{0};
  const Monitor monitor{.progress =
                            [&](const char*, double share) {
                              ++calls;
                              if (share > 0) stop = true;
                            },
                        .stop = &stop};
  UncertifiedMesh input(source, 0.02, monitor);
  const std::vector<EdgeRef> active = input.active();
  ASSERT_GT(active.size(), 4000U) << "there must be something left to do";
  NearFaces near(input.working.faces(), input.progress);
  EXPECT_THROW((void)near.findConflicts(active), Cancelled);
  EXPECT_LE(calls, 2 + tbb::this_task_arena::max_concurrency());
}

}  // namespace
}  // namespace pdc::detail
