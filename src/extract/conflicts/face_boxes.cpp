#include "extract/conflicts/face_boxes.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>

namespace pdc::detail {

Float4Box FaceBoxes::Boxes::nothing() {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  Float4Box box;
  box.low = Float4{kInfinity, kInfinity, kInfinity, kInfinity};
  box.high = -box.low;
  return box;
}

void FaceBoxes::add(std::int32_t block, std::vector<std::int32_t>& added) {
  if (mSlot[block] != kNone) return;
  mSlot[block] = static_cast<std::int32_t>(mBlocks.size());
  mBlocks.emplace_back().block = block;
  added.push_back(mSlot[block]);
}

void FaceBoxes::prepare(std::span<const std::int32_t> blocks, const Monitor& monitor) {
  const EdgeCells& cells = mFaces.edgeCells();
  std::vector<std::int32_t> added;
  std::array<std::int32_t, 27> near;
  for (const std::int32_t block : blocks) {
    if (mSlot[block] != kNone && mBlocks[mSlot[block]].nearCount != kNone) continue;
    add(block, added);
    int count = 0;
    const Coord& at = cells.blockCoord(block);
    for (int x = -1; x <= 1; ++x)
      for (int y = -1; y <= 1; ++y)
        for (int z = -1; z <= 1; ++z) {
          const std::int32_t other = cells.find({at[0] + x, at[1] + y, at[2] + z});
          if (other == BlockIndex::kMissing) continue;
          add(other, added);
          near[count++] = mSlot[other];
        }
    Block& center = mBlocks[mSlot[block]];
    center.near = near;
    center.nearCount = count;
  }
  tbb::parallel_for(std::size_t{0}, added.size(), [&](std::size_t i) {
    monitor.throwIfStopped();
    fill(mBlocks[added[i]]);
  });
}

Float4Box FaceBoxes::boxOf(const EdgeRef& e, std::uint64_t face) const {
  if (const Quad* quad = mFaces.quad(face)) return Float4Box(mFaces.corners(*quad));
  std::vector<Triangle> triangles;
  mFaces.triangles(e, face, triangles);
  Float4Box box(mFaces.corners(triangles[0]));
  for (const Triangle& t : triangles) box.add(Float4Box(mFaces.corners(t)));
  return box;
}

void FaceBoxes::fill(Block& b) const {
  const BlockTopology& topology = mFaces.edgeCells().block(b.block);
  b.edges.clear();
  b.faces.resize(topology.quadCount);
  b.batches.resize(b.faces.batchCount());
  for (const Axis axis : kAxes)
    for (int x = 0; x < kBlockSize; ++x)
      for (std::uint64_t left = topology.edges[axis].word[x]; left != 0; left &= left - 1) {
        const EdgeRef e{b.block, static_cast<std::uint16_t>(kBlockCells * axis + 64 * x + std::countr_zero(left))};
        b.faces.set(b.edges.size(), boxOf(e, topology.firstQuad + b.edges.size()));
        b.edges.push_back(e.edge);
      }
  b.all = Boxes::nothing();
  for (std::size_t batch = 0; batch < b.faces.batchCount(); ++batch) fillBatch(b, batch);
}

/// Makes the box about a batch of faces, and lets that about the block's grow.
void FaceBoxes::fillBatch(Block& b, std::size_t batch) {
  Float4Box box = Boxes::nothing();
  for (std::size_t i = kLanes * batch; i < std::min(kLanes * (batch + 1), b.edges.size()); ++i) box.add(b.faces.get(i));
  b.batches.set(batch, box);
  b.all.add(box);
}

void FaceBoxes::update(std::span<const EdgeRef> edges, const Monitor& monitor) {
  // Blocks are independent of each other.
  std::vector<std::size_t> starts;
  for (std::size_t i = 0; i < edges.size(); ++i)
    if (i == 0 || edges[i].block != edges[i - 1].block) starts.push_back(i);
  starts.push_back(edges.size());
  tbb::parallel_for(std::size_t{1}, starts.size(), [&](std::size_t s) {
    monitor.throwIfStopped();
    const std::int32_t slot = mSlot[edges[starts[s - 1]].block];
    if (slot == kNone) return;
    Block& b = mBlocks[slot];
    const std::uint64_t firstFace = mFaces.edgeCells().block(b.block).firstQuad;
    std::size_t batch = std::numeric_limits<std::size_t>::max();  // That of the face before.
    for (std::size_t i = starts[s - 1]; i < starts[s]; ++i) {
      const std::uint64_t face = mFaces.edgeCells().face(edges[i]) - firstFace;
      if (i > starts[s - 1] && face / kLanes != batch) fillBatch(b, batch);
      batch = face / kLanes;
      b.faces.set(face, boxOf(edges[i], firstFace + face));
    }
    fillBatch(b, batch);
  });
}

}  // namespace pdc::detail
