#pragma once

#include <cstddef>

#include "pdc/math/box.h"
#include "pdc/mesh/mesh.h"
#include "pdc/monitor.h"

namespace pdc {

/// Plain facts about a mesh taken as a soup of indexed faces. Quads and polygons count as one face with as many edges
/// as corners for topology; for area and volume, quads as the two triangles that they stand for and polygons as those
/// that triangulatePolygons() makes.
struct MeshReport {
  std::size_t vertices = 0, quads = 0, triangles = 0, polygons = 0;
  std::size_t edges = 0;
  std::size_t boundaryEdges = 0;        ///< Edges with one face.
  std::size_t nonManifoldEdges = 0;     ///< Edges with more than two faces.
  std::size_t misorientedEdges = 0;     ///< Edges with two faces that run through them in the same direction.
  std::size_t nonManifoldVertices = 0;  ///< Vertices whose faces do not form one fan (closed or open).
  std::size_t unusedVertices = 0;       ///< Vertices without a face.
  std::size_t degenerateFaces = 0;      ///< Faces that name a vertex twice.
  std::size_t duplicateFaces = 0;       ///< Faces with the same set of vertices as an earlier one.
  std::size_t nonFiniteVertices = 0;  ///< Vertices with a NaN or infinite coordinate; left out of area, volume and box.
  std::size_t components = 0;         ///< Sets of faces connected through shared vertices.
  long long eulerNumber = 0;          ///< V - E + F, unused vertices left out.
  double area = 0;                    ///< World units squared.
  double volume = 0;                  ///< Signed, by the divergence theorem; positive if faces point outwards.
  Box bounds{};  ///< Holds the used vertices that are finite, in world coordinates; zero if there are none.
};

/// Runs in parallel; the result does not depend on the number of threads. \throws Error if a face names a vertex that
/// does not exist or there are more than 2^32 - 1 faces; std::invalid_argument as Mesh says; Cancelled, which is
/// noticed between passes over the mesh. No progress is reported.
[[nodiscard]] MeshReport analyze(const Mesh& mesh, const Monitor& monitor = {});

}  // namespace pdc
