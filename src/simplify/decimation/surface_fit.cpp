#include "simplify/decimation/surface_fit.h"

#include <algorithm>
#include <limits>

#include "mesh/point_triangle.h"
#include "parallel/for_each_in_parallel.h"
#include "pdc/math/solvers.h"
#include "simplify/decimation/intersecting_faces.h"
#include "simplify/vertex_stars.h"

namespace pdc::detail {
namespace {

/// Steps towards the least squares, all vertices at once, and how far each goes. What couples neighbours is a mass
/// matrix of triangles: over its diagonal its eigenvalues are between 1/2 and 2, for which 0.8 is best.
constexpr int kSteps = 3;
constexpr double kStep = 0.8;

/// How much vertices stay where nothing draws them, relative to what does.
constexpr double kInertia = 1e-2;
/// How much more, where normals have noise: the more, the fewer faces there were for each vertex left. It counts as so
/// many faces given as this times the variance of the normals.
constexpr double kNoiseInertia = 8;

/// More points for each vertex tell nothing more.
constexpr std::size_t kMostPerVertex = 32;

/// The cosine from which on a face may stand for a point of the surface given, by their normals: beside a crease the
/// nearest face may be that of the other side.
constexpr double kAlike = 0.5;

constexpr auto kNone = static_cast<std::uint32_t>(-1);

/// A point of the surface given, at a face near to it.
struct Sample {
  Vec3d place;
  Vec3d normal;             ///< As long as the area that the point stands for.
  std::uint32_t vertex;     ///< The one left that a vertex given beside it became.
  std::uint32_t face;       ///< Of those about that vertex, or kNone.
  TriangleWeights weights;  ///< The face's point nearest to the place.
};

class SurfaceFit {
 public:
  SurfaceFit(DecimatedSurface& surface, const GivenSurface& given, const FitRule& rule)
      : mSurface(surface), mGiven(given), mRule(rule) {
    mStars.build(surface.faces, surface.positions.size());
    mNormals.resize(surface.faces.size());
    forEachInParallel(surface.faces.size(), 256, [&](std::uint32_t f) {
      mNormals[f] = cross(corner(f, 1) - corner(f, 0), corner(f, 2) - corner(f, 0));
    });
    findSamples();
    listSamples();
  }

  /// \throws Cancelled.
  void step(const Monitor& monitor) {
    monitor.throwIfStopped();
    if (mRule.sound) mPairs = intersectingFaces(mSurface, mSurface.positions, mSurface.faces, monitor);
    mMoved.assign(mSurface.positions.begin(), mSurface.positions.end());
    forEachInParallel(mMoved.size(), 256, [&](std::uint32_t v) {
      const std::span<const StarCorner> star = mStars[v];
      if (!star.empty() && mSurface.locked[v] == 0 && !atBoundary(star)) mMoved[v] += moveOf(v) * kStep;
    });
    if (mRule.sound)
      for (std::uint32_t v = 0; v < mMoved.size(); ++v) mMoved[v] = mSurface.rounded(v, mMoved[v]);
    do takeBackTurned();
    while (mRule.sound && takeBackIntersecting(monitor));
    std::copy(mMoved.begin(), mMoved.end(), mSurface.positions.begin());
  }

 private:
  void findSamples() {
    const std::size_t vertices = mGiven.positions.size(), all = vertices + mGiven.faces.size();
    Buffer<Vec3d> vectorAreas(vertices, Vec3d{});
    double area = 0;
    for (const auto& [a, b, c] : mGiven.faces) {
      const Vec3d& p = mGiven.positions[a];
      const Vec3d n = cross(mGiven.positions[b] - p, mGiven.positions[c] - p);
      area += length(n);
      for (const std::uint32_t v : {a, b, c}) vectorAreas[v] += n;
    }
    if (!mGiven.faces.empty()) mMeanArea = area / static_cast<double>(mGiven.faces.size());
    const std::size_t step = 1 + all / (kMostPerVertex * (mSurface.faces.size() / 2 + 1));
    mSamples.resize((all + step - 1) / step);
    forEachInParallel(mSamples.size(), 256, [&](std::uint32_t i) {
      const std::size_t k = i * step;
      mSamples[i] = k < vertices ? vertexSample(k, vectorAreas[k]) : centroidSample(k - vertices);
      if (!findFaceBySector(mSamples[i])) findFace(mSamples[i]);
    });
  }

