#include "extract/certify/certify_history.h"

#include <array>
#include <bit>

namespace pdc::detail {
namespace {

std::uint64_t word(float a, float b) {
  return std::uint64_t{std::bit_cast<std::uint32_t>(a)} << 32 | std::bit_cast<std::uint32_t>(b);
}

/// All that the next round may look at.
struct FaceState {
  std::array<std::uint64_t, 32> words;
  std::size_t size = 0;

  void add(std::uint64_t w) { words[size++] = w; }
};

FaceState stateOf(const WorkingMesh& mesh, const EdgeRef& e, std::uint64_t round) {
  const Coord& block = mesh.edgeCells().blockCoord(e.block);
  const std::uint64_t face = mesh.edgeCells().face(e);
  FaceState state;
  state.add(round);
  for (int axis = 0; axis < 3; ++axis) state.add(static_cast<std::uint32_t>(block[axis]));
  state.add(std::uint64_t{e.edge} << 1 | std::uint64_t{mesh.fans().has(face)});
  // The order of the corners says which diagonal it is.
  for (const std::uint32_t corner : mesh.mesh().quads[face]) {
    const Vec3f& p = mesh.mesh().positions[corner];
    state.add(word(p.x, p.y));
    const std::ptrdiff_t i = mesh.faces().suspectNumber(corner);
    state.add(word(p.z, i < 0 ? 0.0F : 1.0F));
    if (i < 0) continue;
    const VertexState& v = mesh.vertices()[static_cast<std::size_t>(i)];
    state.add(std::uint64_t{v.retractions} << 8 | v.creaseMoves | std::uint64_t{v.unresolvedConflicts} << 16);
    state.add(word(v.retractedFrom.x, v.retractedFrom.y));
    state.add(word(v.retractedFrom.z, 0));
  }
  return state;
}

}  // namespace

void LayerHash::add(std::span<const std::uint64_t> words) {
  const Hash128 hash = hashOf(words);
  for (std::size_t i = 0; i < hash.size(); ++i) sum[i] += hash[i];
}

void CertifyHistory::record(const WorkingMesh& mesh, std::span<const EdgeRef> faces) {
  const std::uint64_t round = mPhase << 32 | mRound++;
  for (const EdgeRef& e : faces) {
    mesh.monitor().throwIfStopped();
    const std::int64_t layer = std::int64_t{mesh.edgeCells().blockCoord(e.block)[0]} - mFirst;
    if (layer < 0 || layer >= static_cast<std::int64_t>(mLayers.size())) continue;
    const FaceState state = stateOf(mesh, e, round);
    mLayers[static_cast<std::size_t>(layer)].add({state.words.data(), state.size});
  }
}

}  // namespace pdc::detail
