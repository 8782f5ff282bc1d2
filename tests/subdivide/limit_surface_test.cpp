#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <vector>

#include "pdc/mesh/mesh_report.h"
#include "pdc/subdivide/subdivide.h"
#include "simplify/shapes.h"
#include "subdivide/control_meshes.h"
#include "subdivide/limit_masks.h"
#include "subdivide/refine_vertices.h"

namespace pdc {
namespace {

using namespace test;

constexpr auto kCatmullClark = SubdivisionScheme::kCatmullClark;

Mesh withCovariances(Mesh mesh, double least, unsigned seed) {
  setVertexCovariances(mesh, randomCovariances(mesh.positions.size(), least, seed));
  return mesh;
}

SubdivideOptions optionsFor(SubdivisionScheme scheme, bool gaussians, int levels, bool limit) {
  SubdivideOptions options{.levels = levels, .scheme = scheme, .limit = limit, .keepPlaces = true};
  options.covariances->source = CovarianceSource::kProperties;
  if (!gaussians) options.covariances.reset();
  return options;
}

struct Sample {
  Mesh mesh;
  SubdivideReport report;
};

Sample sample(const Mesh& mesh, SubdivideOptions options) {
  Sample result;
  options.normals = options.curvature = options.limit;
  result.mesh = subdivide(mesh, options, &result.report);
  return result;
}

/// Meshes of at most 100 faces and six edges at a vertex.
std::vector<Mesh> controlMeshes(SubdivisionScheme scheme) {
  if (scheme == kCatmullClark) return {quadCube(), fan(5, true), fan(3, true), singleFace(4), mixedFaces()};
  return {octahedron(), fan(5, false), fan(3, false), singleFace(3), sphere(2)};
}

double meanEdge(const Mesh& mesh) {
  double sum = 0, count = 0;
  for (std::size_t f = 0; f < detail::faceCount(mesh); ++f) {
    const auto named = detail::face(mesh, f);
    for (std::size_t k = 0; k < named.size(); ++k, ++count)
      sum += length(mesh.positions[named[k]] - mesh.positions[named[(k + 1) % named.size()]]);
  }
  return sum / count;
}

std::size_t facesAt(const Mesh& mesh, std::uint32_t vertex) {
  std::size_t count = 0;
  for (std::size_t f = 0; f < detail::faceCount(mesh); ++f) {
    const auto named = detail::face(mesh, f);
    count += std::count(named.begin(), named.end(), vertex) > 0;
  }
  return count;
}

/// Whether as many faces as edges meet at a vertex, six triangles or four quads.
bool isRegularInside(const Mesh& mesh, std::size_t vertex) {
  std::set<std::uint32_t> neighbours;
  std::size_t faces = 0;
  for (std::size_t f = 0; f < detail::faceCount(mesh); ++f) {
    const auto named = detail::face(mesh, f);
    for (std::size_t k = 0; k < named.size(); ++k) {
      if (named[k] != vertex) continue;
      ++faces;
      neighbours.insert(named[(k + 1) % named.size()]);
      neighbours.insert(named[(k + named.size() - 1) % named.size()]);
    }
  }
  return faces == neighbours.size() && faces == (mesh.quads.empty() ? 6U : 4U);
}

/// Vertices keep their numbers, so where those of level 1 end up is known at level 8.
TEST(LimitSurface, IsWhereSubdivisionGoes) {
  for (const auto scheme : {SubdivisionScheme::kLoop, kCatmullClark})
    for (const bool gaussians : {false, true})
      for (const Mesh& control : controlMeshes(scheme)) {
        const Mesh mesh = withCovariances(control, 0.05, 3);
        const Sample limit = sample(mesh, optionsFor(scheme, gaussians, 1, true));
        const Sample deep = sample(mesh, optionsFor(scheme, gaussians, 8, false));
        double farthest = 0;
        for (std::size_t v = 0; v < limit.report.places.size(); ++v)
          farthest = std::max(farthest, length(limit.report.places[v] - deep.report.places[v]));
        // About the six triangles of the roof the scheme itself halts at 0.375 a level, elsewhere at 0.25 or less.
        const bool slow = scheme == kCatmullClark && !control.polygons.empty();
        EXPECT_LT(farthest, (slow ? 2e-4 : 1e-4) * meanEdge(control));
      }
}

/// Each level of the limit lies on the same surface.
TEST(LimitSurface, DoesNotDependOnTheLevel) {
  for (const auto scheme : {SubdivisionScheme::kLoop, kCatmullClark})
    for (const Mesh& control : controlMeshes(scheme)) {
      const Mesh mesh = withCovariances(control, 0.05, 3);
      const Sample coarse = sample(mesh, optionsFor(scheme, true, 1, true));
      const Sample fine = sample(mesh, optionsFor(scheme, true, 4, true));
      for (std::size_t v = 0; v < coarse.report.places.size(); ++v) {
        EXPECT_LT(length(coarse.report.places[v] - fine.report.places[v]), 1e-12);
        EXPECT_LT(length(coarse.mesh.normals[v] - fine.mesh.normals[v]), 1e-5F);
        // Where it is no mean of the neighbours'.
        if (!isRegularInside(coarse.mesh, v)) continue;
        for (const char* name : {"mean_curvature", "gaussian_curvature"}) {
          const float expected = fine.mesh.values<float>(name)[v];
          EXPECT_NEAR(coarse.mesh.values<float>(name)[v], expected, 1e-4 * (1 + std::abs(expected)));
        }
      }
    }
}

/// The unit vector that the faces around a vertex of level n agree on.
Vec3d ringNormal(const Mesh& mesh, const Buffer<Vec3d>& places, std::uint32_t vertex) {
  Vec3d sum{0, 0, 0};
  for (std::size_t f = 0; f < detail::faceCount(mesh); ++f) {
    const auto named = detail::face(mesh, f);
    const auto it = std::find(named.begin(), named.end(), vertex);
    if (it == named.end()) continue;
    const auto k = static_cast<std::size_t>(it - named.begin()), n = named.size();
    sum += cross(places[named[(k + 1) % n]] - places[vertex], places[named[(k + n - 1) % n]] - places[vertex]);
  }
  return sum * (1 / length(sum));
}

TEST(LimitSurface, NormalsAreThoseOfDeepMeshes) {
  for (const auto scheme : {SubdivisionScheme::kLoop, kCatmullClark})
    for (const bool gaussians : {false, true})
      for (const Mesh& control : controlMeshes(scheme)) {
        const Mesh mesh = withCovariances(control, 0.2, 5);
        const Sample limit = sample(mesh, optionsFor(scheme, gaussians, 1, true));
        const Sample deep = sample(mesh, optionsFor(scheme, gaussians, 6, true));
        const auto vertices = static_cast<std::uint32_t>(control.positions.size());
        for (std::uint32_t v = 0; v < vertices; ++v) {
          const Vec3d expected = ringNormal(deep.mesh, deep.report.places, v);
          // Quads alone at a boundary vertex come to theirs as slowly as 1 / levels.
          const bool slow = scheme == kCatmullClark && facesAt(control, v) == 1;
          EXPECT_LT(length(vecCast<double>(limit.mesh.normals[v]) - expected), slow ? 0.6 : 0.06) << "vertex " << v;
        }
      }
}

/// Across a fold of two planes the normal is halfway, and curvature is none.
TEST(LimitSurface, CreasesHaveTheMeanOfBothNormals) {
  Mesh mesh;
  mesh.positions = {{-1, 0, 1}, {-1, 1, 1}, {0, 0, 0}, {0, 1, 0}, {1, 0, 1}, {1, 1, 1}};
  mesh.quads = {{0, 2, 3, 1}, {2, 4, 5, 3}};
  SubdivideOptions options = optionsFor(kCatmullClark, false, 2, true);
  options.creaseAngle = 45;
  const Sample fold = sample(mesh, options);
  EXPECT_EQ(fold.report.creaseEdges, 1u);
  int onCrease = 0;
  for (std::size_t v = 0; v < fold.mesh.positions.size(); ++v) {
    if (std::abs(fold.mesh.positions[v].x) > 1e-6F) continue;
    ++onCrease;
    EXPECT_LT(length(fold.mesh.normals[v] - Vec3f{0, 0, 1}), 1e-5F);
  }
  EXPECT_EQ(onCrease, 5);
}

/// A regular grid whose control points lie on a parabola: its limit is one, whose curvature is known.
TEST(LimitSurface, ParabolasHaveTheirCurvature) {
  constexpr int kSide = 9;
  constexpr double kBend = 0.25;  // z = kBend x²
  for (const bool quads : {false, true}) {
    Mesh mesh;
    const auto at = [](int x, int y) { return static_cast<std::uint32_t>(y * kSide + x); };
    for (int y = 0; y < kSide; ++y)
      for (int x = 0; x < kSide; ++x) {
        const double s = x - kSide / 2;
        mesh.positions.push_back({static_cast<float>(s), static_cast<float>(y), static_cast<float>(kBend * s * s)});
      }
    for (int y = 0; y + 1 < kSide; ++y)
      for (int x = 0; x + 1 < kSide; ++x) {
        if (quads) {
          mesh.quads.push_back({at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y + 1)});
        } else {
          mesh.triangles.push_back({at(x, y), at(x + 1, y), at(x + 1, y + 1)});
          mesh.triangles.push_back({at(x, y), at(x + 1, y + 1), at(x, y + 1)});
        }
      }
    const Sample limit = sample(mesh, optionsFor(quads ? kCatmullClark : SubdivisionScheme::kLoop, false, 1, true));
    const auto mean = limit.mesh.values<float>("mean_curvature"),
               gauss = limit.mesh.values<float>("gaussian_curvature");
    int looked = 0;
    for (std::size_t v = 0; v < limit.report.places.size(); ++v) {
      const Vec3d p = limit.report.places[v];
      if (std::abs(p.x) > 2.1 || std::abs(p.y - 4) > 2.1) continue;
      ++looked;
      const double slope = 2 * kBend * p.x, second = 2 * kBend;
      // It bends towards its normal, so it is concave.
      EXPECT_NEAR(mean[v], -second / (2 * std::pow(1 + slope * slope, 1.5)), 1e-6);
      EXPECT_NEAR(gauss[v], 0, 1e-6);
      EXPECT_NEAR(limit.mesh.normals[v].x / limit.mesh.normals[v].z, -slope, 1e-5);
    }
    EXPECT_GT(looked, 50);
  }
}

/// Appendix B, held against differences of the surface: the dense limit of a Gaussian mesh, by its neighbours.
TEST(LimitSurface, CurvatureOfGaussiansIsThatOfDenseMeshes) {
  for (const auto scheme : {SubdivisionScheme::kLoop, kCatmullClark}) {
    const Mesh mesh = withCovariances(scheme == kCatmullClark ? quadCube() : octahedron(), 0.2, 9);
    const Sample limit = sample(mesh, optionsFor(scheme, true, 7, true));
    // The integral of the Gaussian curvature over a closed surface of its genus is 4π.
    const auto gauss = limit.mesh.values<float>("gaussian_curvature");
    double total = 0;
    for (std::size_t f = 0; f < detail::triangleCount(limit.mesh); ++f) {
      const Triangle t = detail::triangle(limit.mesh, f);
      const auto& p = limit.report.places;
      const double area = length(cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]])) / 2;
      total += area * (gauss[t[0]] + gauss[t[1]] + gauss[t[2]]) / 3;
    }
    EXPECT_NEAR(total / (4 * std::numbers::pi), 1, 0.01);
  }
}