  // The mean of a square over a triangle is a twelfth of those at its corners and three quarters of that at its
  // centroid.

  [[nodiscard]] Sample vertexSample(std::size_t v, const Vec3d& vectorArea) const {
    return {mGiven.positions[v], vectorArea * (1.0 / 12), rootOf(static_cast<std::uint32_t>(v)), kNone, {}};
  }
  [[nodiscard]] Sample centroidSample(std::size_t f) const {
    const auto [a, b, c] = mGiven.faces[f];
    const Vec3d &p = mGiven.positions[a], &q = mGiven.positions[b], &r = mGiven.positions[c];
    return {(p + q + r) * (1.0 / 3), cross(q - p, r - p) * (3.0 / 4), rootOf(a), kNone, {}};
  }

  [[nodiscard]] std::uint32_t rootOf(std::uint32_t v) const {
    while (mRule.became[v] != v) v = mRule.became[v];
    return v;
  }

  /// Tries the face in whose sector about the vertex the sample lies, seen along the sample's normal. \returns whether
  /// the sample is over it, so near that no other is likely to be nearer.
  bool findFaceBySector(Sample& s) const {
    constexpr double kNear = 0.1;  // Of the distance from the vertex.
    const Vec3d& origin = mSurface.positions[s.vertex];
    const Vec3d q = s.place - origin, turned = cross(q, s.normal);  // dot(u, turned) is dot(cross(u, q), normal).
    for (const StarCorner& c : mStars[s.vertex]) {
      if (dot(mSurface.positions[c.next] - origin, turned) < 0) continue;
      if (dot(mSurface.positions[c.previous] - origin, turned) > 0) continue;
      if (!isAlike(s, c.face)) return false;
      attach(s, c.face);
      const Vec3d gap = placeOf(c.face, s.weights) - s.place;
      return *std::min_element(s.weights.begin(), s.weights.end()) > 0 && dot(gap, gap) < kNear * kNear * dot(q, q);
    }
    return false;
  }

  /// Finds the face nearest to the sample, of those about its vertex that look its way.
  void findFace(Sample& s) const {
    double nearest = std::numeric_limits<double>::infinity();
    Sample best = s;
    best.face = kNone;
    for (const StarCorner& c : mStars[s.vertex]) {
      if (!isAlike(s, c.face)) continue;
      attach(s, c.face);
      const Vec3d gap = placeOf(c.face, s.weights) - s.place;
      if (!(dot(gap, gap) < nearest)) continue;
      best = s;
      nearest = dot(gap, gap);
    }
    s = best;
  }

  [[nodiscard]] bool isAlike(const Sample& s, std::uint32_t face) const {
    const Vec3d& n = mNormals[face];
    const double along = dot(n, s.normal);
    return along > 0 && along * along > kAlike * kAlike * dot(n, n) * dot(s.normal, s.normal);
  }

  void attach(Sample& s, std::uint32_t face) const {
    s.face = face;
    s.weights = nearestPoint(s.place, corner(face, 0), corner(face, 1), corner(face, 2));
  }

  /// Lists the samples by face, so that each vertex finds those of its faces.
  void listSamples() {
    mFirst.assign(mSurface.faces.size() + 1, 0);
    for (const Sample& s : mSamples)
      if (s.face != kNone) ++mFirst[s.face + 1];
    for (std::size_t f = 0; f < mSurface.faces.size(); ++f) mFirst[f + 1] += mFirst[f];
    mList.resize(mFirst.back());
    Buffer<std::uint32_t> fill(mFirst.begin(), mFirst.end());
    for (std::uint32_t i = 0; i < mSamples.size(); ++i)
      if (mSamples[i].face != kNone) mList[fill[mSamples[i].face]++] = i;
  }

