#include "subdivide/limit_surface.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

#include "subdivide/limit_masks.h"
#include "subdivide/refine_vertices.h"
#include "subdivide/vertex_sums.h"

namespace pdc::detail {
namespace {

constexpr std::size_t kRegularTriangles = 6, kRegularQuads = 4;
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// A vertex with its ring, in the order of RingMask.
struct Ring {
  std::uint32_t vertex = 0;
  bool closed = true;
  std::vector<std::uint32_t> edge, face;
  std::vector<std::size_t> sharp;  ///< Which edges are.

  void look(const HalfEdges& mesh, std::uint32_t v, bool triangles) {
    vertex = v;
    closed = true;
    edge.clear();
    face.clear();
    sharp.clear();
    mesh.forEachSpoke(v, [&](std::uint32_t other, std::uint32_t e, std::uint32_t h) {
      if (mesh.sharp[e] != 0) sharp.push_back(edge.size());
      edge.push_back(other);
      if (h == kNoHalfEdge) {
        closed = false;
      } else if (!triangles) {
        face.push_back(mesh.target(mesh.next(h)));
      }
    });
  }
};

/// The part of a ring from one sharp edge to the next.
Ring sectorOf(const Ring& ring, std::size_t which) {
  Ring sector{ring.vertex, false, {}, {}, {}};
  const std::size_t n = ring.edge.size(), first = ring.sharp[which];
  std::size_t last = which + 1 < ring.sharp.size() ? ring.sharp[which + 1] : ring.sharp[0] + n;
  for (std::size_t i = first; i <= last; ++i) {
    sector.edge.push_back(ring.edge[i % n]);
    if (i < last && !ring.face.empty()) sector.face.push_back(ring.face[i % n]);
  }
  return sector;
}

/// Calls visit(vertex, weight) for all that a mask weighs.
template <typename Visit>
void forEachWeight(const RingMask& mask, const Ring& ring, Visit&& visit) {
  if (mask.centre != 0) visit(ring.vertex, mask.centre);
  for (std::size_t i = 0; i < mask.edge.size(); ++i) visit(ring.edge[i], mask.edge[i]);
  for (std::size_t i = 0; i < mask.face.size(); ++i) visit(ring.face[i], mask.face[i]);
}

/// Derivatives at a limit point. Of Gaussians they are those of the dual space, relative to the point's mean: with
/// P' = Σ wᵢ Pᵢ and m' = Σ wᵢ Pᵢ (μᵢ − μ) the derivative of the mean is Σ m', the second ones Σ (m'' − 2 P' μ') and
/// alike.
template <typename Value>
class Derivatives {
 public:
  Derivatives(const Buffer<Value>& vertices, const Ring& ring, const Value& limit)
      : mVertices(vertices), mRing(ring), mLimit(limit) {}

  struct Moment {
    SymMat3<double> precision;
    Vec3d moment;
  };

  [[nodiscard]] Moment moment(const RingMask& mask) const {
    Moment sum{SymMat3<double>::zero(), {0, 0, 0}};
    forEachWeight(mask, mRing, [&](std::uint32_t v, double weight) {
      if constexpr (std::is_same_v<Value, Gaussian>) {
        const SymMat3<double> weighted = mVertices[v].precision * weight;
        sum.precision += weighted;
        sum.moment += weighted * (mVertices[v].mean - mLimit.mean);
      } else {
        sum.moment += (mVertices[v] - mLimit) * weight;
      }
    });
    return sum;
  }
  [[nodiscard]] Vec3d solve(const Vec3d& moment) const {
    if constexpr (std::is_same_v<Value, Gaussian>)
      return solveLdlt(mLimit.precision, moment).value_or(Vec3d{0, 0, 0});
    else
      return moment;
  }

