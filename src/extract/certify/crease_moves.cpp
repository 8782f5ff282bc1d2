#include "extract/certify/crease_moves.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "extract/certify/folded_blocks.h"
#include "extract/certify/vertex_trial.h"
#include "parallel/gather.h"
#include "parallel/sort_unique.h"

namespace pdc::detail {
namespace {

// Chosen with bench/feature_eval, noise 0 and 0.02, on the tuning shapes. With half as many steps within sides the
// edges of a wedge of 60° were 5 % less exact; with more moves nothing gets better.

/// Steps along a crease and within one of its sides, in lattice units.
constexpr std::array<float, 5> kAlong{0.03F, 0.08F, 0.16F, 0.3F, 0.5F};
constexpr std::array<float, 8> kWithin{0.01F, 0.02F, 0.03F, 0.05F, 0.07F, 0.1F, 0.14F, 0.2F};
/// Shares of the way from the safe place; and finer ones, for vertices whose neighbours move no more.
constexpr std::array<float, 4> kStraight{0.98F, 0.94F, 0.85F, 0.6F};
constexpr std::array<float, 8> kForward{0.99F, 0.97F, 0.95F, 0.92F, 0.88F, 0.8F, 0.7F, 0.5F};
/// How often a vertex moves.
constexpr std::uint8_t kMostMoves = 3;
/// Where faces meet more others than this, no single move helps.
constexpr std::size_t kMostConflicts = 12;
/// Where a block has more conflicts, or vertices off their places, its faces are folded by noise: no single move helps,
/// and trying them takes long.
constexpr std::ptrdiff_t kMostInBlock = 64;

Vec3f scaledTo(const Vec3d& v, double wanted) {
  const double l = length(v);
  return l > 0 ? vecCast<float>(v * (wanted / l)) : Vec3f{};
}

/// A vertex's place, in lattice units from the centre of its cell, and others along its crease.
std::vector<Vec3f> placesAlong(const SuspectVertex& v, const Mat3d& M) {
  std::vector<Vec3f> places{v.place};
  const Mat3d toLattice = inverse(M);
  const auto& n = v.creaseNormals;
  for (const float step : kAlong)
    for (int i = 1; i < 3; ++i)
      for (int j = 0; j < i; ++j) {
        const Vec3f along = scaledTo(toLattice * cross(vecCast<double>(n[i]), vecCast<double>(n[j])), double{step});
        if (along != Vec3f{}) places.insert(places.end(), {v.place + along, v.place - along});
      }
  return places;
}

/// Appends places away from the crease of a vertex, the costliest last.
void addPlacesOffCrease(const SuspectVertex& v, const Mat3d& M, std::vector<Vec3f>& places) {
  const Vec3d way = vecCast<double>(v.safe - v.place);
  for (const float step : kWithin)
    for (const Vec3f& normal : v.creaseNormals) {
      const Vec3d m = M.transposed() * vecCast<double>(normal);
      if (!(dot(m, m) > 0)) break;
      const Vec3d within = way - m * (dot(m, way) / dot(m, m));
      if (length(within) > double{step}) places.push_back(v.place + scaledTo(within, double{step}));
    }
  for (const float share : kStraight) places.push_back(v.safe + (v.place - v.safe) * share);
}

/// The best place found for a vertex.
struct Found {
  std::size_t conflicts = 0;  ///< How many its faces have there.
  std::size_t tried = 0;      ///< How many had been tried before; 0: it is where the vertex is.
  Vec3f place{};
};

Found findPlace(const FaceBoxes& boxes, const FaceTests& faces, const VertexState& vertex) {
  const Mat3d M = faces.map().jacobian({});
  std::vector<Vec3f> places = placesAlong(vertex, M);
  addPlacesOffCrease(vertex, M, places);
  std::vector<Vec3f> world(places.size());
  std::transform(places.begin(), places.end(), world.begin(),
                 [&](const Vec3f& p) { return faces.worldPosition(vertex, p); });
  VertexTrial trial(boxes, faces, vertex, world);
  Found best{trial.countConflicts(0, kMostConflicts + 1)};
  if (best.conflicts == vertex.unresolvedConflicts || best.conflicts > kMostConflicts) return best;
  for (std::size_t i = 1; i < places.size() && best.conflicts > 0; ++i) {
    const std::size_t conflicts = trial.countConflicts(i, best.conflicts);
    if (conflicts < best.conflicts) best = {conflicts, i, places[i]};
  }
  return best;
}

/// The largest distance of a place from the planes that meet in a vertex's crease, in world units.
double distanceFromPlanes(const SuspectVertex& v, const Mat3d& M, const Vec3f& onCrease, const Vec3f& place) {
  const Vec3d offset = M * vecCast<double>(place - onCrease);
  double most = 0;
  for (const Vec3f& n : v.creaseNormals) most = std::max(most, std::abs(dot(vecCast<double>(n), offset)));
  return most;
}

/// The place nearest to the planes of the vertex's crease where its faces have no conflict; its own if there is none.
Vec3f findBetterPlace(const FaceBoxes& boxes, const FaceTests& faces, const VertexState& vertex) {
  const Mat3d M = faces.map().jacobian({});
  SuspectVertex wanted = vertex;
  wanted.place = vertex.wanted;
  const std::vector<Vec3f> along = placesAlong(wanted, M);
  std::vector<Vec3f> all = along;
  addPlacesOffCrease(wanted, M, all);
  for (const Vec3f& p : along)
    for (const float share : kForward) all.push_back(vertex.safe + (p - vertex.safe) * share);
  const double now = distanceFromPlanes(vertex, M, vertex.wanted, vertex.place);
  std::vector<std::pair<double, Vec3f>> places;
  for (const Vec3f& p : all)
    if (const double d = distanceFromPlanes(vertex, M, vertex.wanted, p); d < now) places.emplace_back(d, p);
  std::stable_sort(places.begin(), places.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<Vec3f> world;
  for (const auto& p : places) world.push_back(faces.worldPosition(vertex, p.second));
  world.push_back(faces.worldPosition(vertex, vertex.place));
  VertexTrial trial(boxes, faces, vertex, world);
  for (std::size_t i = 0; i < places.size(); ++i)
    if (trial.countConflicts(i, 1) == 0) return places[i].second;
  return vertex.place;
}

/// Whether the crease turns by more than 41°. Moving off a flatter one costs little.
bool isSharp(const SuspectVertex& v) {
  const auto& n = v.creaseNormals;
  for (std::size_t i = 1; i < n.size() && n[i] != Vec3f{}; ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (dot(n[i], n[j]) < 0.75F) return true;
  return false;
}

/// A vertex of a conflict that may move.
struct Candidate {
  std::size_t conflict, vertex;  ///< Their numbers.
};

std::vector<Candidate> findCandidates(const WorkingMesh& mesh, const std::vector<Conflict>& conflicts) {
  std::vector<std::int32_t> blocks;
  for (const Conflict& c : conflicts) blocks.push_back(c.edge0.block);
  const FoldedBlocks folded(std::move(blocks), kMostInBlock);
  std::vector<Candidate> candidates;
  for (std::size_t c = 0; c < conflicts.size(); ++c) {
    mesh.monitor().throwIfStopped();
    forEachCorner(conflicts[c], [&](std::uint32_t corner) {
      const std::ptrdiff_t i = mesh.movable(corner);
      if (i < 0) return;
      const VertexState& v = mesh.vertices()[static_cast<std::size_t>(i)];
      if (v.creaseMoves < kMostMoves && isSharp(v) && !folded.has(v.block))
        candidates.push_back({c, static_cast<std::size_t>(i)});
    });
  }
  return candidates;
}

}  // namespace

std::vector<VertexMove> findCreaseMoves(WorkingMesh& mesh, NearFaces& near, const std::vector<Conflict>& conflicts) {
  mesh.monitor().throwIfStopped();
  if (!mesh.faces().map().affine() || mesh.onCreases().empty()) return {};
  const std::vector<Candidate> candidates = findCandidates(mesh, conflicts);
  std::vector<std::size_t> vertices;
  for (const Candidate& c : candidates) vertices.push_back(c.vertex);
  sortUnique(vertices);
  const FaceBoxes& boxes = near.boxesAbout(mesh.vertices(), vertices);
  std::vector<Found> found(vertices.size());
  tbb::parallel_for(std::size_t{0}, found.size(), [&](std::size_t k) {
    mesh.monitor().throwIfStopped();
    found[k] = findPlace(boxes, mesh.faces(), mesh.vertices()[vertices[k]]);
  });

  // Only the best vertex of each conflict may move.
  const auto indexOf = [&](const Candidate& c) {
    return static_cast<std::size_t>(std::lower_bound(vertices.begin(), vertices.end(), c.vertex) - vertices.begin());
  };
  const auto rank = [&](std::size_t k) {
    return std::tuple(found[k].tried == 0, found[k].conflicts, found[k].tried, k);
  };
  std::vector<std::size_t> best(conflicts.size(), vertices.size());
  for (const Candidate& c : candidates) {
    const std::size_t k = indexOf(c);
    if (best[c.conflict] == vertices.size() || rank(k) < rank(best[c.conflict])) best[c.conflict] = k;
  }
  std::vector<std::uint8_t> beaten(vertices.size());
  for (const Candidate& c : candidates) beaten[indexOf(c)] |= best[c.conflict] != indexOf(c);
  std::vector<VertexMove> moves;
  for (std::size_t k = 0; k < vertices.size(); ++k) {
    if (found[k].tried == 0)
      mesh.vertices()[vertices[k]].unresolvedConflicts = found[k].conflicts;
    else if (beaten[k] == 0)
      moves.push_back({vertices[k], found[k].place});
  }
  return moves;
}

std::vector<VertexMove> findBetterPlaces(const WorkingMesh& mesh, NearFaces& near) {
  if (!mesh.faces().map().affine()) return {};
  std::vector<std::size_t> displaced;
  for (const std::size_t i : mesh.onCreases())
    if (mesh.vertices()[i].place != mesh.vertices()[i].wanted) displaced.push_back(i);
  std::vector<std::int32_t> blocks;
  for (const std::size_t i : displaced) blocks.push_back(mesh.vertices()[i].block);
  const FoldedBlocks folded(std::move(blocks), kMostInBlock);
  std::erase_if(displaced, [&](std::size_t i) {
    const VertexState& v = mesh.vertices()[i];
    return !isSharp(v) || folded.has(v.block);
  });
  const FaceBoxes& boxes = near.boxesAbout(mesh.vertices(), displaced);
  return gather<VertexMove>(displaced.size(), [&](std::size_t i, std::vector<VertexMove>& out) {
    mesh.monitor().throwIfStopped();
    const VertexState& vertex = mesh.vertices()[displaced[i]];
    const Vec3f place = findBetterPlace(boxes, mesh.faces(), vertex);
    if (place != vertex.place) out.push_back({displaced[i], place});
  });
}

}  // namespace pdc::detail
