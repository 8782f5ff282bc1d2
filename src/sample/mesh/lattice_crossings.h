#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "mesh/winding/closed_surface.h"
#include "pdc/mesh/buffer.h"
#include "pdc/monitor.h"
#include "pdc/sample/lattice.h"

namespace pdc::detail {

/// The lattice of a MeshSource, relative to the mesh's origin. All triangles lie above point 0 along each axis.
struct MeshLattice {
  Vec3d origin;
  double voxelSize;

  [[nodiscard]] double at(int axis, int point) const { return origin[axis] + voxelSize * point; }
  [[nodiscard]] Vec3d at(const Coord& point) const { return {at(0, point[0]), at(1, point[1]), at(2, point[2])}; }
};

/// Where a lattice edge passes through a triangle.
struct EdgeCrossing {
  std::uint64_t edge;  ///< See edgeKey().
  double t;            ///< From the edge's lower end, in [0, 1].
  std::uint32_t triangle;
  std::int32_t turn;  ///< The sign of the triangle's normal along the edge: the winding number falls by it.
};

/// Where all edges of a lattice along an axis pass through the triangles of a surface, as exactly as lattice_line.h has
/// it, so that the sum of the turns around each square of a closed surface is 0.
class LatticeCrossings {
 public:
  /// Runs in parallel; the result does not depend on the number of threads. \param triangles how many, of the first.
  LatticeCrossings(const ClosedSurface& surface, std::size_t triangles, const MeshLattice& lattice, Axis axis,
                   const Monitor& monitor);

  /// By edge, then by t.
  [[nodiscard]] std::span<const EdgeCrossing> all() const { return mCrossings; }
  /// Those of the `count` edges along one line that begin at a point; none below 0.
  [[nodiscard]] std::span<const EdgeCrossing> along(const Coord& point, int count) const;
  /// The lower end of an edge.
  [[nodiscard]] Coord pointOf(std::uint64_t edge) const;

 private:
  /// Orders edges by line, then along it.
  [[nodiscard]] std::uint64_t edgeKey(const Coord& point) const;

  Axis mAxis;
  Buffer<EdgeCrossing> mCrossings;
};

/// The winding number of a closed surface at lattice points.
class LatticeWinding {
 public:
  /// \param crossings along z with all triangles of the surface; has to live as long.
  explicit LatticeWinding(const LatticeCrossings& crossings);

  /// Fills the numbers at `count` points, from `point` upwards along z.
  void read(const Coord& point, int count, std::int32_t* numbers) const;
  [[nodiscard]] std::int32_t at(const Coord& point) const {
    std::int32_t number = 0;
    read(point, 1, &number);
    return number;
  }

 private:
  const LatticeCrossings& mCrossings;
  Buffer<std::int32_t> mAbove;  ///< The number above each crossing.
};

}  // namespace pdc::detail
