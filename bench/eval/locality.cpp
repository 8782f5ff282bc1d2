#include "eval/locality.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <set>
#include <vector>

#include "pdc/extract/contour.h"
#include "pdc/math/box.h"
#include "sample/forwarding_source.h"

namespace pdc::eval {
namespace {

constexpr int kHalo = 2;

/// Another source without the blocks that lie farther than the halo from a box.
class PartOfSource final : public detail::ForwardingSource {
 public:
  PartOfSource(const HermiteSource& source, const SurfaceBlocks& all, const BlockBox& box)
      : ForwardingSource(source), mAll(all), mBox(box) {}

  [[nodiscard]] SurfaceBlocks surfaceBlocks(const Monitor&) const override {
    SurfaceBlocks part;
    part.open = true;
    for (std::size_t i = 0; i < mAll.coords.size(); ++i) {
      if (!mBox.holds(mAll.coords[i], kHalo)) continue;
      part.coords.push_back(mAll.coords[i]);
      part.signs.push_back(mAll.signs[i]);
    }
    return part;
  }

 private:
  const SurfaceBlocks& mAll;
  BlockBox mBox;
};

/// The places of a face's corners, in its order; the fourth of a triangle is its third.
using Face = std::array<std::array<float, 3>, 4>;

/// The faces that lie wholly in a box.
std::multiset<Face> facesIn(const Mesh& mesh, const Box& box) {
  std::multiset<Face> faces;
  const auto add = [&](std::array<std::uint32_t, 4> corners) {
    Face face;
    for (int k = 0; k < 4; ++k) {
      const Vec3f& p = mesh.positions[corners[k]];
      for (int axis = 0; axis < 3; ++axis)
        if (!(p[axis] > box.lo[axis] && p[axis] < box.hi[axis])) return;
      face[k] = {p.x, p.y, p.z};
    }
    faces.insert(face);
  };
  for (const Quad& q : mesh.quads) add(q);
  for (const Triangle& t : mesh.triangles) add({t[0], t[1], t[2], t[2]});
  return faces;
}

}  // namespace

FaceDifference compareWithPart(const HermiteSource& source, const SurfaceBlocks& blocks, const Mesh& whole,
                               const BlockBox& box) {
  const Mesh part = contour(PartOfSource(source, blocks, box));
  Box core = Box::empty();
  for (int corner = 0; corner < 8; ++corner) {
    Vec3d at;
    for (int axis = 0; axis < 3; ++axis)
      at[axis] = kBlockSize * ((corner >> axis & 1) != 0 ? box.hi[axis] + 1.0 : double(box.lo[axis]));
    core.include(source.map().position(at));
  }
  const std::multiset<Face> a = facesIn(whole, core), b = facesIn(part, core);
  std::vector<Face> differing;
  std::set_symmetric_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(differing));
  return {a.size(), differing.size()};
}

}  // namespace pdc::eval
