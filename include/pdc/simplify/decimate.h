#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "pdc/mesh/mesh.h"
#include "pdc/monitor.h"
#include "pdc/simplify/quadric_kind.h"

namespace pdc {

/// Where an edge's vertex goes.
enum class CollapsePlacement {
  kMinimizer,  ///< Where the quadrics of both ends have their minimum.
  kSubset,     ///< To that end where they are less, so that the vertices are a subset of those given.
};

/// A length, above 0 and finite.
struct MeshLength {
  MeshLength(double length, bool ofMeanEdges = false) : value(length), inMeanEdges(ofMeanEdges) {}

  double value;
  bool inMeanEdges;  ///< In mean edge lengths of the mesh given; otherwise in world units.
};

struct DecimateOptions {
  /// How many triangles there are to be at most; and as a share, in (0, 1], of those given. The larger one counts if
  /// both are set.
  std::optional<std::size_t> faces{};
  std::optional<double> ratio{};
  /// No point of the result is farther than this from the surface given, nor a point of that from the result: collapses
  /// that would break it are refused. That surface is the welded one, of faces that count. Without a number of faces or
  /// a ratio there are as few triangles as come out then. One of the three must be set. Takes ten times as long and
  /// more.
  std::optional<MeshLength> error{};
  /// The property of the mesh by which `error` is multiplied, 0 or more at each vertex and finite; none if empty. A
  /// triangle given has the least of its corners' bounds: no point of it is farther than that from the result, and each
  /// point of the result has one of the surface given as near as the bound there. 0 counts as a millionth.
  std::string errorScale{};
  /// Vertices within this distance of each other, in world units, 0 or more, become one before anything else: see
  /// weldVertices(). Else faces are neighbours only where they name the same vertices.
  std::optional<double> weld{};
  QuadricKind quadric = QuadricKind::kProbabilisticPlane;
  CollapsePlacement placement = CollapsePlacement::kMinimizer;
  /// Standard deviation of each component of the unit normals, 0 or more; from the mesh's own noise if not set.
  std::optional<double> sigmaNormal{};
  /// Standard deviation of each coordinate of the corners, 0 or more, in mean edge lengths of the mesh; likewise.
  std::optional<double> sigmaPosition{};
  /// The property of the mesh that has the standard deviation of each vertex along its normal, in world units, finite
  /// and 0 or more, as contour() gives "sigma"; or "cov" for its covariances, from the properties "covxx", "covxy",
  /// "covxz", "covyy", "covyz" and "covzz", in world units squared, positive semidefinite up to rounding. None if
  /// empty. It takes the place of the mesh's own noise, and it says where that is: squared distances to faces count in
  /// inverse proportion to the variances of their corners along their normals, so that few triangles are spent in
  /// noise; σn and the memory are those of each vertex, where they are not set; σp is that of the mean.
  std::string sigmaProperty{};
  /// The share, 0 to 1, that the faces given have in the quadrics, the rest being that of the faces there are: 1 is
  /// what Garland & Heckbert and Trettner & Kobbelt do, 0 is simplification without memory (Lindstrom & Turk 1998,
  /// Hoppe 1999), which lies closer to clean surfaces; noise asks for more. From the mesh's own noise if not set.
  std::optional<double> memory{};
  /// No face turns by more than this, in degrees, in (0, 90], when one of its edges is collapsed.
  double maxTurn = 75;
  /// How much boundary edges resist being left, 0 or more, relative to faces of their size.
  double boundaryWeight = 10;
  bool lockBoundary = false;  ///< Vertices at the boundary stay where they are.
  /// Whether no two faces may come to intersect that did not before, decided exactly on the result's positions. It
  /// takes several times as long.
  bool sound = false;
  /// Whether the vertices left are moved to where their faces lie nearest to the surface given, in the least squares;
  /// those of kSubset never are, nor is anything where there is a bound on the error.
  bool fit = true;
  /// Coordinates of vertices that move are multiples of this, in world units; 0 for whatever single precision holds.
  /// Not with a distance of pairs.
  double positionStep = 0;
  /// Contracts pairs of vertices that are closer than this, too: what lies close together merges. Quadrics have a
  /// memory of 1 then, nothing is fitted, and neither another memory nor `sound` nor `error` is possible.
  std::optional<MeshLength> pairDistance{};
};

/// Why decimation ended.
enum class DecimateEnd {
  kReached,         ///< There are no more faces than asked for.
  kError,           ///< Further collapses would go farther than the error allows, or are refused as below.
  kNoCollapseLeft,  ///< Each further collapse would change the topology, turn a face too far or move what is locked.
};

/// What came of pairs of vertices that no edge joined.
struct PairReport {
  std::size_t merges = 0;          ///< How many such pairs became one vertex.
  std::size_t duplicateFaces = 0;  ///< Faces left out because others had, or came to have, the same vertices.
  std::size_t componentsBefore = 0, componentsAfter = 0;      ///< Sets of faces connected through shared vertices.
  std::size_t nonManifoldEdges = 0, nonManifoldVertices = 0;  ///< Those of the result, as MeshReport has them.
};

struct DecimateReport {
  std::size_t facesBefore = 0, facesAfter = 0;  ///< Triangles; before: a quad counts as two.
  std::size_t verticesBefore = 0, verticesAfter = 0;
  std::size_t weldedVertices = 0;  ///< Vertices given that became one with another.
  DecimateEnd end = DecimateEnd::kReached;
  double meanEdge = 0;     ///< Mean length of the edges given, in world units.
  double noise = 0;        ///< What the vertices given seem to have, in mean edge lengths: see meshNoise(); or the mean
                           ///< of what sigmaProperty says.
  double sigmaNormal = 0;  ///< As used; with sigmaProperty that of the mean noise, and likewise the memory.
  double sigmaPosition = 0;
  double memory = 0;
  double error = 0;  ///< The bound in world units; 0 if there is none.
  std::size_t rounds = 0, collapses = 0;
  std::size_t limitedMoves = 0;          ///< Collapses whose minimum was too far away to go there.
  std::size_t refusedIntersections = 0;  ///< Collapses that would have made faces intersect, where that was asked for.
  std::size_t refusedErrors = 0;         ///< Collapses that would have broken the bound on the error, or may have.
  std::size_t degenerateFaces =
      0;  ///< Faces given that name a vertex twice, welded ones too, or have no finite corners: dropped.
  std::size_t nonManifoldVertices = 0;  ///< Vertices given about which the surface is none: they stay as they are,
                                        ///< but with a distance of pairs.
  std::optional<PairReport> pairs{};    ///< If there was a distance of pairs.
};

/// Replaces a mesh by one of fewer triangles that lies as close to it as it can, by collapsing edges (Garland &
/// Heckbert 1997) into vertices at the minimum of their quadrics, drawn towards where they keep the enclosed volume
/// (Lindstrom & Turk 1998); what is left moves to its least squares (Hoppe et al. 1993).
///
/// Edges are collapsed in rounds: of all edges those of least error that do not touch each other, so that rounds run in
/// parallel and the result does not depend on the number of threads. Where the surface is a manifold it stays one, of
/// the same topology, without degenerate and without duplicate faces; elsewhere it stays as it is. Vertices that do not
/// move keep their coordinates to the last bit. The result does not depend on the unit of length, nor, to rounding, on
/// where the mesh lies. Without `sound` nothing keeps faces from intersecting.
///
/// With a distance of pairs the cheapest pair of vertices is contracted at a time, whether an edge joins it or it is
/// closer than the distance, on one thread. That may join parts, and make edges of any number of faces; where the
/// surface is none it is decimated as elsewhere. Edges between manifold vertices keep the topology. Of faces that come
/// to have the same vertices one is left, or none where they faced each other across a gap.
///
/// \param mesh quads stand for their two triangles. Normals are made anew if it has any; properties are interpolated
/// along collapsed edges, whole numbers rounded. Vertices without faces are dropped.
/// \throws std::invalid_argument for options out of range and as Mesh says; Error for a mesh with a face that names a
/// vertex that does not exist, for a property that is missing or no noise, naming the vertex, and where more than 256
/// pairs for each vertex are close; Cancelled. Progress: "decimate". Memory: some 300 bytes per triangle besides the
/// meshes, and 32 for each close pair.
[[nodiscard]] Mesh decimate(const Mesh& mesh, const DecimateOptions& options, DecimateReport* report = nullptr,
                            const Monitor& monitor = {});

/// The standard deviation of the noise that the vertices of a triangle mesh seem to have, in mean edge lengths: from by
/// how much the surface bends otherwise at an edge than at the edges it meets, of which two must be like it. Neither
/// creases nor curvature count as noise, where there are several edges to a bend; coarse meshes of curved surfaces are
/// taken for noisy ones. It is found to some 20 %, up to 0.3; more counts as less than it is.
[[nodiscard]] double meshNoise(const Mesh& mesh);

}  // namespace pdc