 private:
  const Buffer<Value>& mVertices;
  const Ring& mRing;
  const Value& mLimit;
};

Vec3d unit(const Vec3d& v) {
  const double size = length(v);
  return size > 0 ? v * (1 / size) : Vec3d{0, 0, 0};
}

template <typename Value>
Vec3d normalOf(const Derivatives<Value>& d, const TangentMasks& masks) {
  return unit(cross(d.solve(d.moment(masks.u).moment), d.solve(d.moment(masks.v).moment)));
}

/// At a boundary vertex of one triangle the surface is what lies beside the curve, so its plane is the one that the
/// curve bends in. \param masks of the sector.
template <typename Value>
Vec3d normalOfBend(const Derivatives<Value>& d, const TangentMasks& masks) {
  const auto along = d.moment(masks.u);
  const Vec3d u = d.solve(along.moment) * 0.5;
  const Vec3d uu = d.solve(d.moment(masks.v).moment - along.precision * u);
  return unit(cross(u, uu));
}

struct Curvature {
  double mean = kNone, gaussian = kNone;
};

template <typename Value>
Curvature curvatureOf(const Derivatives<Value>& d, const TangentMasks& tangents, const SecondMasks& second) {
  const auto mu = d.moment(tangents.u), mv = d.moment(tangents.v);
  const Vec3d u = d.solve(mu.moment), v = d.solve(mv.moment);
  const Vec3d uu = d.solve(d.moment(second.uu).moment - mu.precision * u * 2.0);
  const Vec3d uv = d.solve(d.moment(second.uv).moment - mu.precision * v - mv.precision * u);
  const Vec3d vv = d.solve(d.moment(second.vv).moment - mv.precision * v * 2.0);
  const Vec3d n = unit(cross(u, v));
  const double E = dot(u, u), F = dot(u, v), G = dot(v, v), L = dot(uu, n), M = dot(uv, n), N = dot(vv, n);
  const double area = E * G - F * F;
  if (!(area > 0)) return {};
  // The normal looks outwards, so that convex surfaces bend away from it.
  return {-(E * N - 2 * F * M + G * L) / (2 * area), (L * N - M * M) / area};
}

/// The masks of one scheme. Those of regular vertices, of which most meshes consist after some levels, are kept.
class SchemeMasks {
 public:
  SchemeMasks(SubdivisionScheme scheme, LoopWeights weights)
      : mTriangles(scheme == SubdivisionScheme::kLoop),
        mWeights(weights),
        mRegular(mTriangles ? kRegularTriangles : kRegularQuads),
        mLimit(makeLimit(mRegular)),
        mTangents(makeTangents(mRegular)),
        mSecond(mTriangles ? loopSecond() : catmullClarkSecond()) {}

  [[nodiscard]] bool triangles() const { return mTriangles; }
  [[nodiscard]] bool isRegular(const Ring& ring) const { return ring.sharp.empty() && ring.edge.size() == mRegular; }
  [[nodiscard]] const SecondMasks& second() const { return mSecond; }
  [[nodiscard]] const TangentMasks& regularTangents() const { return mTangents; }

  template <typename Value>
  [[nodiscard]] Value limit(const Buffer<Value>& vertices, const Ring& ring) const {
    if (ring.sharp.size() > 2) return vertices[ring.vertex];
    typename SumOf<Value>::Type sum(placeOf(vertices[ring.vertex]));
    const auto add = [&](std::uint32_t v, double weight) { sum.add(vertices[v], weight); };
    if (ring.sharp.size() == 2) {
      // A cubic B-spline's.
      add(ring.vertex, 2.0 / 3);
      for (const std::size_t i : ring.sharp) add(ring.edge[i], 1.0 / 6);
    } else if (isRegular(ring)) {
      forEachWeight(mLimit, ring, add);
    } else {
      forEachWeight(makeLimit(ring.edge.size()), ring, add);
    }
    return sum.result();
  }

