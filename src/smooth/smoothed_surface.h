#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "mesh/connectivity.h"
#include "mesh/local/local_frame.h"
#include "pdc/monitor.h"

namespace pdc::detail {

/// The faces of a surface that is smoothed, under one number: its triangles first, then its walls. A wall stands on an
/// edge of the boundary, at a right angle to the triangle there, and holds that edge as another face would. Lengths are
/// in mean edges, positions in the local frame.
class SmoothedSurface {
 public:
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  /// A wall runs from vertex `from` to vertex `to`, as its triangle does.
  struct Wall {
    std::uint32_t triangle, from, to;
  };

  /// Runs in parallel; the result does not depend on the number of threads. \param mesh its indices are in range.
  /// \throws Error for a mesh without usable triangles, and where these do not form one oriented fan at each vertex;
  /// Cancelled. No progress is reported.
  explicit SmoothedSurface(const Mesh& mesh, const Monitor& monitor = {});

  [[nodiscard]] const LocalFrame& frame() const { return mFrame; }
  [[nodiscard]] std::size_t vertices() const { return mPositions.size(); }
  [[nodiscard]] const Buffer<Vec3d>& positions() const { return mPositions; }
  /// Triangles that name three vertices, all finite: usable ones.
  [[nodiscard]] const Buffer<Triangle>& triangles() const { return mTriangles; }
  [[nodiscard]] const std::vector<Wall>& walls() const { return mWalls; }
  [[nodiscard]] std::size_t faces() const { return mTriangles.size() + mWalls.size(); }
  /// The faces across the edges of a face: of a triangle across that from corner k to the next one; of a wall its
  /// triangle, the wall before and the wall after.
  [[nodiscard]] const std::array<std::uint32_t, 3>& neighbours(std::size_t face) const { return mNeighbours[face]; }
  /// The middle of a triangle, or of a wall's edge.
  [[nodiscard]] Vec3d middle(std::size_t face) const {
    if (face < mTriangles.size()) {
      const Triangle& t = mTriangles[face];
      return (mPositions[t[0]] + mPositions[t[1]] + mPositions[t[2]]) * (1.0 / 3);
    }
    const Wall& w = mWalls[face - mTriangles.size()];
    return (mPositions[w.from] + mPositions[w.to]) * 0.5;
  }

  /// The triangles at a vertex.
  [[nodiscard]] std::span<const Corner> corners(std::uint32_t vertex) const { return mConnectivity.corners(vertex); }
  [[nodiscard]] bool atBoundary(std::uint32_t vertex) const { return mWallFrom[vertex] != kNone; }
  /// The numbers of the walls before and after a vertex at the boundary.
  [[nodiscard]] std::array<std::uint32_t, 2> wallsAt(std::uint32_t vertex) const {
    const std::uint32_t after = mWallFrom[vertex];
    return {mNeighbours[after][1], after};
  }

 private:
  void connectTriangles(const Monitor& monitor);
  void addWalls();

  LocalFrame mFrame;
  Buffer<Vec3d> mPositions;
  Buffer<Triangle> mTriangles;
  Connectivity mConnectivity;
  std::vector<Wall> mWalls;
  std::vector<std::array<std::uint32_t, 3>> mNeighbours;
  std::vector<std::uint32_t> mWallFrom;  ///< By vertex, the wall that begins there.
};

}  // namespace pdc::detail
