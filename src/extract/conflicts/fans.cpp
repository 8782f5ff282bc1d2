#include "extract/conflicts/fans.h"

#include <algorithm>
#include <limits>

namespace pdc::detail {
namespace {

/// New vertices keep this far from lattice points, where fans of several edges would meet.
constexpr double kInner = 0.01;

}  // namespace

struct Fans::Crossings {
  Crossings(const HermiteSource& source, const Coord& coord, const BlockSigns& signs, std::int32_t index)
      : block(index), edges(signs) {
    source.fillHermite({coord, signs, edges}, hermite);
  }
  std::int32_t block;
  EdgeIndex edges;
  HermiteBlock hermite;
};

Fans::Fans(const HermiteSource& source, const SurfaceBlocks& blocks, const EdgeCells& edgeCells, Mesh& mesh)
    : mSource(source),
      mBlocks(blocks),
      mEdgeCells(edgeCells),
      mMesh(mesh),
      mFirstVertex(static_cast<std::uint32_t>(mesh.positions.size())),
      mIsFan((mesh.quads.size() + 63) / 64) {}

Fans::~Fans() = default;

Vec3d Fans::crossing(const CellRef& c, int edge) {
  if (mCrossings == nullptr || mCrossings->block != c.block)
    mCrossings = std::make_unique<Crossings>(mSource, mBlocks.coords[c.block], mBlocks.signs[c.block], c.block);
  const Axis axis = kCellEdge[edge].axis;
  const int corner = kCellEdge[edge].low;
  const int x = c.x + (corner & 1), y = c.y + (corner >> 1 & 1), z = c.z + (corner >> 2);
  const double t = mCrossings->hermite.t[mCrossings->edges(axis, x, y, z)];
  const Coord& b = mBlocks.coords[c.block];
  Vec3d p{kBlockSize * double(b[0]) + x, kBlockSize * double(b[1]) + y, kBlockSize * double(b[2]) + z};
  p[axis] += std::clamp(t, kInner, 1 - kInner);
  return p;
}

std::uint32_t Fans::numberAfter(std::uint64_t vertices) {
  checkVertexCount(vertices + 1);
  return static_cast<std::uint32_t>(vertices);
}

std::uint32_t Fans::append(const Vec3d& position, const EdgeRef& at) {
  const std::uint32_t vertex = numberAfter(mMesh.positions.size());
  mMesh.positions.push_back(mSource.map().rounded(mSource.map().position(position)));
  if (!mMesh.normals.empty()) {
    Vec3d sum{};
    for (const std::uint32_t v : mEdgeCells.vertices(at)) sum += vecCast<double>(mMesh.normals[v]);
    const double l = length(sum);
    mMesh.normals.push_back(vecCast<float>(l > 0 ? sum * (1 / l) : Vec3d{}));
  }
  return vertex;
}

void Fans::add(const EdgeRef& e) {
  const std::uint64_t face = mEdgeCells.face(e);
  if (has(face)) return;
  mIsFan[face / 64] |= std::uint64_t{1} << face % 64;
  mCenter.emplace(e, append(crossing(mEdgeCells.cells(e)[0], edgeInCell(e.axis(), 0)), e));
}

bool Fans::split(const CellRef& c, std::vector<EdgeRef>& changed) {
  if (!mSplit.insert(key(c)).second) return false;
  mEdgeCells.forEachEdge(c, [&](const EdgeRef& e, int) {
    add(e);
    changed.push_back(e);
    const std::array<CellRef, 4> cells = mEdgeCells.cells(e);
    for (int k = 0; k < 4; ++k) {
      if (!splitBetween(cells[k], cells[(k + 1) & 3])) continue;
      const CellSegment s = segment(e, cells[k], k);
      const Segment joined = segmentKey(cells[k], s);
      if (mFaceVertex.contains(joined)) continue;
      const Vec3d middle = (crossing(cells[k], s.edge0) + crossing(cells[k], s.edge1)) * 0.5;
      mFaceVertex.emplace(joined, append(middle, e));
    }
  });
  return true;
}

Fans::CellSegment Fans::segment(const EdgeRef& e, const CellRef& c, int k) const {
  const int u = (e.axis() + 1) % 3, v = (e.axis() + 2) % 3;
  const std::array<int, 4> faceOf{2 * u, 2 * v, 2 * u + 1, 2 * v + 1};
  const int own = edgeInCell(e.axis(), k), code = mEdgeCells.code(c);
  const CellEntry& entry = kCellTable[code];
  const MultiVertexCell* multiVertex = mEdgeCells.block(c.block).findMultiVertex(c.cell());
  const bool flipped = multiVertex != nullptr && entry.flipFace != kNone && multiVertex->patch == entry.flipped.vertex;
  const Segments all = segments(code, flipped);
  for (int i = 0; i < all.size; ++i) {
    const auto& s = all.at[i];
    if (s.face == faceOf[k] && (s.edge0 == own || s.edge1 == own)) return {s.edge0, s.edge1};
  }
  return {own, own};  // Not reached: every sign-changing edge of a face ends a segment there.
}

Fans::Segment Fans::segmentKey(const CellRef& c, const CellSegment& s) const {
  const Coord& b = mBlocks.coords[c.block];
  const auto lattice = [&](int edge) {
    const int corner = kCellEdge[edge].low;
    return LatticeEdge({kBlockSize * b[0] + c.x + (corner & 1), kBlockSize * b[1] + c.y + (corner >> 1 & 1),
                        kBlockSize * b[2] + c.z + (corner >> 2)},
                       kCellEdge[edge].axis);
  };
  return std::minmax({lattice(s.edge0), lattice(s.edge1)});
}

void Fans::triangles(const EdgeRef& e, std::vector<Triangle>& out) const {
  const Quad ring = mEdgeCells.vertices(e);
  const std::array<CellRef, 4> cells = mEdgeCells.cells(e);
  std::array<std::uint32_t, 8> rim;
  int n = 0;
  for (int k = 0; k < 4; ++k) {
    rim[n++] = ring[k];
    if (splitBetween(cells[k], cells[(k + 1) & 3]))
      rim[n++] = mFaceVertex.at(segmentKey(cells[k], segment(e, cells[k], k)));
  }
  const bool reversed = mEdgeCells.lowInside(e) == mSource.map().mirrored();
  const std::uint32_t center = mCenter.at(e);
  for (int i = 0; i < n; ++i) {
    const std::uint32_t a = rim[i], b = rim[i + 1 == n ? 0 : i + 1];
    out.push_back(reversed ? Triangle{center, b, a} : Triangle{center, a, b});
  }
}

std::size_t Fans::replaceQuads(const Monitor& monitor, std::vector<FanPart>* parts) {
  std::vector<std::uint64_t> faces;
  std::vector<Triangle> fan;
  for (const auto& [edge, center] : mCenter) {
    monitor.throwIfStopped();
    faces.push_back(mEdgeCells.face(edge));
    fan.clear();
    triangles(edge, fan);
    mMesh.triangles.insert(mMesh.triangles.end(), fan.begin(), fan.end());
    if (parts != nullptr) parts->push_back({edge.block, static_cast<std::uint32_t>(fan.size()), 0});
  }
  renumber();
  if (parts != nullptr) countVertices(*parts);
  removeQuads(faces);
  return countPartedEdges(monitor);
}

/// Numbers the new vertices as the fans, in the order of their edges, have them first.
void Fans::renumber() {
  constexpr auto kUnnumbered = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> number(mMesh.positions.size() - mFirstVertex, kUnnumbered);
  std::uint32_t next = mFirstVertex;
  for (Triangle& t : mMesh.triangles)
    for (std::uint32_t& v : t) {
      if (v < mFirstVertex) continue;
      std::uint32_t& n = number[v - mFirstVertex];
      if (n == kUnnumbered) n = next++;
      v = n;
    }
  const auto reorder = [&](Buffer<Vec3f>& values) {
    if (values.empty()) return;
    const std::vector<Vec3f> before(values.begin() + mFirstVertex, values.end());
    for (std::size_t i = 0; i < before.size(); ++i) values[number[i]] = before[i];
  };
  reorder(mMesh.positions);
  reorder(mMesh.normals);
  for (auto& [joined, vertex] : mFaceVertex) vertex = number[vertex - mFirstVertex];
}

void Fans::countVertices(std::vector<FanPart>& parts) const {
  std::size_t t = 0;
  std::uint32_t next = mFirstVertex;  // New vertices have their numbers in the order of the fans.
  for (FanPart& part : parts) {
    const std::uint32_t before = next;
    for (const std::size_t end = t + part.triangles; t < end; ++t)
      for (const std::uint32_t v : mMesh.triangles[t]) next = std::max(next, v + 1);
    part.vertices = next - before;
  }
}

/// \param faces sorted.
void Fans::removeQuads(const std::vector<std::uint64_t>& faces) {
  if (faces.empty()) return;
  auto end = mMesh.quads.begin() + static_cast<std::ptrdiff_t>(faces[0]);
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const std::uint64_t next = i + 1 < faces.size() ? faces[i + 1] : mMesh.quads.size();
    end = std::move(mMesh.quads.begin() + static_cast<std::ptrdiff_t>(faces[i] + 1),
                    mMesh.quads.begin() + static_cast<std::ptrdiff_t>(next), end);
  }
  mMesh.quads.resize(static_cast<std::size_t>(end - mMesh.quads.begin()));
}

/// A face vertex lies in two triangles of each fan at its place; where there is one fan, it parts a boundary edge.
std::size_t Fans::countPartedEdges(const Monitor& monitor) const {
  if (mFaceVertex.empty()) return 0;
  std::map<std::uint32_t, int> uses;
  for (const auto& [joined, vertex] : mFaceVertex) uses.emplace(vertex, 0);
  for (const Triangle& t : mMesh.triangles) {
    monitor.throwIfStopped();
    for (const std::uint32_t v : t)
      if (const auto it = uses.find(v); it != uses.end()) ++it->second;
  }
  return static_cast<std::size_t>(
      std::count_if(uses.begin(), uses.end(), [](const auto& use) { return use.second == 2; }));
}

}  // namespace pdc::detail
