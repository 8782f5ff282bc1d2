#include "extract/conflicts/far_faces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <set>

#include "extract/certify/uncertified_mesh.h"

namespace pdc::detail {
namespace {

Float4Box boxOf(const UncertifiedMesh& input, const EdgeRef& e) {
  const std::vector<Triangle> triangles = input.triangles(e);
  Float4Box box(input.working.faces().corners(triangles[0]));
  for (const Triangle& t : triangles) box.add(Float4Box(input.working.faces().corners(t)));
  return box;
}

/// Expects the lists to hold every face whose box meets that of a listed face. \returns how many those were.
std::size_t expectAllThatMeet(const UncertifiedMesh& input, const FarFaces& lists,
                              const std::vector<EdgeRef>& farReaching) {
  std::size_t count = 0;
  for (const EdgeRef& e : farReaching) {
    const Float4Box box = boxOf(input, e);
    std::set<EdgeRef> visited;
    EXPECT_TRUE(lists.forEachNear(e, box, [&](const EdgeRef& other) { return visited.insert(other).second; }));
    EXPECT_FALSE(visited.contains(e));
    for (const EdgeRef& other : input.edges())
      if (other != e && !box.apartFrom(boxOf(input, other))) {
        ++count;
        EXPECT_TRUE(visited.contains(other));
      }
  }
  return count;
}

class FarFacesTest : public testing::Test {
 protected:
  const FieldSource mSource = creasedSolid(48);
  UncertifiedMesh mInput{mSource, 0};
  const std::vector<EdgeRef> mFar = mInput.active();
  const FaceLocator mLocator{mInput.working.faces(), mFar, {}};
  std::vector<Triangle> mRoom;
};

TEST_F(FarFacesTest, ListWhatMayMeetAFace) {
  FarFaces lists(mInput.working.faces(), mLocator, mFar, bestSimdLevel(), {});
  for (const EdgeRef& e : mFar) lists.update(e, mRoom);
  EXPECT_GT(expectAllThatMeet(mInput, lists, mFar), mFar.size());
}

TEST_F(FarFacesTest, HoldWhileVerticesAreRetractedAndQuadsBecomeFans) {
  FarFaces lists(mInput.working.faces(), mLocator, mFar, bestSimdLevel(), {});
  for (std::size_t i = 0; i < mInput.working.vertices().size(); ++i)
    for (std::size_t step = 0; step < i % 9; ++step) mInput.working.retract(i);
  const std::vector<EdgeRef> edges = mInput.edges();
  for (std::size_t i = 0; i < edges.size(); i += 5) mInput.working.fans().add(edges[i]);
  for (const EdgeRef& e : mFar) lists.update(e, mRoom);
  std::size_t within = 0;
  std::vector<EdgeRef> stillListed;
  for (const EdgeRef& e : mFar)
    if (lists.forEachNear(e, boxOf(mInput, e), [](const EdgeRef&) { return false; })) stillListed.push_back(e);
  within = expectAllThatMeet(mInput, lists, stillListed);
  EXPECT_GT(stillListed.size(), mFar.size() / 2);
  EXPECT_GT(within, stillListed.size());
}

TEST_F(FarFacesTest, HaveNoListForOtherFacesOrBoxes) {
  const FarFaces lists(mInput.working.faces(), mLocator, mFar, bestSimdLevel(), {});
  const auto never = [](const EdgeRef&) {
    ADD_FAILURE() << "no face should be visited";
    return true;
  };
  for (const EdgeRef& e : mInput.edges())
    if (!std::binary_search(mFar.begin(), mFar.end(), e)) {
      EXPECT_FALSE(lists.forEachNear(e, boxOf(mInput, e), never));
    }
  Float4Box large = boxOf(mInput, mFar[0]);
  large.add(float4({9, 9, 9}));
  EXPECT_FALSE(lists.forEachNear(mFar[0], large, never));
}

TEST_F(FarFacesTest, AreNotListedWhereTheyAreMost) {
  const std::vector<EdgeRef> all = mInput.edges();
  const FaceLocator locator(mInput.working.faces(), all, {});
  const FarFaces lists(mInput.working.faces(), locator, all, bestSimdLevel(), {});
  EXPECT_FALSE(lists.forEachNear(all[0], boxOf(mInput, all[0]), [](const EdgeRef&) { return true; }));
}

TEST_F(FarFacesTest, StopWhenAsked) {
  const std::atomic<bool> stop{true};
  const Monitor monitor{.progress = {}, .stop = &stop};
  EXPECT_THROW(FarFaces(mInput.working.faces(), mLocator, mFar, bestSimdLevel(), monitor), Cancelled);
}

}  // namespace
}  // namespace pdc::detail
