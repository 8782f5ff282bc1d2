#pragma once

namespace pdc {

/// What the error of a vertex is measured by (Trettner & Kobbelt 2020, section 3). All are summed over the faces at a
/// vertex and, but for the triangle quadrics, weighed by area.
enum class QuadricKind {
  kPlane,                  ///< Squared distance to the planes of the faces (Garland & Heckbert 1997).
  kTriangle,               ///< The same, weighed by the square of the area.
  kProbabilisticPlane,     ///< Its expectation where normals have noise, and points if that is known.
  kProbabilisticTriangle,  ///< Its expectation where corners have noise.
  kPoint,                  ///< Squared distance to the vertices: what is left of a plane where noise is all there is.
};

}  // namespace pdc
