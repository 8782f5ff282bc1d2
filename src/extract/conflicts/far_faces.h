#pragma once

#include <cstdint>
#include <vector>

#include "extract/conflicts/face_locator.h"
#include "extract/conflicts/face_tests.h"
#include "extract/conflicts/float4_box.h"
#include "pdc/math/simd_level.h"

namespace pdc::detail {

/// Lists of what far-reaching faces may meet, so that it need not be searched for each time they are tested.
class FarFaces {
 public:
  /// Makes no lists where far-reaching faces are so many that these would take much more room than the mesh. Runs in
  /// parallel.
  /// \param farReaching those of `locator`, sorted.
  FarFaces(const FaceTests& faces, const FaceLocator& locator, const std::vector<EdgeRef>& farReaching, SimdLevel level,
           const Monitor& monitor);

  /// Notes that the edge's face has changed. \param triangles room to work in.
  void update(const EdgeRef& e, std::vector<Triangle>& triangles);

  /// Calls visit(edge), until it returns false, for the faces that the edge's face, which lies in a box of world space,
  /// may meet. \returns false, without a call, if there is no list that holds for the box.
  template <typename Visit>
  bool forEachNear(const EdgeRef& e, const Float4Box& box, Visit&& visit) const {
    if (!listed(e)) return false;
    const Face& face = mListed[mLocator.farReaching().number(e)];
    if (!face.likely.contains(box)) return false;
    for (const std::uint32_t i : face.far)
      if (const Face& other = mListed[i]; !box.apartFrom(other.now) && !visit(other.edge)) return true;
    for (const EdgeRef& other : face.others)
      if (!visit(other)) return true;
    return true;
  }

 private:
  struct Face {
    EdgeRef edge;
    Float4Box now;                   ///< The box of the face as it is.
    Float4Box likely;                ///< The box for which the lists hold: it will hardly ever leave it.
    std::vector<std::uint32_t> far;  ///< Numbers of far-reaching faces.
    std::vector<EdgeRef> others;     ///< Faces whose vertices stay where they are.
  };

  [[nodiscard]] bool listed(const EdgeRef& e) const { return !mListed.empty() && mLocator.farReaching().has(e); }
  void list(Face& face, std::vector<EdgeRef>& edges) const;
  [[nodiscard]] bool staysApart(const EdgeRef& e, const Float4Box& box) const;

  const FaceTests& mFaces;
  const FaceLocator& mLocator;
  std::vector<Face> mListed;  ///< By number among the far-reaching faces.
};

}  // namespace pdc::detail
