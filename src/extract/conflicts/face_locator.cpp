#include "extract/conflicts/face_locator.h"

#include <tbb/parallel_for.h>

#include "extract/vertices/vertex_solver.h"

namespace pdc::detail {
namespace {

/// How far, along an axis, a face may reach from the low end of its lattice edge wherever its vertices are.
constexpr double kFreeReach = kFreeHalfSize + 0.5;

}  // namespace

FaceLocator::FaceLocator(const FaceTests& faces, const std::vector<EdgeRef>& farReaching, const Monitor& monitor)
    : mFaces(faces),
      mToLattice(faces.map().affine() ? inverse(faces.map().jacobian({})) : Mat3d::identity()),
      mOrigin(faces.map().affine() ? faces.map().position({}) : Vec3d{}),
      mFar(faces.edgeCells().blockCount(), farReaching),
      mReach(mFar.size(), kCellReach) {
  std::vector<double> reach(farReaching.size());
  tbb::parallel_for(std::size_t{0}, reach.size(), [&](std::size_t i) {
    monitor.throwIfStopped();
    reach[i] = reachOf(farReaching[i]);
  });
  for (std::size_t i = 0; i < farReaching.size(); ++i) {
    double& most = mReach[mFar.place(farReaching[i].block)];
    most = std::max(most, reach[i]);
    mLargestReach = std::max(mLargestReach, reach[i]);
  }
}

Box FaceLocator::latticeBox(const EdgeRef& e, const Float4Box& box) const {
  if (mFaces.map().affine()) return latticeBox(box);
  const Vec3d p = mFaces.edgeCells().lowEnd(e), reach{kFreeReach, kFreeReach, kFreeReach};
  return {p - reach, p + reach};
}

double FaceLocator::reachOf(const EdgeRef& e) const {
  if (!mFaces.map().affine()) return kFreeReach;
  const Vec3d at = mFaces.edgeCells().lowEnd(e);
  double reach = 0;
  for (const Vec3f& corner : mFaces.corners(mFaces.edgeCells().vertices(e)))
    reach = std::max(reach, distance(at, latticePosition(corner)));
  return reach;
}

}  // namespace pdc::detail
