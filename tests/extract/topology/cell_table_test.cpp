#include "extract/topology/cell_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <map>
#include <set>
#include <vector>

namespace pdc::detail {
namespace {

/// Code of the cell at (cx, cy, cz) in a lattice of bits, nx by ny by nz points, x fastest.
struct SignLattice {
  int nx, ny, nz;
  unsigned bits;

  [[nodiscard]] bool inside(int x, int y, int z) const { return (bits >> (x + nx * (y + ny * z)) & 1) != 0; }
  [[nodiscard]] int code(int cx, int cy, int cz) const {
    int c = 0;
    for (int k = 0; k < 8; ++k) c |= inside(cx + (k & 1), cy + (k >> 1 & 1), cz + (k >> 2)) << k;
    return c;
  }
};

const Patches& patches(int code, bool flip) { return flip ? kCellTable[code].flipped : kCellTable[code].patches; }

TEST(CellTable, PatchesAreClosedCyclesThatPartitionTheEdges) {
  for (int code = 0; code < 256; ++code)
    for (const bool flip : {false, true}) {
      const CellEntry& entry = kCellTable[code];
      if (flip && entry.flipFace == kNone) continue;
      const Patches& p = patches(code, flip);
      std::array<int, 4> size{};
      for (int e = 0; e < kEdges; ++e) {
        EXPECT_EQ(p.vertex[e] != kNone, changesSign(code, e)) << code;
        if (p.vertex[e] != kNone) ++size.at(p.vertex[e]);
      }
      for (int v = 0; v < p.count; ++v) EXPECT_GE(size[v], 3) << code;
      // Each crossed edge has two segments, so segments close into cycles; a patch is one cycle, not several.
      const Segments s = segments(code, flip);
      std::array<int, kEdges> degree{};
      std::array<int, kFaces> perFace{};
      for (int i = 0; i < s.size; ++i) {
        ++degree[s.at[i].edge0];
        ++degree[s.at[i].edge1];
        ++perFace[s.at[i].face];
        EXPECT_EQ(p.vertex[s.at[i].edge0], p.vertex[s.at[i].edge1]);
      }
      for (int e = 0; e < kEdges; ++e) EXPECT_EQ(degree[e], changesSign(code, e) ? 2 : 0);
      for (int f = 0; f < kFaces; ++f) EXPECT_EQ(perFace[f], isAmbiguous(code, f) ? 2 : perFace[f] & 1);
    }
}

TEST(CellTable, ThirtySixCodesCanFlip) {
  int flippable = 0;
  for (int code = 0; code < 256; ++code) {
    const CellEntry& entry = kCellTable[code];
    if (entry.flipFace == kNone) continue;
    ++flippable;
    int ambiguous = 0;
    for (int f = 0; f < kFaces; ++f) ambiguous += isAmbiguous(code, f);
    EXPECT_EQ(ambiguous, 1);
    EXPECT_EQ(entry.patches.count, 1);
    EXPECT_EQ(entry.flipped.count, 2);
  }
  EXPECT_EQ(flippable, 36);
}

// One piece inside, two opposite corners outside: two cycles. Counting inside pieces instead would pinch the surface.
TEST(CellTable, OppositeOutsideCornersGetTwoVertices) {
  for (const int code : {126, 189, 219, 231}) EXPECT_EQ(kCellTable[code].patches.count, 2) << code;
}

/// Vertex pairs of the segments on the face between two cells, from both sides; a pair that occurs twice would give one
/// mesh edge four faces. Cell 1 lies beyond face 2·axis + 1 of cell 0.
bool facePairsDistinct(int axis, int code0, bool flip0, int code1, bool flip1) {
  const Segments s0 = segments(code0, flip0), s1 = segments(code1, flip1);
  const auto onFace = [](const Segments& s, int face) {
    std::set<std::pair<int, int>> edges;
    for (int i = 0; i < s.size; ++i)
      if (s.at[i].face == face) edges.insert(std::minmax<int>(s.at[i].edge0, s.at[i].edge1));
    return edges;
  };
  const auto mine = onFace(s0, 2 * axis + 1);
  std::set<std::pair<int, int>> theirs;
  // The same lattice edge is, in cell 1, the edge one step lower along the axis.
  for (const auto& [a, b] : onFace(s1, 2 * axis)) {
    const auto across = [&](int e) { return edgeBetween(kCellEdge[e].low | 1 << axis, kCellEdge[e].high | 1 << axis); };
    theirs.insert(std::minmax(across(a), across(b)));
  }
  EXPECT_EQ(mine, theirs) << "the cells disagree about the segments of their common face";
  std::set<std::pair<int, int>> vertexPairs;
  for (const auto& [a, b] : mine) {
    const int back = edgeBetween(kCellEdge[a].low & ~(1 << axis), kCellEdge[a].high & ~(1 << axis));
    if (!vertexPairs.insert({patches(code0, flip0).vertex[a], patches(code1, flip1).vertex[back]}).second) return false;
  }
  return true;
}

// All 2^12 sign patterns of two cells at a common face, along each axis.
TEST(CellTable, NoMeshEdgeIsUsedTwiceBetweenTwoCells) {
  int badWithoutRule = 0, cases = 0;
  for (int axis = 0; axis < 3; ++axis)
    for (unsigned bits = 0; bits < 1u << 12; ++bits, ++cases) {
      const std::array<int, 3> n{axis == 0 ? 3 : 2, axis == 1 ? 3 : 2, axis == 2 ? 3 : 2};
      const SignLattice lattice{n[0], n[1], n[2], bits};
      const int code0 = lattice.code(0, 0, 0), code1 = lattice.code(axis == 0, axis == 1, axis == 2);
      const bool flip = kCellTable[code0].flipFace == 2 * axis + 1 && kCellTable[code1].flipFace == 2 * axis;
      // If both could flip and see each other over this face, each is the neighbour the other's rule asks about.
      const bool rule0 = kCellTable[code0].flipFace == 2 * axis + 1 && kCellTable[code1].flipFace != kNone;
      const bool rule1 = kCellTable[code1].flipFace == 2 * axis && kCellTable[code0].flipFace != kNone;
      EXPECT_EQ(rule0, flip);
      EXPECT_EQ(rule1, flip);
      EXPECT_TRUE(facePairsDistinct(axis, code0, flip, code1, flip)) << bits;
      if (flip) badWithoutRule += !facePairsDistinct(axis, code0, false, code1, false);
    }
  EXPECT_EQ(cases, 3 << 12);
  EXPECT_GT(badWithoutRule, 0) << "the rule is not needed: the test does not bite";
}

/// The 3×3×2 points about a lattice edge along z: four cells in order about the edge, and the central quad's use of
/// each of them.
class EdgeNeighbourhood {
 public:
  explicit EdgeNeighbourhood(unsigned bits) : mLattice{3, 3, 2, bits} {
    for (int k = 0; k < 4; ++k) code[k] = mLattice.code(kCell[k][0], kCell[k][1], 0);
  }

