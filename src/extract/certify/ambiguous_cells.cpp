#include "extract/certify/ambiguous_cells.h"

#include <array>
#include <optional>

#include "extract/conflicts/triangle_filters.h"
#include "extract/topology/edge_set.h"
#include "math/lane_loops.h"
#include "parallel/gather.h"

namespace pdc::detail {
namespace {

/// By code and edge of a cell, the edges that share an ambiguous face with it, as bits.
constexpr auto kAtOneFace = [] {
  std::array<std::array<std::uint16_t, kEdges>, 256> table{};
  for (int code = 0; code < 256; ++code)
    for (int f = 0; f < kFaces; ++f) {
      if (!isAmbiguous(code, f)) continue;
      for (const int e : kFaceEdge[f])
        for (const int other : kFaceEdge[f]) table[code][e] = static_cast<std::uint16_t>(table[code][e] | 1 << other);
    }
  return table;
}();

/// The faces at the edges of one cell after another.
class CellFaces {
 public:
  explicit CellFaces(const WorkingMesh& mesh) : mMesh(mesh) {}

  /// Appends both of each pair of the cell's faces that meet.
  void findMeeting(const CellRef& c, const EdgeSet& others, std::vector<EdgeRef>& out) {
    const int code = mMesh.edgeCells().code(c);
    mSize = 0;
    mMesh.edgeCells().forEachEdge(c, [&](const EdgeRef& e, int edge) {
      if (!others.has(e)) add(c, e, edge);
    });
    for (int i = 0; i < mSize; ++i)
      for (int j = 0; j < i; ++j) {
        Face &a = mFaces[i], &b = mFaces[j];
        const bool apart = a.vertex == b.vertex && (kAtOneFace[code][a.edge] >> b.edge & 1) == 0;
        if (!apart && !a.box.apartFrom(b.box) && meet(a, b)) out.insert(out.end(), {a.ref, b.ref});
      }
  }

 private:
  struct Face {
    EdgeRef ref;
    int edge;              ///< Its number in the cell.
    std::uint64_t vertex;  ///< The one in the cell.
    Quad quad;
    std::array<Vec3f, 4> corners;
    Float4Box box;
    std::optional<std::array<FilteredTriangle, 2>> triangles;  ///< Made when they are first needed.
  };

  void add(const CellRef& c, const EdgeRef& e, int edge) {
    Face& face = mFaces[mSize++];
    face.ref = e;
    face.edge = edge;
    face.vertex = mMesh.edgeCells().block(c.block).vertexAt(c.x, c.y, c.z, edge);
    face.quad = mMesh.mesh().quads[mMesh.edgeCells().face(e)];
    face.corners = mMesh.faces().corners(face.quad);
    face.box = Float4Box(face.corners);
    face.triangles.reset();
  }

  static const std::array<FilteredTriangle, 2>& trianglesOf(Face& face) {
    const auto triangle = [&face](int j) {
      return FilteredTriangle({face.quad[0], face.quad[j], face.quad[j + 1]},
                              {face.corners[0], face.corners[j], face.corners[j + 1]});
    };
    if (!face.triangles) face.triangles = std::array{triangle(1), triangle(2)};
    return *face.triangles;
  }

  static bool meet(Face& a, Face& b) {
    for (const FilteredTriangle& t : trianglesOf(a)) {
      if (all(t.plane.sides(b.quad, Points(b.corners))).same()) continue;
      for (const FilteredTriangle& u : trianglesOf(b))
        if (trianglesIntersect(t, u)) return true;
    }
    return false;
  }

  const WorkingMesh& mMesh;
  std::array<Face, kEdges> mFaces;
  int mSize = 0;
};

}  // namespace

std::vector<EdgeRef> facesMeetingInCells(const WorkingMesh& mesh, const std::vector<EdgeRef>& others) {
  const EdgeSet tested(mesh.edgeCells().blockCount(), others);
  const std::vector<VertexState>& vertices = mesh.vertices();
  return gather<EdgeRef>(vertices.size(), [&](std::size_t i, std::vector<EdgeRef>& out) {
    mesh.monitor().throwIfStopped();
    const VertexState& v = vertices[i];
    const bool seen = i > 0 && vertices[i - 1].block == v.block && vertices[i - 1].cell.number == v.cell.number;
    if (seen || !kCellTable[mesh.edgeCells().code(cellOf(v))].ambiguous) return;
    withSimd(bestSimdLevel(), [&] { CellFaces(mesh).findMeeting(cellOf(v), tested, out); });
  });
}

}  // namespace pdc::detail
