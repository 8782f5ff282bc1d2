#include "extract/fans.h"

#include <algorithm>

namespace pdc::detail {
namespace {

/// New vertices keep this far from lattice points, where fans of several edges would meet.
constexpr double kInner = 0.01;

}  // namespace

struct Fans::Crossings {
  Crossings(const HermiteSource& source, const Coord& coord, const BlockSigns& signs, std::int32_t index)
      : block(index), edges(signs) {
    source.fillHermite(coord, signs, edges, hermite);
  }
  std::int32_t block;
  EdgeIndex edges;
  HermiteBlock hermite;
};

Fans::Fans(const HermiteSource& source, const SurfaceBlocks& blocks, const QuadRings& rings, Mesh& mesh)
    : mSource(source), mBlocks(blocks), mRings(rings), mMesh(mesh) {}

Fans::~Fans() = default;

Vec3d Fans::crossing(const EdgeRef& e) {
  if (mCrossings == nullptr || mCrossings->block != e.block)
    mCrossings = std::make_unique<Crossings>(mSource, mBlocks.coords[e.block], mBlocks.signs[e.block], e.block);
  const double t = mCrossings->hermite.t[mCrossings->edges(e.axis(), e.x(), e.y(), e.z())];
  const Coord low = mRings.low(e);
  Vec3d p{double(low[0]), double(low[1]), double(low[2])};
  p[e.axis()] += std::clamp(t, kInner, 1 - kInner);
  return p;
}

std::uint32_t Fans::append(const Vec3d& position, const EdgeRef& at) {
  const auto vertex = static_cast<std::uint32_t>(mMesh.positions.size());
  mMesh.positions.push_back(vecCast<float>(mSource.map().position(position)));
  if (!mMesh.normals.empty()) {
    Vec3d sum{};
    for (const std::uint32_t v : mRings.vertices(at)) sum += vecCast<double>(mMesh.normals[v]);
    const double l = length(sum);
    mMesh.normals.push_back(vecCast<float>(l > 0 ? sum * (1 / l) : Vec3d{}));
  }
  return vertex;
}

void Fans::add(const EdgeRef& e) {
  if (!has(e)) mCenter.emplace(e, append(crossing(e), e));
}

bool Fans::split(const CellRef& c, std::vector<EdgeRef>& changed) {
  if (!mSplit.insert(key(c)).second) return false;
  mRings.forEachEdge(c, [&](const EdgeRef& e, int) {
    add(e);
    changed.push_back(e);
    const std::array<CellRef, 4> cells = mRings.cells(e);
    for (int k = 0; k < 4; ++k) {
      if (!mSplit.contains(key(cells[k])) && !mSplit.contains(key(cells[(k + 1) & 3]))) continue;
      const Segment s = segment(e, cells[k], k);
      if (mFaceVertex.contains(s)) continue;
      mFaceVertex.emplace(s, append((crossing(s.first) + crossing(s.second)) * 0.5, e));
    }
  });
  return true;
}

Fans::Segment Fans::segment(const EdgeRef& e, const CellRef& c, int k) const {
  const int u = (e.axis() + 1) % 3, v = (e.axis() + 2) % 3;
  const std::array<int, 4> faceOf{2 * u, 2 * v, 2 * u + 1, 2 * v + 1};
  const int own = ringEdge(e.axis(), k), code = mRings.code(c);
  const CellEntry& entry = kCellTable[code];
  const SpecialCell* special = mRings.block(c.block).findSpecial(key(c).second);
  const bool flipped = special != nullptr && entry.flipFace != kNone && special->patch == entry.flipped.vertex;
  const Segments all = segments(code, flipped);
  EdgeRef other = e;
  for (int i = 0; i < all.size; ++i) {
    const auto& s = all.at[i];
    if (s.face != faceOf[k] || (s.edge0 != own && s.edge1 != own)) continue;
    mRings.forEachEdge(c, [&](const EdgeRef& ref, int edge) {
      if (edge == (s.edge0 == own ? s.edge1 : s.edge0)) other = ref;
    });
  }
  return std::minmax(e, other);
}

void Fans::triangles(const EdgeRef& e, std::vector<Triangle>& out) const {
  const Quad ring = mRings.vertices(e);
  const std::array<CellRef, 4> cells = mRings.cells(e);
  std::array<std::uint32_t, 8> rim;
  int n = 0;
  for (int k = 0; k < 4; ++k) {
    rim[n++] = ring[k];
    if (mSplit.contains(key(cells[k])) || mSplit.contains(key(cells[(k + 1) & 3])))
      rim[n++] = mFaceVertex.at(segment(e, cells[k], k));
  }
  const bool reversed = mRings.lowInside(e) == mSource.map().mirrored();
  const std::uint32_t center = mCenter.at(e);
  for (int i = 0; i < n; ++i) {
    const std::uint32_t a = rim[i], b = rim[i + 1 == n ? 0 : i + 1];
    out.push_back(reversed ? Triangle{center, b, a} : Triangle{center, a, b});
  }
}

void Fans::replaceQuads() {
  if (mCenter.empty()) return;
  std::vector<std::uint64_t> faces;
  std::vector<Triangle> fan;
  for (const auto& [edge, center] : mCenter) {
    faces.push_back(mRings.face(edge));
    triangles(edge, fan);
  }
  std::sort(faces.begin(), faces.end());
  mMesh.triangles.insert(mMesh.triangles.end(), fan.begin(), fan.end());
  std::size_t kept = faces[0], next = 0;
  for (std::size_t i = faces[0]; i < mMesh.quads.size(); ++i) {
    if (next < faces.size() && faces[next] == i) {
      ++next;
    } else {
      mMesh.quads[kept++] = mMesh.quads[i];
    }
  }
  mMesh.quads.resize(kept);
}

}  // namespace pdc::detail
