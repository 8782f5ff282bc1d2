#include "extract/certify/working_mesh.h"

#include <algorithm>
#include <array>
#include <atomic>

#include "parallel/gather.h"
#include "parallel/sort_unique.h"

namespace pdc::detail {
namespace {

/// By number of retractions, the share of the way from its safe place at which a vertex lies: on creases that are
/// known, and elsewhere. Steps of halves cost half of the sharpness of creases.
constexpr auto kShareOnCrease = std::to_array<float>({1, 0.9F, 0.8F, 0.7F, 0.6F, 0.5F, 0.35F, 0.2F, 0});
constexpr auto kShare = std::to_array<float>({1, 0.9F, 0.75F, 0.5F, 0.25F, 0});

std::span<const float> sharesOf(const VertexState& v) {
  if (v.onKnownCrease()) return kShareOnCrease;
  return kShare;
}

Quad otherDiagonal(const Quad& q) { return {q[1], q[2], q[3], q[0]}; }

}  // namespace

WorkingMesh::WorkingMesh(const Surface& surface, const std::vector<SuspectVertex>& suspects, Mesh& mesh,
                         const Monitor& monitor)
    : mEdgeCells(surface.blocks, surface.topology),
      mFans(surface.source, surface.blocks, mEdgeCells, mesh),
      mVertices(suspects.begin(), suspects.end()),
      mAtEnd(suspects.size(), 0),
      mFaces(surface.source.map(), mEdgeCells, mFans, SuspectIndex(suspects), mVertices, mesh),
      mMesh(mesh),
      mMonitor(monitor) {
  for (std::size_t i = 0; i < suspects.size(); ++i)
    if (suspects[i].onKnownCrease()) mOnCreases.push_back(i);
}

bool WorkingMesh::fullyRetracted(const VertexState& v) { return v.retractions + std::size_t{1} >= sharesOf(v).size(); }

std::ptrdiff_t WorkingMesh::movable(std::uint32_t vertex) const {
  const std::ptrdiff_t i = mFaces.suspectNumber(vertex);
  return i < 0 || mAtEnd[static_cast<std::size_t>(i)] != 0 ? -1 : i;
}

void WorkingMesh::moveTo(std::size_t i, const Vec3f& place) {
  VertexState& v = mVertices[i];
  v.place = place;
  mMesh.positions[v.vertex] = mFaces.worldPosition(v, place);
}

void WorkingMesh::retract(std::size_t i, int steps) {
  VertexState& v = mVertices[i];
  const std::span<const float> shares = sharesOf(v);
  v.retractions = static_cast<std::uint8_t>(std::min<std::size_t>(v.retractions + steps, shares.size() - 1));
  mAtEnd[i] = fullyRetracted(v);
  moveTo(i, v.safe + (v.retractedFrom - v.safe) * shares[v.retractions]);
}

void WorkingMesh::restartAt(std::size_t i, const Vec3f& place) {
  mVertices[i].retractedFrom = place;
  mVertices[i].retractions = 0;
  mAtEnd[i] = 0;
  moveTo(i, place);
}

std::vector<EdgeRef> WorkingMesh::quadsAt(std::span<const std::size_t> vertices) const {
  std::vector<EdgeRef> quads = gather<EdgeRef>(vertices.size(), [&](std::size_t i, std::vector<EdgeRef>& out) {
    mMonitor.throwIfStopped();
    mEdgeCells.forEachEdgeAt(mVertices[vertices[i]], [&](const EdgeRef& e) { out.push_back(e); });
  });
  sortUnique(quads);
  return quads;
}

bool WorkingMesh::fixed(const EdgeRef& e) const {
  const Quad& quad = mMesh.quads[mEdgeCells.face(e)];
  return std::none_of(quad.begin(), quad.end(), [this](std::uint32_t v) { return movable(v) >= 0; });
}

Quad WorkingMesh::turned(const EdgeRef& e) const { return otherDiagonal(mMesh.quads[mEdgeCells.face(e)]); }

void WorkingMesh::turn(const std::vector<EdgeRef>& edges) {
  for (const EdgeRef& e : edges) mMesh.quads[mEdgeCells.face(e)] = turned(e);
  mTurnCount += edges.size();
  const auto middle = mTurned.insert(mTurned.end(), edges.begin(), edges.end());
  std::inplace_merge(mTurned.begin(), middle, mTurned.end());
}

bool WorkingMesh::turnedBefore(const EdgeRef& e) const { return std::binary_search(mTurned.begin(), mTurned.end(), e); }

void WorkingMesh::chooseSafeDiagonals(const std::vector<EdgeRef>& edges) {
  std::atomic<std::size_t> turns{0};
  const std::vector<EdgeRef> fans = gather<EdgeRef>(edges.size(), [&](std::size_t i, std::vector<EdgeRef>& out) {
    mMonitor.throwIfStopped();
    const EdgeRef& e = edges[i];
    const std::uint64_t face = mEdgeCells.face(e);
    if (mFans.has(face) || !fixed(e)) return;
    Quad& quad = mMesh.quads[face];
    if (mFaces.passes(e, quad)) return;
    const Quad other = otherDiagonal(quad);
    if (!mFaces.passes(e, other)) return out.push_back(e);
    quad = other;
    turns.fetch_add(1, std::memory_order_relaxed);
  });
  for (const EdgeRef& e : fans) {
    mMonitor.throwIfStopped();
    mFans.add(e);
  }
  mTurnCount += turns;
}

}  // namespace pdc::detail
