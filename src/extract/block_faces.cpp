#include "extract/block_faces.h"

#include <tbb/parallel_for.h>

#include <bit>

#include "extract/block_progress.h"

namespace pdc::detail {
namespace {

/// The four cells about a lattice edge along `axis`, counter-clockwise seen from its high end: steps back along the
/// next axis and the one after.
constexpr int kRing[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};

/// Centres of those cells from the edge's low end, by axis.
constexpr auto kRingCenter = [] {
  std::array<std::array<Vec3f, 4>, 3> center{};
  for (int axis = 0; axis < 3; ++axis)
    for (int k = 0; k < 4; ++k) {
      center[axis][k] = {0.5F, 0.5F, 0.5F};
      center[axis][k][(axis + 1) % 3] -= static_cast<float>(kRing[k][0]);
      center[axis][k][(axis + 2) % 3] -= static_cast<float>(kRing[k][1]);
    }
  return center;
}();

/// A quad in ring order, with its vertices' places relative to the edge's low end.
struct RingQuad {
  Quad vertex;
  std::array<Vec3f, 4> place;
};

class BlockFaceWriter {
 public:
  BlockFaceWriter(const SurfaceBlocks& blocks, const Topology& topology, const VertexError* errors, bool mirrored,
                  Quad* quads, Triangle* triangles)
      : mBlocks(blocks),
        mTopology(topology),
        mErrors(errors),
        mMirrored(mirrored),
        mQuads(quads),
        mTriangles(triangles) {}

  void run(std::size_t block) const {
    const BlockTopology& own = mTopology.blocks[block];
    std::uint64_t face = own.firstQuad;
    for (int axis = 0; axis < 3; ++axis)
      for (int x = 0; x < kBlockSize; ++x)
        for (std::uint64_t w = own.edges[axis].word[x]; w != 0; w &= w - 1) {
          const int bit = std::countr_zero(w), y = bit >> 3, z = bit & 7;
          const RingQuad ring = gather(own, axis, {x, y, z});
          const bool reversed = mBlocks.signs[block].inside(x, y, z) == mMirrored;
          write(ring.vertex, splitsAtFirst(ring), reversed, face++);
        }
  }

 private:
  RingQuad gather(const BlockTopology& own, int axis, const Coord& p) const {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    RingQuad ring;
    for (int k = 0; k < 4; ++k) {
      const auto [du, dv] = kRing[k];
      Coord c = p;
      c[u] -= du;
      c[v] -= dv;
      const int lower = (c[0] < 0) << 2 | (c[1] < 0) << 1 | (c[2] < 0);
      const BlockTopology& b = lower == 0 ? own : mTopology.blocks[own.lower[lower]];
      const std::uint64_t vertex = b.vertexAt(c[0] & 7, c[1] & 7, c[2] & 7, 4 * axis + du + 2 * dv);
      ring.vertex[k] = static_cast<std::uint32_t>(vertex);
      ring.place[k] = kRingCenter[axis][k] + mErrors[vertex].x;
    }
    return ring;
  }

  /// True for the diagonal from corner 0 to 2, false for 1 to 3.
  bool splitsAtFirst(const RingQuad& ring) const {
    const Vec3f m02 = (ring.place[0] + ring.place[2]) * 0.5F, m13 = (ring.place[1] + ring.place[3]) * 0.5F;
    float e02 = 0, e13 = 0;
    for (int k = 0; k < 4; ++k) {
      const VertexError& e = mErrors[ring.vertex[k]];
      e02 += e.at(m02 - ring.place[k]);
      e13 += e.at(m13 - ring.place[k]);
    }
    return !(e13 < e02);
  }

  void write(const Quad& v, bool splitsAtFirst, bool reversed, std::uint64_t face) const {
    const int start = splitsAtFirst ? 0 : 1;
    Quad q;
    for (int k = 0; k < 4; ++k) q[k] = v[(start + (reversed ? 4 - k : k)) & 3];
    if (mQuads != nullptr) {
      mQuads[face] = q;
    } else {
      mTriangles[2 * face] = {q[0], q[1], q[2]};
      mTriangles[2 * face + 1] = {q[0], q[2], q[3]};
    }
  }

  const SurfaceBlocks& mBlocks;
  const Topology& mTopology;
  const VertexError* mErrors;
  bool mMirrored;
  Quad* mQuads;
  Triangle* mTriangles;
};

}  // namespace

void writeFaces(const SurfaceBlocks& blocks, const Topology& topology, const VertexError* errors, bool mirrored,
                Quad* quads, Triangle* triangles, const Monitor& monitor) {
  BlockProgress progress(monitor, "faces", blocks.coords.size());
  const BlockFaceWriter writer(blocks, topology, errors, mirrored, quads, triangles);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, blocks.coords.size(), 64), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) writer.run(i);
    progress.advance(range.size());
  });
}

}  // namespace pdc::detail