/// Inside a regular mesh the surface has one normal on both sides of the border of two patches. Those of neighbouring
/// vertices across it differ by what the distance between them makes, which halves from level to level.
TEST(LimitSurface, NormalsDoNotJumpAcrossPatches) {
  for (const auto scheme : {SubdivisionScheme::kLoop, kCatmullClark}) {
    const Mesh mesh = withCovariances(scheme == kCatmullClark ? quadCube() : octahedron(), 0.1, 4);
    double before = 0;
    for (int level = 3; level <= 7; ++level) {
      const Sample limit = sample(mesh, optionsFor(scheme, true, level, true));
      double jump = 0;
      for (std::size_t f = 0; f < detail::faceCount(limit.mesh); ++f) {
        const auto named = detail::face(limit.mesh, f);
        jump = std::max<double>(jump, length(limit.mesh.normals[named[0]] - limit.mesh.normals[named[1]]));
      }
      if (level > 5) {
        EXPECT_LT(jump, 0.75 * before);
      }
      before = jump;
    }
    EXPECT_LT(before, 0.1);
  }
}

TEST(LimitSurface, SpheresAreConvexAndLookOutwards) {
  const Sample ball = sample(sphere(8), {.levels = 1, .covariances = {}, .limit = true, .keepPlaces = true});
  const auto mean = ball.mesh.values<float>("mean_curvature"), gauss = ball.mesh.values<float>("gaussian_curvature");
  for (std::size_t v = 0; v < mean.size(); ++v) {
    const Vec3f p = ball.mesh.positions[v];
    EXPECT_GT(dot(p, ball.mesh.normals[v]), 0.95F * length(p));
    EXPECT_NEAR(mean[v], 1.05, 0.5);
    EXPECT_NEAR(gauss[v], 1.1, 1.0);
  }
  EXPECT_GT(ball.report.estimatedCurvatures, 0u);
  EXPECT_LT(ball.report.estimatedCurvatures, mean.size() / 10);
}

TEST(LimitMasks, SumToOneAndToZero) {
  const auto sum = [](const detail::RingMask& mask) {
    double total = mask.centre;
    for (const double w : mask.edge) total += w;
    for (const double w : mask.face) total += w;
    return total;
  };
  for (std::size_t n = 3; n < 12; ++n) {
    for (const LoopWeights weights : {LoopWeights::kLoop, LoopWeights::kWarren})
      EXPECT_NEAR(sum(detail::loopLimit(n, detail::loopWeight(n, weights))), 1, 1e-14);
    EXPECT_NEAR(sum(detail::catmullClarkLimit(n)), 1, 1e-14);
    for (const bool triangles : {false, true}) {
      const auto smooth = triangles ? detail::loopTangents(n) : detail::catmullClarkTangents(n);
      const auto sector = detail::sectorTangents(n - 2, triangles);
      for (const detail::RingMask* mask : {&smooth.u, &smooth.v, &sector.u, &sector.v})
        EXPECT_NEAR(sum(*mask), 0, 1e-13);
    }
  }
}

}  // namespace
}  // namespace pdc
