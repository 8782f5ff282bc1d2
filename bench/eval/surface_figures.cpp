#include "eval/surface_figures.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <random>

#include "eval/metrics.h"
#include "eval/nearest.h"
#include "pdc/mesh/distance.h"

namespace pdc::eval {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

/// A face's corners and twice its area vector.
struct Face {
  Vec3d a, b, c;
  [[nodiscard]] Vec3d areaVector() const { return cross(b - a, c - a); }
  [[nodiscard]] Vec3d center() const { return (a + b + c) * (1.0 / 3); }
};

std::vector<Face> facesOf(const Mesh& mesh) {
  std::vector<Face> faces;
  const auto add = [&](std::uint32_t i, std::uint32_t k, std::uint32_t l) {
    const auto at = [&](std::uint32_t v) { return vecCast<double>(mesh.positions[v]); };
    faces.push_back({at(i), at(k), at(l)});
  };
  for (const Triangle& t : mesh.triangles) add(t[0], t[1], t[2]);
  for (const Quad& q : mesh.quads) {
    add(q[0], q[1], q[2]);
    add(q[0], q[2], q[3]);
  }
  return faces;
}

struct WeighedAngle {
  double angle, area;
};

void measureAngles(std::vector<WeighedAngle> angles, SurfaceFigures& f) {
  if (angles.empty()) return;
  std::sort(angles.begin(), angles.end(), [](const auto& a, const auto& b) { return a.angle < b.angle; });
  double area = 0, squares = 0, below = 0;
  for (const auto& a : angles) {
    area += a.area;
    squares += a.area * a.angle * a.angle;
  }
  f.normalRms = std::sqrt(squares / area);
  f.normalMax = angles.back().angle;
  for (const auto& a : angles) {
    f.normalP99 = a.angle;
    if ((below += a.area) >= 0.99 * area) break;
  }
}

/// Mean square of the distances of points of the faces, by area: a rule for triangles that is exact for squares.
double facesToSurface(const std::vector<Face>& faces, const PosedKind& posed) {
  double area = 0, sum = 0;
  for (const Face& t : faces) {
    const double own = length(t.areaVector());
    if (!(own > 0)) continue;
    for (const Vec3d& p :
         {(t.a * 4 + t.b + t.c) * (1.0 / 6), (t.a + t.b * 4 + t.c) * (1.0 / 6), (t.a + t.b + t.c * 4) * (1.0 / 6)}) {
      const double d = posed.distance(p);
      sum += own * d * d / 3;
    }
    area += own;
  }
  return area > 0 ? sum / area : 0;
}

}  // namespace

PosedKind::PosedKind(const Kind& kind, const Pose& pose, unsigned seed) : mKind(kind), mPose(pose) {
  for (const Segment& s : kind.shape.creases)
    mCreases.add({pose.toWorld(s[0]), pose.toWorld(s[1]), pose.toWorld(s[1])});
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> jitter(0, 1);
  const int reach = static_cast<int>(std::ceil(kind.reach)) + 3;
  for (int x = -reach; x < reach; ++x)
    for (int y = -reach; y < reach; ++y)
      for (int z = -reach; z < reach; ++z) {
        const Vec3d p{x + jitter(random), y + jitter(random), z + jitter(random)};
        const double d = distance(p);
        if (std::abs(d) > 0.5) continue;
        Vec3d q = p - normal(p) * d;
        q -= normal(q) * distance(q);
        if (std::abs(distance(q)) < 1e-3) mPoints.push_back(vecCast<float>(q));
      }
}

Vec3d PosedKind::normal(const Vec3d& p) const {
  Vec3d g;
  if (mKind.gradient) {
    g = mPose.rotation * mKind.gradient(mPose.toShape(p));
  } else {
    constexpr double kH = 1e-5;
    for (int i = 0; i < 3; ++i) {
      Vec3d low = p, high = p;
      low[i] -= kH;
      high[i] += kH;
      g[i] = distance(high) - distance(low);
    }
  }
  return g * (1 / std::max(length(g), 1e-30));
}

SurfaceFigures PosedKind::measure(const Mesh& mesh) const {
  SurfaceFigures f;
  const std::vector<Face> faces = facesOf(mesh);
  if (faces.empty()) return f;
  f.triangles = faces.size();
  const Shape& shape = mKind.shape;
  for (const double e : vertexErrors(mesh, shape, mPose)) f.vertexRms += e * e;
  f.vertexRms = std::sqrt(f.vertexRms / static_cast<double>(mesh.positions.size()));

  double toMesh = 0;
  for (const double d : distances(mPoints, mesh)) toMesh += d * d;
  const double toSurface = facesToSurface(faces, *this);
  f.surfaceRms = std::sqrt((toSurface + toMesh / static_cast<double>(std::max<std::size_t>(mPoints.size(), 1))) / 2);

  std::vector<WeighedAngle> angles;
  for (const Face& t : faces) {
    const Vec3d n = t.areaVector();
    const double area = length(n);
    if (!(area > 0) || !awayFromCreases(t.center())) continue;
    const Vec3d truth = normal(t.center());
    const double angle = std::atan2(length(cross(n, truth)), dot(n, truth)) / kDegree;
    angles.push_back({angle, area});
    f.turned += angle > SurfaceFigures::kTurned ? 1 : 0;
  }
  measureAngles(std::move(angles), f);
  if (!shape.edges.empty()) {
    const Figures edges = measureEdges(mesh, shape, mPose);
    f.edgeRms = edges.edgeRms;
    f.cornerMax = edges.cornerMax;
  }
  return f;
}

double trueNormalNoise(const HermiteSource& source, const PosedKind& posed) {
  const SurfaceBlocks blocks = source.surfaceBlocks({});
  const auto hermite = std::make_unique<HermiteBlock>();
  double squares = 0, count = 0;
  for (std::size_t b = 0; b < blocks.coords.size(); ++b) {
    const EdgeIndex edges(blocks.signs[b]);
    source.fillHermite({blocks.coords[b], blocks.signs[b], edges}, *hermite);
    edges.forEach([&](int i, int axis, int x, int y, int z) {
      const Coord& c = blocks.coords[b];
      Vec3d p{double(kBlockSize) * c[0] + x, double(kBlockSize) * c[1] + y, double(kBlockSize) * c[2] + z};
      p[axis] += double{hermite->t[i]};
      p = source.map().position(p);
      const Vec3d n{hermite->nx[i], hermite->ny[i], hermite->nz[i]};
      if (n == Vec3d{} || !posed.awayFromCreases(p)) return;
      const double s = length(cross(n, posed.normal(p)));
      squares += s * s / 2;
      count += 1;
    });
  }
  return count > 0 ? std::sqrt(squares / count) : 0;
}

SurfaceFigures pool(const std::vector<SurfaceFigures>& all) {
  SurfaceFigures f;
  const double n = static_cast<double>(all.size());
  const auto rootOfMean = [&](double SurfaceFigures::*figure) {
    for (const SurfaceFigures& one : all) f.*figure += one.*figure * (one.*figure) / n;
    f.*figure = std::sqrt(f.*figure);
  };
  for (const auto figure :
       {&SurfaceFigures::vertexRms, &SurfaceFigures::surfaceRms, &SurfaceFigures::normalRms, &SurfaceFigures::edgeRms})
    rootOfMean(figure);
  for (const SurfaceFigures& one : all) {
    f.normalP99 += one.normalP99 / n;
    f.cornerMax += one.cornerMax / n;
    f.normalMax = std::max(f.normalMax, one.normalMax);
    f.triangles += one.triangles;
    f.turned += one.turned;
  }
  return f;
}

}  // namespace pdc::eval
