// Side by side with CGAL's Polygon_mesh_processing::self_intersections, on meshes with all kinds of faults.

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <iterator>
#include <map>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "mesh/faces.h"
#include "pdc/mesh/self_intersections.h"

namespace pdc {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;
using Random = std::mt19937;

/// Faces in the order of our triangles; fails for a mesh that it cannot hold.
Surface toCgal(const Mesh& mesh) {
  Surface surface;
  for (const Vec3f& p : mesh.positions) surface.add_vertex({p.x, p.y, p.z});
  for (std::size_t i = 0; i < detail::triangleCount(mesh); ++i) {
    const Triangle t = detail::triangle(mesh, i);
    using Vertex = Surface::Vertex_index;
    EXPECT_EQ(surface.add_face(Vertex(t[0]), Vertex(t[1]), Vertex(t[2])).idx(), i);
  }
  return surface;
}

SelfIntersections askCgal(const Mesh& mesh) {
  const Surface surface = toCgal(mesh);
  std::vector<std::pair<Surface::Face_index, Surface::Face_index>> pairs;
  CGAL::Polygon_mesh_processing::self_intersections<CGAL::Sequential_tag>(faces(surface), surface,
                                                                          std::back_inserter(pairs));
  SelfIntersections result;
  for (const auto& [a, b] : pairs) {
    if (a == b) {
      ++result.degenerateTriangles;
    } else {
      result.pairs.push_back({std::min(a.idx(), b.idx()), std::max(a.idx(), b.idx())});
    }
  }
  std::sort(result.pairs.begin(), result.pairs.end());
  return result;
}

// --- sound meshes, of about n x n quads in each part

Mesh torus(std::uint32_t n) {
  Mesh mesh;
  for (std::uint32_t i = 0; i < n; ++i)
    for (std::uint32_t j = 0; j < n; ++j) {
      const double u = 2 * std::numbers::pi * i / n, v = 2 * std::numbers::pi * j / n, r = 2 + std::cos(v);
      mesh.positions.push_back(vecCast<float>(Vec3d{r * std::cos(u), r * std::sin(u), std::sin(v)}));
      const auto at = [n](std::uint32_t a, std::uint32_t b) { return (a % n) * n + b % n; };
      mesh.quads.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  return mesh;
}

/// Flat and open.
Mesh sheet(std::uint32_t n) {
  Mesh mesh;
  for (std::uint32_t i = 0; i <= n; ++i)
    for (std::uint32_t j = 0; j <= n; ++j) {
      mesh.positions.push_back({static_cast<float>(i), static_cast<float>(j), 0});
      if (i == n || j == n) continue;
      const std::uint32_t a = i * (n + 1) + j, b = a + n + 1;
      mesh.triangles.push_back({a, b, b + 1});
      mesh.triangles.push_back({a, b + 1, a + 1});
    }
  return mesh;
}

Mesh cube(std::uint32_t n) {
  Mesh mesh;
  std::map<std::array<std::uint32_t, 3>, std::uint32_t> numbers;
  const auto vertex = [&](const std::array<std::uint32_t, 3>& p) {
    const auto [place, isNew] = numbers.try_emplace(p, static_cast<std::uint32_t>(mesh.positions.size()));
    if (isNew) mesh.positions.push_back({static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])});
    return place->second;
  };
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const std::uint32_t side : {0u, n})
      for (std::uint32_t i = 0; i < n; ++i)
        for (std::uint32_t j = 0; j < n; ++j) {
          const auto at = [&](std::uint32_t u, std::uint32_t v) {
            std::array<std::uint32_t, 3> p{};
            p[axis] = side, p[(axis + 1) % 3] = i + u, p[(axis + 2) % 3] = j + v;
            return vertex(p);
          };
          Quad q{at(0, 0), at(1, 0), at(1, 1), at(0, 1)};
          if (side == 0) std::swap(q[1], q[3]);
          mesh.quads.push_back(q);
        }
  return mesh;
}

Mesh sphere(std::uint32_t n) {
  Mesh mesh = cube(n);
  for (Vec3f& p : mesh.positions) {
    const Vec3f d = p - Vec3f{1, 1, 1} * (0.5f * static_cast<float>(n));
    p = d * (2 / length(d));
  }
  return mesh;
}

// --- faults

std::uint32_t anyVertex(const Mesh& mesh, Random& random) {
  return static_cast<std::uint32_t>(random() % mesh.positions.size());
}

