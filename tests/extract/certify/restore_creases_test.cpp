#include "extract/certify/restore_creases.h"

#include <gtest/gtest.h>

#include <atomic>

#include "extract/certify/uncertified_mesh.h"

namespace pdc::detail {
namespace {

/// A creased solid whose suspect vertices have all been retracted half of the way.
class RestoreCreasesTest : public testing::Test {
 protected:
  RestoreCreasesTest() {
    for (std::size_t i = 0; i < mInput.working.vertices().size(); ++i)
      for (int step = 0; step < 5; ++step) mInput.working.retract(i);
  }

  const FieldSource mSource = creasedSolid(48);
  std::atomic<bool> mStop{false};
  const Monitor mMonitor{.progress = {}, .stop = &mStop};
  UncertifiedMesh mInput{mSource, 0, mMonitor};
  const std::vector<EdgeRef> mActive = mInput.active();
  NearFaces mNear{mInput.working.faces(), mInput.progress};
};

TEST_F(RestoreCreasesTest, VerticesGetBackWithoutNewConflicts) {
  const std::size_t conflicts = mNear.findConflicts(mActive).size();
  const std::vector<VertexState> before = mInput.working.vertices();
  restoreCreases(mInput.working, mNear);
  std::size_t moved = 0, back = 0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    const VertexState& v = mInput.working.vertices()[i];
    moved += v.place != before[i].place;
    back += v.place == v.wanted;
    ASSERT_EQ(mInput.mesh.positions[v.vertex], mInput.working.faces().worldPosition(v, v.place));
  }
  EXPECT_GT(moved, before.size() / 2);
  EXPECT_GT(back, before.size() / 2);
  EXPECT_LE(mNear.findConflicts(mActive).size(), conflicts);
}

TEST_F(RestoreCreasesTest, StopsWhenAsked) {
  (void)mNear.findConflicts(mActive);
  mStop = true;
  EXPECT_THROW(restoreCreases(mInput.working, mNear), Cancelled);
}

}  // namespace
}  // namespace pdc::detail
