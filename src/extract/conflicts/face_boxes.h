#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "extract/conflicts/face_tests.h"
#include "extract/conflicts/float4_box.h"
#include "math/lane_loops.h"
#include "pdc/monitor.h"

namespace pdc::detail {

/// The boxes of faces in world space, by the blocks of their edges, with a box about each batch of them: what may meet
/// a box is found by where faces are. Holds the blocks that were asked for and those beside them.
///
/// A face's block is that of its lattice edge. Faces reach so little beyond it (kMostReach) that those of blocks which
/// are not neighbours never meet.
///
/// About::forEach() is inline so that callers compile it for a SimdLevel.
class FaceBoxes {
 public:
  /// How far, along a lattice axis, a vertex may be from the low end of an edge whose face it belongs to: half a block
  /// less the edge itself.
  static constexpr double kMostReach = 0.5 * (kBlockSize + 1);

  explicit FaceBoxes(const FaceTests& faces) : mFaces(faces), mSlot(faces.edgeCells().blockCount(), kNone) {}

  /// Makes About work for these blocks. Runs in parallel. \param blocks sorted. \throws Cancelled
  void prepare(std::span<const std::int32_t> blocks, const Monitor& monitor);
  /// Takes note of faces that have changed. Runs in parallel. \param edges sorted. \throws Cancelled
  void update(std::span<const EdgeRef> edges, const Monitor& monitor);

  class About;

 private:
  static constexpr std::int32_t kNone = -1;
  static constexpr int kMostNear = 27;

  /// Boxes side by side, coordinate by coordinate, in batches of kLanes.
  class Boxes {
   public:
    void resize(std::size_t size) {
      mStride = (size + kLanes - 1) / kLanes * kLanes;
      mBounds.resize(6 * mStride);
      for (std::size_t i = size; i < mStride; ++i) set(i, nothing());
    }
    void set(std::size_t i, const Float4Box& box) {
      for (int k = 0; k < 3; ++k) {
        mBounds[k * mStride + i] = box.low[k];
        mBounds[(k + 3) * mStride + i] = box.high[k];
      }
    }
    [[nodiscard]] Float4Box get(std::size_t i) const {
      Float4Box box;
      for (int k = 0; k < 3; ++k) {
        box.low[k] = mBounds[k * mStride + i];
        box.high[k] = mBounds[(k + 3) * mStride + i];
      }
      box.low[3] = box.high[3] = 0;
      return box;
    }
    [[nodiscard]] std::size_t batchCount() const { return mStride / kLanes; }
    /// Calls visit(i) for the boxes that meet `box` until it returns false; \returns whether it never did.
    template <typename Visit>
    bool forEachMeeting(const Float4Box& box, Visit&& visit) const {
      for (std::size_t batch = 0; batch < batchCount(); ++batch)
        for (std::uint32_t hits = meeting(batch, box); hits != 0; hits &= hits - 1)
          if (!visit(kLanes * batch + std::countr_zero(hits))) return false;
      return true;
    }
    /// A bit for each box of a batch that meets `box`.
    [[nodiscard]] std::uint32_t meeting(std::size_t batch, const Float4Box& box) const {
      const float* b = &mBounds[kLanes * batch];
      const std::size_t s = mStride;
      const float lx = box.low[0], ly = box.low[1], lz = box.low[2];
      const float hx = box.high[0], hy = box.high[1], hz = box.high[2];
      alignas(64) std::int32_t bits[kLanes];
      forEachLane([=, &bits](int i) {
        const bool meets = (b[i] <= hx) & (b[s + i] <= hy) & (b[2 * s + i] <= hz) & (b[3 * s + i] >= lx) &
                           (b[4 * s + i] >= ly) & (b[5 * s + i] >= lz);
        bits[i] = meets ? 1 << i : 0;
      });
      return static_cast<std::uint32_t>(foldLanes(bits, [](auto& x, const auto& y) { x |= y; }));
    }
    /// A box that meets none.
    static Float4Box nothing();

   private:
    std::size_t mStride = 0;
    std::vector<float> mBounds;
  };

  struct Block {
    std::int32_t block;
    Float4Box all;
    Boxes batches, faces;
    std::vector<std::uint16_t> edges;          ///< Of each face, as EdgeRef has it.
    std::array<std::int32_t, kMostNear> near;  ///< The places in mBlocks of this one and its neighbours.
    int nearCount = kNone;                     ///< kNone: they have not been looked for.
  };

  void add(std::int32_t block, std::vector<std::int32_t>& added);
  void fill(Block& block) const;
  static void fillBatch(Block& block, std::size_t batch);
  [[nodiscard]] Float4Box boxOf(const EdgeRef& e, std::uint64_t face) const;

  const FaceTests& mFaces;
  std::vector<std::int32_t> mSlot;  ///< By block of the surface: its place in mBlocks, or kNone.
  std::vector<Block> mBlocks;
};

/// Finds what is near the faces of a block.
class FaceBoxes::About {
 public:
  /// \param block must have been prepared. No face may change while this is used.
  About(const FaceBoxes& boxes, std::int32_t block) : mFaces(boxes.mFaces) {
    const Block& center = boxes.mBlocks[boxes.mSlot[block]];
    mNear.resize(kMostNear);
    for (int n = 0; n < center.nearCount; ++n) {
      mBlocks[n] = &boxes.mBlocks[center.near[n]];
      mNear.set(n, mBlocks[n]->all);
    }
    for (int n = center.nearCount; n < kMostNear; ++n) mNear.set(n, Boxes::nothing());
  }

  /// Calls visit(edge, number of its face), until it returns false, for the faces whose boxes meet a box that lies in
  /// or near the block: in an order that depends on nothing but where blocks are.
  template <typename Visit>
  void forEach(const Float4Box& box, Visit&& visit) const {
    mNear.forEachMeeting(box, [&](std::size_t n) {
      const Block& b = *mBlocks[n];
      const std::uint64_t firstFace = mFaces.edgeCells().block(b.block).firstQuad;
      return b.batches.forEachMeeting(box, [&](std::size_t batch) {
        for (std::uint32_t hits = b.faces.meeting(batch, box); hits != 0; hits &= hits - 1) {
          const std::size_t i = kLanes * batch + std::countr_zero(hits);
          if (!visit(EdgeRef{b.block, b.edges[i]}, firstFace + i)) return false;
        }
        return true;
      });
    });
  }

 private:
  const FaceTests& mFaces;
  std::array<const Block*, kMostNear> mBlocks;
  Boxes mNear;
};

}  // namespace pdc::detail