float spread(const Mesh& mesh) {
  return length(mesh.positions[mesh.quads.empty() ? 1 : mesh.quads[0][1]] - mesh.positions[0]);
}

void shake(Mesh& mesh, Random& random, float share) {
  std::uniform_real_distribution<float> uniform(-share * spread(mesh), share * spread(mesh));
  for (Vec3f& p : mesh.positions) p += Vec3f{uniform(random), uniform(random), uniform(random)};
}

void addMoved(Mesh& mesh, const Vec3f& by) {
  const Mesh copy = mesh;
  const auto offset = static_cast<std::uint32_t>(mesh.positions.size());
  for (const Vec3f& p : copy.positions) mesh.positions.push_back(p + by);
  for (const Quad& q : copy.quads) mesh.quads.push_back({q[0] + offset, q[1] + offset, q[2] + offset, q[3] + offset});
  for (const Triangle& t : copy.triangles) mesh.triangles.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
}

float width(const Mesh& mesh) {
  const auto [lo, hi] = std::minmax_element(mesh.positions.begin(), mesh.positions.end(),
                                            [](const Vec3f& a, const Vec3f& b) { return a.x < b.x; });
  return hi->x - lo->x;
}

using Fault = std::function<void(Mesh&, Random&)>;

const std::vector<std::pair<const char*, Fault>> kFaults{
    {"none", [](Mesh&, Random&) {}},
    {"shaken a little", [](Mesh& m, Random& r) { shake(m, r, 0.05f); }},
    {"shaken", [](Mesh& m, Random& r) { shake(m, r, 0.4f); }},
    {"crumpled", [](Mesh& m, Random& r) { shake(m, r, 1.5f); }},
    {"pierced by a spike",
     [](Mesh& m, Random& r) {
       m.positions[anyVertex(m, r)] = m.positions[anyVertex(m, r)] * 1.01f + Vec3f{0, 0, 0.1f};
     }},
    {"two vertices in one place",
     [](Mesh& m, Random& r) { m.positions[anyVertex(m, r)] = m.positions[anyVertex(m, r)]; }},
    {"folded about a vertex's neighbour",
     [](Mesh& m, Random& r) {
       const Triangle t = detail::triangle(m, r() % detail::triangleCount(m));
       m.positions[t[0]] = m.positions[t[1]] * 2.0f - m.positions[t[0]];
     }},
    {"rounded to a coarse lattice",
     [](Mesh& m, Random&) {
       const float step = 1.7f * spread(m);
       for (Vec3f& p : m.positions) p = {std::round(p.x / step), std::round(p.y / step), std::round(p.z / step)};
     }},
    {"two parts in each other",
     [](Mesh& m, Random&) {
       addMoved(m, {0.5f, 0.25f, 0});
     }},
    {"two parts in one place",
     [](Mesh& m, Random&) {
       addMoved(m, {0, 0, 0});
     }},
    {"two parts that touch",
     [](Mesh& m, Random&) {
       addMoved(m, {width(m), 0, 0});
     }},
    {"two parts nearly touch",
     [](Mesh& m, Random&) {
       addMoved(m, {std::nextafter(width(m), 1e9f), 0, 0});
     }},
};

TEST(SelfIntersectionsAndCgal, FindTheSamePairs) {
  Random random(2718);
  std::size_t meshes = 0, sound = 0, pairs = 0, degenerate = 0;
  for (const std::uint32_t size : {3u, 5u, 7u, 8u, 11u})
    for (const auto& make : {torus, sheet, cube, sphere})
      for (const auto& [name, spoil] : kFaults) {
        Mesh mesh = make(size);
        spoil(mesh, random);
        SCOPED_TRACE(name);
        const SelfIntersections expected = askCgal(mesh), found = selfIntersections(mesh);
        ASSERT_EQ(found.pairs, expected.pairs);
        ASSERT_EQ(found.degenerateTriangles, expected.degenerateTriangles);
        ++meshes;
        sound += found.pairs.empty();
        pairs += found.pairs.size();
        degenerate += found.degenerateTriangles;
      }
  EXPECT_EQ(meshes, 240u);
  EXPECT_GT(sound, 50u);
  EXPECT_LT(sound, 100u);
  EXPECT_GT(pairs, 10'000u);
  EXPECT_GT(degenerate, 100u);
}

}  // namespace
}  // namespace pdc