  /// Ring of the cells about the central edge: steps back (0,0), (1,0), (1,1), (0,1) from (1, 1).
  static constexpr int kCell[4][2] = {{1, 1}, {0, 1}, {0, 0}, {1, 0}};
  std::array<int, 4> code{};

  [[nodiscard]] bool central() const { return mLattice.inside(1, 1, 0) != mLattice.inside(1, 1, 1); }
  /// The central edge in cell k.
  static int centralEdge(int k) {
    const int low = (1 - kCell[k][0]) | (1 - kCell[k][1]) << 1;
    return edgeBetween(low, low | 4);
  }
  /// Face of cell k towards cell k + 1.
  static int faceToNext(int k) {
    const int axis = kCell[k][0] != kCell[(k + 1) & 3][0] ? 0 : 1;
    return 2 * axis + (kCell[(k + 1) & 3][axis] > kCell[k][axis]);
  }

 private:
  SignLattice mLattice;
};

/// Whether a cell about a quad flips: never, always, or as a cell beyond the four says.
enum class Flip { kNever, kOutside, kAlways };

std::array<Flip, 4> flipsOf(const EdgeNeighbourhood& at) {
  std::array<Flip, 4> flips{};
  for (int k = 0; k < 4; ++k) {
    const int face = kCellTable[at.code[k]].flipFace, next = (k + 1) & 3, previous = (k + 3) & 3;
    const auto ifFlippable = [&](int cell) {
      return kCellTable[at.code[cell]].flipFace != kNone ? Flip::kAlways : Flip::kNever;
    };
    if (face == kNone) {
      flips[k] = Flip::kNever;
    } else if (face == EdgeNeighbourhood::faceToNext(k)) {
      flips[k] = ifFlippable(next);
    } else if ((face ^ 1) == EdgeNeighbourhood::faceToNext(previous)) {
      flips[k] = ifFlippable(previous);
    } else {
      flips[k] = Flip::kOutside;
    }
  }
  return flips;
}

/// The edges that segments join to the central edge in face `f` of a cell.
std::vector<int> partners(const EdgeNeighbourhood& at, int cell, bool flip, int f) {
  const Segments s = segments(at.code[cell], flip);
  const int e = EdgeNeighbourhood::centralEdge(cell);
  std::vector<int> found;
  for (int i = 0; i < s.size; ++i)
    if (s.at[i].face == f && (s.at[i].edge0 == e || s.at[i].edge1 == e))
      found.push_back(s.at[i].edge0 == e ? s.at[i].edge1 : s.at[i].edge0);
  return found;
}

/// The side of the quad between cells k and the next is the segment of their common face at the central edge: both
/// cells continue it to the same edge, and no other segment of the face joins the same two vertices.
void expectOneNeighbour(const EdgeNeighbourhood& at, const std::array<bool, 4>& flip, int k) {
  const int n = (k + 1) & 3, face = EdgeNeighbourhood::faceToNext(k), axis = face / 2;
  const auto here = partners(at, k, flip[k], face), there = partners(at, n, flip[n], face ^ 1);
  ASSERT_EQ(here.size(), 1u);
  ASSERT_EQ(there.size(), 1u);
  const auto flat = [&](int e) { return std::pair{kCellEdge[e].axis, kCellEdge[e].low & ~(1 << axis)}; };
  ASSERT_EQ(flat(here[0]), flat(there[0])) << "the two cells continue the surface differently";
  const Patches own = patches(at.code[k], flip[k]), next = patches(at.code[n], flip[n]);
  const Segments s = segments(at.code[k], flip[k]);
  int same = 0;
  for (int i = 0; i < s.size; ++i) {
    if (s.at[i].face != face) continue;
    const int e = s.at[i].edge0, across = edgeBetween(kCellEdge[e].low ^ 1 << axis, kCellEdge[e].high ^ 1 << axis);
    same += own.vertex[e] == own.vertex[EdgeNeighbourhood::centralEdge(k)] &&
            next.vertex[across] == next.vertex[EdgeNeighbourhood::centralEdge(n)];
  }
  ASSERT_EQ(same, 1);
}

// All 2^18 neighbourhoods of a lattice edge. Whether a cell flips can depend on a cell outside, so wherever it does
// both answers are tried: on each of the central quad's four sides exactly one other quad continues it, and no diagonal
// recurs.
TEST(CellTable, EverySideOfAQuadHasExactlyOneNeighbour) {
  long quads = 0;
  for (unsigned bits = 0; bits < 1u << 18; ++bits) {
    const EdgeNeighbourhood at(bits);
    if (!at.central()) continue;
    const std::array<Flip, 4> flips = flipsOf(at);
    for (unsigned choice = 0; choice < 16; ++choice) {
      std::array<bool, 4> flip{};
      bool possible = true;
      for (int k = 0; k < 4; ++k) {
        const bool chosen = (choice >> k & 1) != 0;
        possible &= !chosen || flips[k] == Flip::kOutside;
        flip[k] = flips[k] == Flip::kAlways || chosen;
      }
      if (!possible) continue;
      ++quads;
      for (int k = 0; k < 4; ++k) ASSERT_NO_FATAL_FAILURE(expectOneNeighbour(at, flip, k)) << "bits " << bits;
    }
  }
  EXPECT_GT(quads, 1 << 17);
}

}  // namespace
}  // namespace pdc::detail
