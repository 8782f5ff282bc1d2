#include <tbb/parallel_for.h>

#include <cstdint>
#include <utility>
#include <vector>

#include "extract/certify/folded_blocks.h"
#include "extract/certify/remedies.h"

namespace pdc::detail {
namespace {

/// Where vertices are on no known crease and a block has more conflicts than this, its faces are folded by noise: then
/// they take several steps at once. Clean creases of gradients have fewer.
constexpr std::ptrdiff_t kMostInBlock = 32;
constexpr int kStepsInNoise = 3;

FoldedBlocks foldedBlocks(const std::vector<Conflict>& conflicts) {
  std::vector<std::int32_t> blocks;
  for (const Conflict& c : conflicts) blocks.push_back(c.edge0.block);
  return {std::move(blocks), kMostInBlock};
}

}  // namespace

std::vector<EdgeRef> retractVertices(WorkingMesh& mesh, NearFaces&, std::vector<Conflict>& conflicts) {
  const FoldedBlocks folded = foldedBlocks(conflicts);
  std::vector<std::uint8_t> isAtConflict(mesh.vertices().size(), 0);
  std::erase_if(conflicts, [&](const Conflict& c) {
    mesh.monitor().throwIfStopped();
    bool any = false;
    forEachCorner(c, [&](std::uint32_t v) {
      const std::ptrdiff_t i = mesh.movable(v);
      if (i >= 0) isAtConflict[static_cast<std::size_t>(i)] = 1;
      any = any || i >= 0;
    });
    return any;
  });
  std::vector<std::size_t> vertices;
  for (std::size_t i = 0; i < isAtConflict.size(); ++i)
    if (isAtConflict[i] != 0) vertices.push_back(i);
  tbb::parallel_for(std::size_t{0}, vertices.size(), [&](std::size_t i) {
    const VertexState& v = mesh.vertices()[vertices[i]];
    const bool inNoise = !v.onKnownCrease() && folded.has(v.block);
    mesh.retract(vertices[i], inNoise ? kStepsInNoise : 1);
  });
  std::vector<EdgeRef> changed = mesh.quadsAt(vertices);
  mesh.chooseSafeDiagonals(changed);
  return changed;
}

}  // namespace pdc::detail
