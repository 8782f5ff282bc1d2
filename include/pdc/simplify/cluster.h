#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>

#include "pdc/mesh/mesh.h"
#include "pdc/monitor.h"
#include "pdc/simplify/quadric_kind.h"

namespace pdc {

struct ClusterOptions {
  double cell = 0;  ///< The edge of the cells, in world units, above 0.
  QuadricKind quadric = QuadricKind::kProbabilisticPlane;
  /// Standard deviation of each component of the unit normals, 0 or more: the 5 % of Trettner & Kobbelt 2020.
  double sigmaNormal = 0.05;
  /// Standard deviation of each coordinate of the corners, 0 or more, in cells. It counts for kProbabilisticTriangle
  /// only: for planes it does not move the minimum.
  double sigmaPosition = 0.005;
  /// Vertices within this distance of each other, in world units, 0 or more, become one before anything else, so that
  /// none of them falls into a neighbouring cell: see weldVertices(). For cluster() and clusterFile(), which then reads
  /// the file whole; Clustering sees no vertices.
  std::optional<double> weld{};
  bool free = false;   ///< Vertices may leave their cells, by one and a half cells at most.
  bool clean = false;  ///< Folded and duplicate faces are dropped.
};

struct ClusterReport {
  std::size_t trianglesBefore = 0, trianglesAfter = 0;
  std::size_t weldedVertices = 0;      ///< Vertices given that became one with another.
  std::size_t cells = 0;               ///< Cells that hold corners.
  std::size_t vertices = 0;            ///< Cells that faces are left at.
  std::size_t collapsedTriangles = 0;  ///< Triangles given whose corners lie in one or two cells, or became one.
  std::size_t nonFiniteTriangles = 0;  ///< Triangles given with a NaN or infinite coordinate: left out.
  std::size_t foldedFaces = 0;         ///< Faces dropped in pairs that have the same vertices and face opposite ways.
  std::size_t duplicateFaces = 0;      ///< Faces dropped because another has the same vertices.
  std::size_t outsideVertices = 0;     ///< Vertices whose least error lies outside of their cells.
};

/// Simplifies a stream of triangles by vertex clustering with quadrics (Lindstrom 2000), in memory that depends on the
/// result only. Space is cut into cubic cells, with corners at the origin of the coordinates. Each corner adds its
/// triangle's quadric to its cell, as the faces at a vertex do; each cell becomes one vertex, where the sum is least;
/// and triangles stay whose corners are in three cells. The faces thus do not depend on the kind of quadrics.
///
/// Vertices stay in their cells unless `free` is set. Minima of classical quadrics that are no points, but lines or
/// planes (eigenvalues below a thousandth of the largest), are taken where they are nearest to the mean of the cell's
/// corners. Nothing keeps faces from being folded or intersecting, nor the surface a manifold.
///
/// Used by one thread at a time; after an error it can only be destroyed.
class Clustering {
 public:
  /// \throws std::invalid_argument for options out of range, and if `weld` is set.
  explicit Clustering(const ClusterOptions& options);
  ~Clustering();
  Clustering(const Clustering&) = delete;
  Clustering& operator=(const Clustering&) = delete;

  /// How the stream is cut into calls does not matter. Triangles with a NaN or infinite coordinate are left out.
  /// \throws Error for a corner more than 2^20 cells away from the first one along an axis, or 2^50 from the origin,
  /// and for more than 2^32 - 1 cells.
  void add(std::span<const std::array<Vec3f, 3>> triangles);

  /// The mesh of all that was added: vertices in the order in which their cells first appeared, faces in that of the
  /// stream. To be called once. Runs in parallel; the result does not depend on the number of threads.
  [[nodiscard]] Mesh finish(ClusterReport* report = nullptr);

 private:
  struct State;
  std::unique_ptr<State> mState;
};

/// Clusters a mesh: see Clustering. The result does not depend on the unit of length, if that changes by a power of
/// two. \param mesh quads stand for their two triangles, which come first. Cells are those of its positions, without
/// its origin, which the result takes over; normals and properties it does not.
/// \throws std::invalid_argument for options out of range and as Mesh says; Error as Clustering::add(), and for a face
/// that names a vertex that does not exist; Cancelled. Progress: "cluster".
[[nodiscard]] Mesh cluster(const Mesh& mesh, const ClusterOptions& options, ClusterReport* report = nullptr,
                           const Monitor& monitor = {});

}  // namespace pdc
