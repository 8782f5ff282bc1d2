#include "extract/certify/ambiguous_cells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "extract/certify/brute_force.h"
#include "extract/certify/uncertified_mesh.h"

namespace pdc::detail {
namespace {

/// A mesh with each vertex in its cell, and none at its safe place if that can be helped.
struct InCells {
  explicit InCells(std::mt19937& random) : source(randomGrid(random, 7, false)), input(source, 0.02) {
    std::uniform_real_distribution<float> inCell(-0.49F, 0.49F);
    for (std::size_t i = 0; i < input.working.vertices().size(); ++i)
      input.working.moveTo(i, {inCell(random), inCell(random), inCell(random)});
    for (const EdgeRef& e : input.edges()) (passes(e) ? regular : others).push_back(e);
  }

  [[nodiscard]] bool passes(const EdgeRef& e) const {
    return input.working.faces().passes(e, input.mesh.quads[input.working.edgeCells().face(e)]);
  }

  SignSource source;
  UncertifiedMesh input;
  std::vector<EdgeRef> regular, others;  ///< Faces whose diagonals pass their lattice edge, and those whose do not.
};

TEST(AmbiguousCells, FacesThatPassMeetNowhereElse) {
  std::mt19937 random(31);
  std::size_t meeting = 0;
  for (int grid = 0; grid < 20; ++grid) {
    const InCells in(random);
    const std::vector<EdgeRef> list = facesMeetingInCells(in.input.working, in.others);
    const std::set<EdgeRef> found(list.begin(), list.end());
    std::set<EdgeRef> expected;
    for (const Conflict& c : BruteForce(in.input).conflicts(in.regular))
      if (!std::binary_search(in.others.begin(), in.others.end(), c.edge0) &&
          !std::binary_search(in.others.begin(), in.others.end(), c.edge1))
        expected.insert({c.edge0, c.edge1});
    EXPECT_EQ(found, expected);
    meeting += found.size();
  }
  EXPECT_GT(meeting, 200U);
}

}  // namespace
}  // namespace pdc::detail
