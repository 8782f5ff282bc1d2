#pragma once

#include <cstddef>
#include <optional>

#include "pdc/mesh/mesh.h"
#include "pdc/monitor.h"
#include "pdc/subdivide/infer_covariances.h"

namespace pdc {

/// How faces are split and vertices weighed.
enum class SubdivisionScheme {
  kLoop,          ///< Triangles into four (Loop 1987). Other faces become triangles first.
  kCatmullClark,  ///< Faces of any number of corners into quads (Catmull & Clark 1978).
};

/// What the neighbours of a vertex inside the surface count in Loop's scheme.
enum class LoopWeights {
  kLoop,    ///< (40 − (3 + 2 cos 2π/n)²) / 64n.
  kWarren,  ///< 3/16 for n = 3, else 3/8n.
};

struct SubdivideOptions {
  int levels = 2;  ///< How many times, 1 to 31.
  SubdivisionScheme scheme = SubdivisionScheme::kLoop;
  LoopWeights weights = LoopWeights::kLoop;
  /// Vertices are Gaussians with these covariances, and products of them take the place of averages. Not set: the
  /// linear scheme.
  std::optional<InferenceOptions> covariances = InferenceOptions{};
  /// Edges whose faces' normals differ by more than this, in degrees, in (0, 180], stay sharp, as boundaries always do.
  /// None if not set.
  std::optional<double> creaseAngle{};
  bool limit = false;  ///< Vertices go to where they would be after infinitely many levels.
  /// The vertices have the normals of the limit surface, which needs `limit`.
  bool normals = false;
  /// The vertices have the properties "mean_curvature", in 1 / world units and above 0 where the surface is convex, and
  /// "gaussian_curvature", in their squares, of the limit surface, which needs `limit`.
  bool curvature = false;
  bool keepCovariances = false;  ///< The result is a covariance mesh, whose properties are in double precision.
  bool keepPlaces = false;       ///< SubdivideReport::places is filled.
};

struct SubdivideReport {
  std::size_t facesBefore = 0, facesAfter = 0;  ///< Before: as they are subdivided, after other faces became triangles.
  std::size_t verticesBefore = 0, verticesAfter = 0;
  std::size_t triangulatedFaces = 0;  ///< Faces of more than three corners that became triangles for Loop's scheme.
  std::size_t unusedVertices = 0;     ///< Vertices given without a face: dropped.
  std::size_t boundaryEdges = 0, creaseEdges = 0;  ///< Of those given; creases are not boundaries.
  std::size_t extraordinaryVertices = 0;  ///< Vertices given inside the surface, without 6 triangles or 4 faces.
  /// Vertices of the result whose curvature is the mean of their neighbours', because the surface has none there, or 0.
  std::size_t estimatedCurvatures = 0;
  Buffer<Vec3d> places{};  ///< On request: the positions before they were rounded, relative to the mesh's origin.
};

/// Refines a mesh into a smooth surface.
///
/// With covariances each vertex is a Gaussian, and a vertex is placed at the mean of the product of Gaussians to the
/// powers that the linear scheme has as weights (Preiner, Boubekeur & Wimmer 2019): flat covariances make creases,
/// those that stand upright make cusps, and equal ones make the linear scheme. The surface is as smooth as that of the
/// linear scheme. A factor that all covariances have in common changes nothing, and the surface follows affine maps of
/// the mesh and its covariances.
///
/// Boundaries and creases are cubic B-splines; where three sharp edges meet, or more, the vertex stays. Limits of
/// vertices at which exactly one sharp edge ends are those without it. The curvature at boundaries, creases and
/// extraordinary vertices, where a limit surface need not have any, is the mean of that of the neighbours that have it.
///
/// \param mesh an oriented manifold, with boundary or not. Normals and properties are dropped. \returns triangles for
/// Loop's scheme, quads for the other; vertices keep their numbers, those of edges follow, then those of faces.
/// \throws std::invalid_argument for options out of range and as Mesh says. Error as inferCovariances() does; for a
/// mesh that is empty, or no oriented manifold, or has a face that names a vertex twice or a vertex that is not finite,
/// naming the first; for 2^32 faces and more, or more than the memory holds,
/// before anything is made; for a vertex inside the surface with two faces,
/// for Catmull-Clark with covariances; Cancelled. Progress: "subdivide". Memory: some 180 bytes for each vertex of the
/// result, 350 with limits. The result does not depend on the number of threads.
[[nodiscard]] Mesh subdivide(const Mesh& mesh, const SubdivideOptions& options = {}, SubdivideReport* report = nullptr,
                             const Monitor& monitor = {});

}  // namespace pdc
