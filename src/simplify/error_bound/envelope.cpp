#include "simplify/error_bound/envelope.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>

#include "simplify/error_bound/coverage.h"
#include "simplify/error_bound/height_over.h"
#include "simplify/vertex_stars.h"

namespace pdc::detail {
namespace {

/// Heights are rounded by less than this, relative to the distance.
constexpr double kRounding = 1e-6;

}  // namespace

/// The surface, as Coverage and HeightOver ask for it.
class Envelope::Walk {
 public:
  Walk(const Envelope& envelope, std::vector<std::uint32_t>* used) : mEnvelope(envelope), mUsed(used) {}

  [[nodiscard]] TrianglePoints corners(std::uint32_t t) const {
    return trianglePoints(mEnvelope.mSurface.positions, mEnvelope.mSurface.triangles[t]);
  }
  const Prism& prism(std::uint32_t t) {
    mPrism = Prism(corners(t));
    return mPrism;
  }
  [[nodiscard]] NearestTriangle nearest(const Vec3d& p, std::uint32_t guess) const {
    return mEnvelope.findNear(p, guess);
  }
  [[nodiscard]] std::uint32_t beyond(std::uint32_t t, int k) const { return mEnvelope.mBeyond[t][k]; }
  void use(std::uint32_t t) {
    if (mUsed != nullptr && std::find(mUsed->begin(), mUsed->end(), t) == mUsed->end()) mUsed->push_back(t);
  }

 private:
  const Envelope& mEnvelope;
  std::vector<std::uint32_t>* const mUsed;
  Prism mPrism;
};

Envelope::Envelope(const Mesh& surface, double distance)
    : mSurface(surface), mDistance(distance), mNearest(surface), mBeyond(surface.triangles.size()) {
  VertexStars stars;
  stars.build(surface.triangles, surface.positions.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, mBeyond.size(), 1024), [&](const auto& r) {
    for (std::size_t f = r.begin(); f < r.end(); ++f)
      for (int k = 0; k < 3; ++k) {
        const Triangle& t = surface.triangles[f];
        const StarCorner* const beyond = cornerAfter(stars[t[k]], t[(k + 1) % 3]);
        mBeyond[f][k] = beyond != nullptr ? beyond->face : kNone;
      }
  });
}

std::uint32_t Envelope::nearest(const Vec3d& p, std::uint32_t guess) const { return findNear(p, guess).number; }

NearestTriangle Envelope::findNear(const Vec3d& p, std::uint32_t guess) const {
  return mNearest.findBelow(mDistance * mDistance, p, guess);
}

bool Envelope::contains(const TrianglePoints& triangle, std::uint32_t near, std::vector<std::uint32_t>* used,
                        double distance) const {
  Walk walk(*this, used);
  // What is over it would be used, too, where less may be enough.
  if (used == nullptr && near != kNone) {
    HeightOver<Walk> height(walk, triangle);
    const auto answer = height.find(distance * (1 - kRounding), near);
    if (answer == HeightOver<Walk>::Answer::kNear) return true;
    if (answer == HeightOver<Walk>::Answer::kFar && findNear(height.farPlace(), near).number == kNone) return false;
  }
  return Coverage<Walk>(walk, distance).covers(triangle, near);
}

}  // namespace pdc::detail
