#include "extract/certify/remedies.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <random>
#include <set>

#include "extract/certify/uncertified_mesh.h"

namespace pdc::detail {
namespace {

/// A mesh with its conflicts, before any remedy.
struct Conflicting {
  explicit Conflicting(const HermiteSource& source, const Monitor& monitor = kUnstopped)
      : input(source, 0.02, monitor),
        active(input.active()),
        near(input.working.faces(), input.progress),
        conflicts(near.findConflicts(active)) {}

  UncertifiedMesh input;
  std::vector<EdgeRef> active;
  NearFaces near;
  std::vector<Conflict> conflicts;
};

SignSource noise() {
  std::mt19937 random(41);
  return randomGrid(random, 6, false);
}

bool contains(const std::vector<EdgeRef>& edges, const EdgeRef& e) {
  return std::find(edges.begin(), edges.end(), e) != edges.end();
}

/// Whether `rest` are the conflicts of `before` that do not satisfy `taken`.
template <typename Taken>
bool areTheRest(const std::vector<Conflict>& rest, std::vector<Conflict> before, Taken&& taken) {
  std::erase_if(before, taken);
  return rest == before;
}

TEST(TurnDiagonals, TurnsQuadsOnceWhereThatIsSound) {
  const SignSource source = noise();
  Conflicting c(source);
  const std::vector<Conflict> before = c.conflicts;
  const Buffer<Quad> quads = c.input.mesh.quads;
  const std::vector<EdgeRef> turned = turnDiagonals(c.input.working, c.near, c.conflicts);
  ASSERT_FALSE(turned.empty());
  EXPECT_TRUE(areTheRest(c.conflicts, before,
                         [&](const Conflict& o) { return contains(turned, o.edge0) || contains(turned, o.edge1); }));
  for (const EdgeRef& e : c.input.edges()) {
    const std::uint64_t face = c.input.working.edgeCells().face(e);
    EXPECT_EQ(c.input.mesh.quads[face] != quads[face], contains(turned, e));
  }
  std::vector<Conflict> same = before;
  for (const EdgeRef& e : turnDiagonals(c.input.working, c.near, same)) EXPECT_FALSE(contains(turned, e));
}

TEST(MoveAlongCreases, ConflictsAtFacesOfMovedVerticesWait) {
  const FieldSource source = creasedSolid(24);
  Conflicting c(source);
  const std::vector<Conflict> before = c.conflicts;
  const std::vector<EdgeRef> changed = moveAlongCreases(c.input.working, c.near, c.conflicts);
  std::vector<std::size_t> moved;
  std::set<std::uint32_t> corners;
  for (std::size_t i = 0; i < c.input.working.vertices().size(); ++i) {
    const VertexState& v = c.input.working.vertices()[i];
    ASSERT_EQ(v.creaseMoves, v.place != v.wanted ? 1 : 0);
    ASSERT_EQ(v.retractedFrom, v.place);
    if (v.creaseMoves != 0) moved.push_back(i);
  }
  ASSERT_FALSE(moved.empty());
  for (const EdgeRef& e : c.input.working.quadsAt(moved)) {
    EXPECT_TRUE(contains(changed, e));
    for (const std::uint32_t v : c.input.working.edgeCells().vertices(e)) corners.insert(v);
  }
  EXPECT_TRUE(areTheRest(c.conflicts, before, [&](const Conflict& o) {
    bool waits = false;
    forEachCorner(o, [&](std::uint32_t v) { waits = waits || corners.contains(v); });
    EXPECT_TRUE(!waits || (contains(changed, o.edge0) && contains(changed, o.edge1)));
    return waits;
  }));
  EXPECT_LT(c.near.findConflicts(c.active).size(), before.size());
}

/// \param most conflicts, all of which lie in one block. \param steps that their vertices then take.
void expectRetractions(std::size_t most, int steps) {
  const SignSource source = noise();
  Conflicting c(source);
  ASSERT_EQ(c.input.blocks.coords.size(), 1U);
  c.conflicts.resize(std::min(c.conflicts.size(), most));
  const std::vector<Conflict> before = c.conflicts;
  std::set<std::uint32_t> corners;
  for (const Conflict& o : before) forEachCorner(o, [&](std::uint32_t v) { corners.insert(v); });
  const std::vector<EdgeRef> changed = retractVertices(c.input.working, c.near, c.conflicts);
  EXPECT_TRUE(areTheRest(c.conflicts, before, [&](const Conflict& o) {
    bool movable = false;
    forEachCorner(o, [&](std::uint32_t v) { movable = movable || c.input.working.movable(v) >= 0; });
    return movable;
  }));
  std::vector<std::size_t> retracted;
  for (std::size_t i = 0; i < c.input.working.vertices().size(); ++i) {
    const VertexState& v = c.input.working.vertices()[i];
    ASSERT_EQ(v.retractions, corners.contains(static_cast<std::uint32_t>(v.vertex)) ? steps : 0);
    if (v.retractions != 0) retracted.push_back(i);
  }
  ASSERT_FALSE(retracted.empty());
  EXPECT_EQ(changed, c.input.working.quadsAt(retracted));
}

TEST(RetractVertices, RetractsTheVerticesOfConflictsByAStep) { expectRetractions(32, 1); }

TEST(RetractVertices, TakesThreeStepsWhereNoiseHasFoldedABlock) { expectRetractions(1000, 3); }

TEST(RetractVertices, LeavesConflictsOfFullyRetractedVertices) {
  const SignSource source = noise();
  Conflicting c(source);
  for (std::size_t i = 0; i < c.input.working.vertices().size(); ++i)
    while (!WorkingMesh::fullyRetracted(c.input.working.vertices()[i])) c.input.working.retract(i);
  const std::vector<Conflict> before = c.conflicts;
  EXPECT_TRUE(retractVertices(c.input.working, c.near, c.conflicts).empty());
  EXPECT_EQ(c.conflicts, before);
}

TEST(SubdivideFaces, MakesFansThenSplitsCellsThenGivesUp) {
  const SignSource source = noise();
  Conflicting c(source);
  const EdgeCells& cells = c.input.working.edgeCells();
  const auto atAmbiguousCell = [&](const Conflict& o) {
    const std::array<CellRef, 4> about = cells.cells(o.edge0);
    return std::any_of(about.begin(), about.end(),
                       [&](const CellRef& cell) { return kCellTable[cells.code(cell)].ambiguous; });
  };
  const auto found = std::find_if(c.conflicts.begin(), c.conflicts.end(), atAmbiguousCell);
  ASSERT_NE(found, c.conflicts.end());
  const std::vector<Conflict> one{*found};

  std::vector<Conflict> conflicts = one;
  std::vector<EdgeRef> expected{found->edge0, found->edge1};
  expected.erase(std::unique(expected.begin(), expected.end()), expected.end());
  EXPECT_EQ(subdivideFaces(c.input.working, c.near, conflicts), expected);
  EXPECT_TRUE(conflicts.empty());
  EXPECT_EQ(c.input.working.fans().size(), expected.size());
  const std::size_t rim = c.input.triangles(found->edge0).size();
  EXPECT_EQ(rim, 4U);

  conflicts = one;
  const std::vector<EdgeRef> changed = subdivideFaces(c.input.working, c.near, conflicts);
  EXPECT_TRUE(conflicts.empty());
  EXPECT_TRUE(contains(changed, found->edge0));
  for (const EdgeRef& e : changed) EXPECT_TRUE(c.input.working.fans().has(cells.face(e)));
  EXPECT_GT(c.input.triangles(found->edge0).size(), rim) << "its rim runs through vertices in faces of the split cell";

  conflicts = one;
  EXPECT_TRUE(subdivideFaces(c.input.working, c.near, conflicts).empty());
  EXPECT_EQ(conflicts, one);
}

TEST(Remedies, StopWhenAsked) {
  const SignSource source = noise();
  std::atomic<bool> stop{false};
  const Monitor monitor{.progress = {}, .stop = &stop};
  Conflicting c(source, monitor);
  ASSERT_FALSE(c.conflicts.empty());
  stop = true;
  for (Remedy* remedy : {turnDiagonals, moveAlongCreases, retractVertices, subdivideFaces}) {
    std::vector<Conflict> conflicts = c.conflicts;
    EXPECT_THROW((void)remedy(c.input.working, c.near, conflicts), Cancelled);
  }
}

}  // namespace
}  // namespace pdc::detail
