#include "pdc/math/predicates.h"

#include "math/expansion.h"

namespace pdc::detail {
namespace {

/// The exact vector between two points.
struct Edge {
  Expansion<2> x, y, z;
  Edge(const Vec3d& from, const Vec3d& to)
      : x(difference(to.x, from.x)), y(difference(to.y, from.y)), z(difference(to.z, from.z)) {}
};

/// ad - bc.
Expansion<16> determinant(const Expansion<2>& a, const Expansion<2>& b, const Expansion<2>& c, const Expansion<2>& d) {
  return sum(product(a, d), negated(product(b, c)));
}

}  // namespace

int orient3dExactly(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d) {
  const Edge u(a, b), v(a, c), w(a, d);
  const auto x = product(determinant(u.y, u.z, v.y, v.z), w.x);
  const auto y = product(determinant(u.z, u.x, v.z, v.x), w.y);
  const auto z = product(determinant(u.x, u.y, v.x, v.y), w.z);
  return sum(sum(x, y), z).sign();
}

int orient2dExactly(double ax, double ay, double bx, double by, double cx, double cy) {
  return determinant(difference(bx, ax), difference(by, ay), difference(cx, ax), difference(cy, ay)).sign();
}

}  // namespace pdc::detail