  template <typename Value>
  [[nodiscard]] Vec3d normal(const Buffer<Value>& vertices, const Ring& ring, const Value& limit) const {
    if (isRegular(ring)) return normalOf(Derivatives<Value>(vertices, ring, limit), mTangents);
    if (ring.sharp.size() < 2)
      return normalOf(Derivatives<Value>(vertices, ring, limit), makeTangents(ring.edge.size()));
    // Between its sharp edges a vertex has a normal on each side.
    Vec3d sum{0, 0, 0};
    for (std::size_t i = 0; i < ring.sharp.size() - (ring.closed ? 0 : 1); ++i) {
      const Ring sector = sectorOf(ring, i);
      const std::size_t faces = sector.edge.size() - 1;
      const bool corner = ring.sharp.size() > 2;
      const Derivatives<Value> derivatives(vertices, sector, limit);
      sum += corner                     ? normalOf(derivatives, cornerTangents(faces, mTriangles))
             : mTriangles && faces == 1 ? normalOfBend(derivatives, sectorTangents(1, true))
                                        : normalOf(derivatives, sectorTangents(faces, mTriangles));
    }
    return unit(sum);
  }

 private:
  [[nodiscard]] RingMask makeLimit(std::size_t n) const {
    return mTriangles ? loopLimit(n, loopWeight(n, mWeights)) : catmullClarkLimit(n);
  }
  [[nodiscard]] TangentMasks makeTangents(std::size_t n) const {
    return mTriangles ? loopTangents(n) : catmullClarkTangents(n);
  }

  bool mTriangles;
  LoopWeights mWeights;
  std::size_t mRegular;
  RingMask mLimit;
  TangentMasks mTangents;
  SecondMasks mSecond;
};

/// Gives vertices without a curvature the mean of that of their neighbours. \returns how many there are.
std::size_t fillCurvatures(const HalfEdges& mesh, Buffer<float>& curvature) {
  std::vector<std::pair<std::uint32_t, float>> found;
  for (std::uint32_t v = 0; v < curvature.size(); ++v) {
    if (!std::isnan(curvature[v])) continue;
    double sum = 0;
    int count = 0;
    mesh.forEachSpoke(v, [&](std::uint32_t other, std::uint32_t, std::uint32_t) {
      if (std::isnan(curvature[other])) return;
      sum += curvature[other];
      ++count;
    });
    found.emplace_back(v, static_cast<float>(count > 0 ? sum / count : 0));
  }
  for (const auto& [v, value] : found) curvature[v] = value;
  return found.size();
}

}  // namespace

template <typename Value>
LimitSurface<Value> limitSurface(const HalfEdges& mesh, const Buffer<Value>& vertices, const SubdivideOptions& options,
                                 BlockProgress& progress) {
  constexpr std::size_t kGrain = 1024;
  const SchemeMasks masks(options.scheme, options.weights);
  LimitSurface<Value> result;
  result.vertices.resize(vertices.size());
  if (options.normals) result.normals.resize(vertices.size());
  if (options.curvature) {
    result.meanCurvature.resize(vertices.size());
    result.gaussianCurvature.resize(vertices.size());
  }
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, vertices.size(), kGrain), [&](const auto& range) {
    Ring ring;
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      ring.look(mesh, static_cast<std::uint32_t>(i), masks.triangles());
      const Value limit = result.vertices[i] = masks.limit(vertices, ring);
      if (options.normals) result.normals[i] = vecCast<float>(masks.normal(vertices, ring, limit));
      if (!options.curvature) continue;
      const Curvature curvature = masks.isRegular(ring) ? curvatureOf(Derivatives<Value>(vertices, ring, limit),
                                                                      masks.regularTangents(), masks.second())
                                                        : Curvature{};
      result.meanCurvature[i] = static_cast<float>(curvature.mean);
      result.gaussianCurvature[i] = static_cast<float>(curvature.gaussian);
    }
    progress.advance(range.size());
  });
  if (options.curvature) {
    result.estimatedCurvatures = fillCurvatures(mesh, result.meanCurvature);
    fillCurvatures(mesh, result.gaussianCurvature);
  }
  return result;
}

template LimitSurface<Vec3d> limitSurface(const HalfEdges&, const Buffer<Vec3d>&, const SubdivideOptions&,
                                          BlockProgress&);
template LimitSurface<Gaussian> limitSurface(const HalfEdges&, const Buffer<Gaussian>&, const SubdivideOptions&,
                                             BlockProgress&);

}  // namespace pdc::detail
