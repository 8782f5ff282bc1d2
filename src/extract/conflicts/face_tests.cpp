#include "extract/conflicts/face_tests.h"

#include <utility>

#include "pdc/math/predicates.h"

namespace pdc::detail {
namespace {

/// The ends of the edge in lattice space, the one inside first.
std::pair<Vec3d, Vec3d> insideToOutside(const EdgeCells& edgeCells, const EdgeRef& e) {
  Vec3d from = edgeCells.lowEnd(e), to = from;
  to[e.axis()] += 1;
  if (!edgeCells.lowInside(e)) std::swap(from, to);
  return {from, to};
}

}  // namespace

bool FaceTests::passes(const EdgeRef& e, const Quad& quad) const {
  const auto [from, to] = insideToOutside(mEdgeCells, e);
  const Vec3d behind = mMap.position(from), before = mMap.position(to);
  const auto p = [&](int i) { return vecCast<double>(mMesh.positions[quad[i]]); };
  const auto crossed = [&](int a, int b, int c) {
    return orient3d(p(a), p(b), p(c), behind) < 0 && orient3d(p(a), p(b), p(c), before) > 0;
  };
  return crossed(0, 1, 2) && crossed(0, 2, 3);
}

Vec3d FaceTests::forward(const EdgeRef& e) const {
  const auto [from, to] = insideToOutside(mEdgeCells, e);
  return mMap.affine() ? mMap.jacobian({}) * (to - from) : mMap.position(to) - mMap.position(from);
}

bool FaceTests::facesForward(const Vec3d& forward, const Triangle& vertices, const TriangleCorners& t) const {
  const Vec3d p = vecCast<double>(t[0]);
  const Vec3d u = vecCast<double>(t[1]) - p, v = vecCast<double>(t[2]) - p, n = cross(u, v);
  // Differences of floats are exact or nearly so; what is left is far below this share.
  constexpr double kRounding = 1e-14;
  const double errorBound = kRounding * length(u) * length(v);
  if (dot(n, forward) > errorBound * length(forward)) return true;
  if (!(length(n) > errorBound)) return false;
  // The cosine from which a triangle belongs to a plane.
  constexpr double kAlike = 0.5;
  for (const std::uint32_t vertex : vertices)
    if (const SuspectVertex* found = suspect(vertex))
      for (const Vec3f& normal : found->creaseNormals)
        if (dot(n, vecCast<double>(normal)) > kAlike * length(n)) return true;
  return false;
}

Vec3f FaceTests::worldPosition(const SuspectVertex& v, const Vec3f& place) const {
  const CellRef c = cellOf(v);
  const Coord& b = mEdgeCells.blockCoord(v.block);
  const Vec3d center{kBlockSize * double(b[0]) + c.x + 0.5, kBlockSize * double(b[1]) + c.y + 0.5,
                     kBlockSize * double(b[2]) + c.z + 0.5};
  return mMap.rounded(mMap.position(center + vecCast<double>(place)));
}

void FaceTests::triangles(const EdgeRef& e, std::uint64_t face, std::vector<Triangle>& out) const {
  out.clear();
  const Quad* q = quad(face);
  if (q == nullptr) return mFans.triangles(e, out);
  out.push_back({(*q)[0], (*q)[1], (*q)[2]});
  out.push_back({(*q)[0], (*q)[2], (*q)[3]});
}

}  // namespace pdc::detail
