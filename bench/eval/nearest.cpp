#include "eval/nearest.h"

#include <algorithm>
#include <cmath>

namespace pdc::eval {
namespace {

double toSegment(const Vec3d& p, const Vec3d& a, const Vec3d& b) {
  const Vec3d e = b - a;
  const double l = dot(e, e), t = l > 0 ? std::clamp(dot(p - a, e) / l, 0.0, 1.0) : 0.0;
  return length(p - a - e * t);
}

double toPiece(const Vec3d& p, const Piece& t) {
  const Vec3d n = cross(t.b - t.a, t.c - t.a);
  const double l = length(n);
  if (l > 0) {
    const bool over = dot(cross(t.b - t.a, p - t.a), n) >= 0 && dot(cross(t.c - t.b, p - t.b), n) >= 0 &&
                      dot(cross(t.a - t.c, p - t.c), n) >= 0;
    if (over) return std::abs(dot(p - t.a, n)) / l;
  }
  return std::min({toSegment(p, t.a, t.b), toSegment(p, t.b, t.c), toSegment(p, t.c, t.a)});
}

int cell(double v) { return static_cast<int>(std::floor(v)); }

}  // namespace

std::uint64_t Nearest::key(int x, int y, int z) {
  const auto part = [](int v) { return static_cast<std::uint64_t>(v + (1 << 20)); };
  return part(x) << 42 | part(y) << 21 | part(z);
}

void Nearest::add(const Piece& t) {
  const auto index = static_cast<std::uint32_t>(mPieces.size());
  mPieces.push_back(t);
  int low[3], high[3];
  for (int i = 0; i < 3; ++i) {
    low[i] = cell(std::min({t.a[i], t.b[i], t.c[i]}) / mReach);
    high[i] = cell(std::max({t.a[i], t.b[i], t.c[i]}) / mReach);
  }
  for (int x = low[0]; x <= high[0]; ++x)
    for (int y = low[1]; y <= high[1]; ++y)
      for (int z = low[2]; z <= high[2]; ++z) mCells[key(x, y, z)].push_back(index);
}

double Nearest::distance(const Vec3d& p) const {
  double nearest = mReach;
  const int x = cell(p.x / mReach), y = cell(p.y / mReach), z = cell(p.z / mReach);
  for (int i = 0; i < 27; ++i) {
    const auto it = mCells.find(key(x + i / 9 - 1, y + i / 3 % 3 - 1, z + i % 3 - 1));
    if (it == mCells.end()) continue;
    for (const std::uint32_t k : it->second) nearest = std::min(nearest, toPiece(p, mPieces[k]));
  }
  return nearest;
}

}  // namespace pdc::eval
