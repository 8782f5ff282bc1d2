#include "pdc/field/field.h"

namespace pdc {

double Field::valueAt(const Vec3d& p) const {
  double value;
  values({&p.x, &p.y, &p.z, 1}, &value);
  return value;
}

Vec3d Field::gradientAt(const Vec3d& p) const {
  double value;
  Vec3d g;
  gradients({&p.x, &p.y, &p.z, 1}, &value, {&g.x, &g.y, &g.z});
  return g;
}

}  // namespace pdc