  [[nodiscard]] const Vec3d& corner(std::uint32_t face, int k) const {
    return mSurface.positions[mSurface.faces[face][k]];
  }
  [[nodiscard]] Vec3d placeOf(std::uint32_t face, const TriangleWeights& w) const {
    return corner(face, 0) * w[0] + corner(face, 1) * w[1] + corner(face, 2) * w[2];
  }

  /// What takes the vertex to its least squares, the others staying.
  [[nodiscard]] Vec3d moveOf(std::uint32_t v) const {
    SymMat3<double> A = SymMat3<double>::zero();
    Vec3d b{};
    Vec3d normal{};
    double weight = 0;
    for (const StarCorner& c : mStars[v]) {
      normal += mNormals[c.face];
      const Triangle& t = mSurface.faces[c.face];
      const int k = t[0] == v ? 0 : t[1] == v ? 1 : 2;
      for (std::uint32_t i = mFirst[c.face]; i < mFirst[c.face + 1]; ++i) {
        const Sample& s = mSamples[mList[i]];
        const double size = length(s.normal), w = s.weights[k];
        if (!(size > 0) || w == 0) continue;
        const double off = dot(s.normal, s.place - placeOf(c.face, s.weights));
        A += outer(s.normal) * (w * w / size);
        b += s.normal * (w * off / size);
        weight += w * w * size;
      }
    }
    const bool ofVertex = mSurface.noise.known() && mRule.sigmaNormalOfVertices;
    const double sigmaNormal = ofVertex ? mSurface.noise.choice(v, normal).sigmaNormal : mRule.sigmaNormal;
    const double still = kNoiseInertia * sigmaNormal * sigmaNormal * mMeanArea;
    const auto move = solveLdlt(A.plusDiagonal(kInertia * weight + still), b);
    return move ? *move : Vec3d{};
  }

  /// Takes back the moves about faces that turn too far, until there are none.
  void takeBackTurned() {
    for (bool any = true; any;) {
      any = false;
      for (const Triangle& t : mSurface.faces)
        if (turnsTooFar(t)) any = takeBack(t) || any;
    }
  }

  /// Takes back the moves about faces that intersect and did not before. \returns whether there were any.
  bool takeBackIntersecting(const Monitor& monitor) {
    bool any = false;
    for (const auto& pair : intersectingFaces(mSurface, mMoved, mSurface.faces, monitor)) {
      if (std::binary_search(mPairs.begin(), mPairs.end(), pair)) continue;
      for (const std::uint32_t f : pair) any = takeBack(mSurface.faces[f]) || any;
    }
    return any;
  }

  /// \returns whether a corner of the face had moved.
  bool takeBack(const Triangle& t) {
    bool any = false;
    for (const std::uint32_t v : t) {
      any = any || mMoved[v] != mSurface.positions[v];
      mMoved[v] = mSurface.positions[v];
    }
    return any;
  }

  [[nodiscard]] bool turnsTooFar(const Triangle& t) const {
    const std::vector<Vec3d>& p = mSurface.positions;
    const Vec3d before = cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]);
    const Vec3d after = cross(mMoved[t[1]] - mMoved[t[0]], mMoved[t[2]] - mMoved[t[0]]);
    const double along = dot(before, after), least = mRule.leastCosine * mRule.leastCosine;
    return !(along > 0 && along * along > least * dot(before, before) * dot(after, after));
  }

  DecimatedSurface& mSurface;
  const GivenSurface& mGiven;
  const FitRule mRule;
  double mMeanArea = 0;  ///< Of the faces given, twice.
  VertexStars mStars;
  Buffer<Vec3d> mNormals;  ///< By face.
  Buffer<Sample> mSamples;
  Buffer<std::uint32_t> mFirst, mList;  ///< By face, where its samples begin in the list of all.
  Buffer<Vec3d> mMoved;
  FacePairs mPairs;  ///< That intersect before a step, sorted.
};

}  // namespace

void fitSurface(DecimatedSurface& surface, const GivenSurface& given, const FitRule& rule, const Monitor& monitor) {
  SurfaceFit fit(surface, given, rule);
  for (int i = 0; i < kSteps; ++i) fit.step(monitor);
}

}  // namespace pdc::detail
