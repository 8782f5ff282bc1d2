#pragma once

#include <array>
#include <cstdint>

#include "sample/cell_edges.h"

/// Everything the topology of dual contouring needs to know of one cell, derived at compile time from how
/// its corners and edges are numbered (see cell_edges.h); face f = 2·axis + side. A *code* has bit c set if corner c is
/// inside.
///
/// A cell's surface meets its faces in *segments*, each joining two sign-changing edges of a face. Every such edge lies
/// in two faces, so segments close into cycles: the cell's *patches*, each of which gets one vertex. (Nielson 2004;
/// Schaefer, Ju & Warren 2007.) On a face with four sign changes the pairing is a choice: normally each inside corner
/// is cut off by itself; in a *flipped* cell each outside corner is.
namespace pdc::detail {

inline constexpr int kFaces = 6;
inline constexpr int kNone = 0xF;

/// The edge between two corners that differ in one bit.
constexpr int edgeBetween(int c0, int c1) {
  for (int e = 0; e < kEdges; ++e)
    if ((kCellEdge[e].low == c0 && kCellEdge[e].high == c1) || (kCellEdge[e].low == c1 && kCellEdge[e].high == c0))
      return e;
  return kNone;
}

/// Corner i (modulo 4) of the ring around a face.
constexpr int faceCorner(int f, int i) {
  const int a = f / 2, u = (a + 1) % 3, v = (a + 2) % 3;
  const int du = (i & 3) == 1 || (i & 3) == 2, dv = (i & 3) >= 2;
  return du << u | dv << v | (f & 1) << a;
}

/// kFaceEdge[f][i] joins corners i and i + 1 of the ring.
inline constexpr auto kFaceEdge = [] {
  std::array<std::array<std::uint8_t, 4>, kFaces> edge{};
  for (int f = 0; f < kFaces; ++f)
    for (int i = 0; i < 4; ++i)
      edge[f][i] = static_cast<std::uint8_t>(edgeBetween(faceCorner(f, i), faceCorner(f, i + 1)));
  return edge;
}();

constexpr bool isInside(int code, int corner) { return (code >> corner & 1) != 0; }
constexpr bool changesSign(int code, int e) {
  return isInside(code, kCellEdge[e].low) != isInside(code, kCellEdge[e].high);
}
/// True if the face has two inside corners that face each other.
constexpr bool isAmbiguous(int code, int f) {
  const bool a = isInside(code, faceCorner(f, 0)), b = isInside(code, faceCorner(f, 1));
  return a != b && a == isInside(code, faceCorner(f, 2)) && b == isInside(code, faceCorner(f, 3));
}

struct Segment {
  std::uint8_t edge0, edge1, face;
};
struct Segments {
  std::array<Segment, 12> at{};
  int size = 0;
};

constexpr Segments segments(int code, bool flip) {
  Segments s;
  for (int f = 0; f < kFaces; ++f) {
    const auto& ring = kFaceEdge[f];
    const auto add = [&](std::uint8_t e0, std::uint8_t e1) { s.at[s.size++] = {e0, e1, static_cast<std::uint8_t>(f)}; };
    if (isAmbiguous(code, f)) {
      for (int i = 0; i < 4; ++i)
        if (isInside(code, faceCorner(f, i)) != flip) add(ring[(i + 3) & 3], ring[i]);
    } else {
      std::array<std::uint8_t, 4> crossed{};
      int n = 0;
      for (const std::uint8_t e : ring)
        if (changesSign(code, e)) crossed[n++] = e;
      if (n == 2) add(crossed[0], crossed[1]);
    }
  }
  return s;
}

/// For each edge of a cell the number of its vertex, four bits each; kNone where there is none.
class EdgeVertices {
 public:
  constexpr EdgeVertices() = default;
  [[nodiscard]] constexpr int operator[](int edge) const { return static_cast<int>(mBits >> (4 * edge) & 0xF); }
  constexpr void set(int edge, int vertex) {
    mBits = (mBits & ~(std::uint64_t{0xF} << (4 * edge))) | static_cast<std::uint64_t>(vertex) << (4 * edge);
  }
  friend constexpr bool operator==(const EdgeVertices&, const EdgeVertices&) = default;

 private:
  std::uint64_t mBits = 0xFFFF'FFFF'FFFF;
};

struct Patches {
  EdgeVertices vertex;
  std::uint8_t count = 0;
};

/// Groups the edges of `present` (bit e) that segments connect, numbered in order of their smallest edge. With all
/// sign-changing edges present these are the cell's patches; with fewer, the runs of faces left of them.
constexpr Patches connect(const Segments& s, unsigned present) {
  std::array<int, kEdges> parent{};
  for (int e = 0; e < kEdges; ++e) parent[e] = e;
  const auto root = [&](int e) {
    while (parent[e] != e) e = parent[e];
    return e;
  };
  for (int i = 0; i < s.size; ++i) {
    const int e0 = s.at[i].edge0, e1 = s.at[i].edge1;
    if ((present >> e0 & present >> e1 & 1) == 0) continue;
    const int r0 = root(e0), r1 = root(e1);
    parent[r0 < r1 ? r1 : r0] = r0 < r1 ? r0 : r1;
  }
  Patches p;
  for (int e = 0; e < kEdges; ++e) {
    if ((present >> e & 1) == 0) continue;
    const int r = root(e);
    p.vertex.set(e, r == e ? p.count++ : p.vertex[r]);
  }
  return p;
}

struct CellEntry {
  std::uint16_t edges = 0;  ///< Sign-changing edges, bit e.
  Patches patches;          ///< Normal pairing.
  /// The only ambiguous face of a cell with one patch whose two segments on that face belong to the same patch, or
  /// kNone. Two such cells at the same face would give four faces at one mesh edge; both are flipped then.
  std::uint8_t flipFace = kNone;
  Patches flipped;         ///< Pairing when flipped; only where flipFace is set.
  bool ambiguous = false;  ///< Has several patches or an ambiguous face: not every vertex in the cell is safe.
};

constexpr CellEntry makeCellEntry(int code) {
  CellEntry entry;
  for (int e = 0; e < kEdges; ++e)
    if (changesSign(code, e)) entry.edges = static_cast<std::uint16_t>(entry.edges | 1u << e);
  entry.patches = connect(segments(code, false), entry.edges);
  for (int f = 0; f < kFaces && entry.patches.count == 1; ++f)
    if (isAmbiguous(code, f)) entry.flipFace = static_cast<std::uint8_t>(f);
  entry.ambiguous = entry.patches.count > 1;
  for (int f = 0; f < kFaces; ++f) entry.ambiguous = entry.ambiguous || isAmbiguous(code, f);
  if (entry.flipFace != kNone) entry.flipped = connect(segments(code, true), entry.edges);
  return entry;
}

constexpr std::array<CellEntry, 256> makeCellTable() {
  std::array<CellEntry, 256> table{};
  for (int code = 0; code < 256; ++code) table[code] = makeCellEntry(code);
  return table;
}

/// Indexed by code.
extern const std::array<CellEntry, 256> kCellTable;

}  // namespace pdc::detail
