#pragma once

#include <cstddef>
#include <functional>
#include <optional>

#include "pdc/math/quadric.h"
#include "pdc/mesh/mesh.h"
#include "pdc/sample/hermite_source.h"

namespace pdc {

/// Where a vertex may lie.
enum class Placement {
  kCertified,  ///< In its cell where that fits its planes nearly as well, else as kFree; drawn back where faces
               ///< intersect.
  kCell,       ///< In its own cell: the minimiser of the quadric over the cell, moved where faces would intersect.
  kFree,       ///< Within 1.5 steps of the lattice of its cell along each axis; faces may intersect.
};

/// σn of the paper's experiments: five percent.
inline constexpr double kPapersSigmaNormal = 0.05;

struct ContourOptions {
  /// Standard deviation σn assumed for each component of the unit normals (no unit, >= 0). 0 is the classical quadric
  /// with a pseudo-inverse about the mass point, infinity is the mass point. Experiments in the paper have
  /// kPapersSigmaNormal.
  /// Empty: from the data, patch by patch. The noise of the normals is estimated block by block, as by normalNoise();
  /// creases get that as σn, at least 0.02, curved patches 0.2, with which the faces between vertices fit best, and
  /// patches whose normals differ by no more than their noise 1.3 and more (docs/defaults.md). A function has no noise.
  /// Planes that come from distances have a σn of their own.
  std::optional<double> sigmaNormal{};
  Placement placement = Placement::kCertified;
  bool triangles = false;  ///< Triangles instead of quads.
  /// Fewer faces where the surface is simple: no point of the result is farther than this from the mesh that would be
  /// made without it, nor a point of that from the result, in world units, above 0 and finite. Edges are collapsed as
  /// by decimate() with that error and `sound`; what is promised of the mesh's topology, closedness and intersections
  /// holds, cells and placements are left. Quads stay where nothing was collapsed. Properties are interpolated, normals
  /// those of the faces. Takes a hundred times as long as contouring and more, and some 600 bytes per vertex of the
  /// full mesh. Excludes `quadrics`.
  std::optional<double> adaptive{};
  /// By what `adaptive` is multiplied at a point in world space, 0 or more and finite: 1 keeps it, 0.1 leaves a tenth.
  /// Asked at the vertices of the full mesh, by several threads at a time; each of these has the least that it and its
  /// neighbours got, each triangle the least of its corners. No point of a triangle of the full mesh is farther from
  /// the result than the distance that it has then, and each point of the result has one of the full mesh as near as
  /// the distance there. 0 counts as a millionth. Not used without `adaptive`.
  std::function<double(const Vec3d&)> adaptiveScale{};
  bool normals = false;  ///< Also a normal per vertex: the mean of its crossings' normals.
  /// Also the confidence of each vertex as the mesh's property "confidence", floats from 0 to 1: 1 / (1 + s /
  /// kHalfConfidence), where s estimates the standard deviation of the vertex's place in voxels: s² is the variance
  /// that the residuals of its planes give the solution in the directions that they determine (Gauss-Markov), plus the
  /// square of its distance from its neighbours' mean along its normal, neighbours across a crease left out. So noise
  /// lowers it, and so do tight curvature and being drawn back. It knows nothing of errors that all vertices about a
  /// place share. Costs about as much again as contouring.
  /// And the property "sigma", floats of 0 or more: the standard deviation of the vertex along its normal, in world
  /// units, √(nᵀΣn) with Σ the same covariance of Gauss and Markov, n the direction that the planes determine best. It
  /// is the error of the solution, not that of one value of the input, and neighbours are not asked: where distances
  /// have noise it is 0.6 to 1.2 times the root mean square of the true errors. It is too small because the crossings
  /// of a cell share values, takes what curvature the planes show for noise (without noise: some hundredths of a voxel
  /// beside creases, some thousandths elsewhere), and does not see errors that all planes of a vertex share, nor where
  /// it was drawn back. 0 where a vertex has no planes.
  bool confidence = false;
  /// Also the rank of each vertex as the property "rank", uint8, 1 on flat parts, 2 on edges, 3 at corners: the number
  /// of eigenvalues of the sum of its planes' nnᵀ that exceed 1/20 of the trace, so that planes at 26° or more count as
  /// two. Vertices that certifying added have rank 1.
  bool ranks = false;
  /// Also ContourReport::quadrics. Costs about as much again as contouring, and 40 bytes per vertex.
  bool quadrics = false;
  /// Mesh::origin, in world units, finite. Empty: zero as long as single precision resolves kMostRounding voxels at the
  /// farthest vertex, else near the middle of the surface. Everything that is promised of coordinates holds for those
  /// relative to it.
  std::optional<Vec3d> origin = Vec3d{};
  /// The sums of origin and positions are exact in double precision, so that they can be written instead and keep what
  /// is promised: positions are multiples of a power of two, to which a given origin is rounded too.
  bool exactSums = false;
  /// Bytes that the program may have in use, the mesh and the input included. 0: what the machine has.
  std::size_t maxMemory = 0;
  int threads = 0;  ///< 0: all. The result does not depend on it, byte for byte.
};

/// The standard deviation, in voxels, of a vertex whose confidence is one half.
inline constexpr double kHalfConfidence = 0.1;

/// How far apart neighbouring numbers of single precision may be, in voxels, before they are too coarse for a mesh.
inline constexpr double kMostRounding = 1e-3;

/// What one contour() call counted, no verdicts, and what it was asked to hand out.
struct ContourReport {
  std::size_t blocks = 0;                  ///< Blocks that hold surface.
  std::size_t crossings = 0;               ///< Sign-changing edges with a face.
  std::size_t outOfCell = 0;               ///< Vertices whose unconstrained minimiser lay outside their cell.
  std::size_t clamped = 0;                 ///< Vertices that were moved to meet the placement's bound.
  std::size_t boundaryEdges = 0;           ///< Edges of the mesh with one face; 0 unless the source is open.
  std::size_t multiVertexCells = 0;        ///< Cells with more than one vertex.
  std::size_t crossingsWithoutNormal = 0;  ///< Crossings used as points because no normal was found.
  std::size_t shortened = 0;               ///< Vertices drawn part of the way back to their cells.
  std::size_t drawnIn = 0;                 ///< Vertices drawn back into their cells all the way.
  std::size_t forcedDiagonals = 0;         ///< Quads split along the diagonal of larger quadric error.
  std::size_t fans = 0;                    ///< Quads replaced by triangles about the crossing of their lattice edge.
  double normalNoise = 0;  ///< See normalNoise(); estimated where σn came from the data and is not known, else 0.
  double medianSigmaNormal = 0;     ///< Over all patches, where σn came from the data; else 0.
  std::size_t creasePatches = 0;    ///< Patches with several planes from distances, which meet in a crease.
  std::size_t trianglesBefore = 0;  ///< Of the full mesh, where fewer were asked for; else 0.
  double adaptedDistance = 0;       ///< The largest from a vertex of the full mesh to the result, or back; else 0.
  std::size_t uncertified = 0;      ///< Pairs of faces that still meet where they should not: see contour().
  /// Empty, or the quadric of each vertex, by its number in the mesh: the sum of the patch's probabilistic plane
  /// quadrics with the σn that placed it. Its origin is the vertex's position in the mesh, its unit the world unit, so
  /// that it is f(x) in world units squared for x = p − positions[i]; positive definite for 0 < σn. Vertices that
  /// certifying added (the centres of fans, and those in the faces of split cells) have the mean of their neighbours'
  /// quadrics. Planes from distances count by their weights, with their noise as if they passed through the mean of the
  /// crossings; for an infinite σn it is Σ|x − pᵢ|² over the crossings.
  Buffer<Quadric<float>> quadrics{};
};

/// Dual contouring with probabilistic plane quadrics (Ju et al. 2002; Trettner & Kobbelt 2020, equations 6-8,
/// section 5.1).
///
/// One vertex per surface cycle of a cell; one quad per sign-changing lattice edge whose four cells take part, split
/// along the diagonal of smaller quadric error. Guaranteed: every edge has at most two faces, every vertex one fan of
/// faces (a manifold, for any signs); no boundary unless the source is open; faces counter-clockwise seen from outside;
/// the same bytes for any number of threads.
///
/// With kCertified and kCell and an affine map also: the triangles, quads being split as Mesh says, do not intersect
/// each other in the single-precision coordinates given, and none faces backwards: along its lattice edge or, beside a
/// crease, within 60° of one of the planes that meet there. In the rare places where four vertices allow no such quad,
/// triangles about an additional vertex on the lattice edge take its place. `uncertified` is 0 then. Not guaranteed for
/// kFree, for maps that are not affine, where an open source's surface ends within a cell in several pieces, and beyond
/// about 2^20 voxels from the mesh's origin, where single precision cannot tell a cell's walls apart; there
/// `uncertified` counts what is left.
///
/// \throws std::invalid_argument for a negative or NaN sigmaNormal, an origin that is not finite or negative threads,
/// for quadrics without a report to put them into, and for a source whose blocks are not sorted or not closed under
/// continuation; Error for a scale that is negative or not finite, naming the point, if the mesh would have more than
/// 2^32 vertices, or is not expected to fit into maxMemory, before
/// any is made (forecastContour() tells even before that); Cancelled; whatever the source throws.
[[nodiscard]] Mesh contour(const HermiteSource& source, const ContourOptions& options = {},
                           ContourReport* report = nullptr, const Monitor& monitor = {});

}  // namespace pdc
