// Scenes of meshes side by side with CGAL's corefinement, which cuts triangles exactly where they meet.

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Surface_mesh.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

#include "folders.h"
#include "io/file/temporary_folder.h"
#include "mesh/faces.h"
#include "mesh/nearest_triangles.h"
#include "mesh/point_triangle.h"
#include "mesh/winding/cubes.h"
#include "pdc/extract/contour.h"
#include "pdc/io/mesh/mesh_reader.h"
#include "pdc/io/mesh/mesh_writer.h"
#include "pdc/io/scene/scene_reader.h"
#include "pdc/sample/implicit/field_source.h"

namespace pdc {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;
using SideOf = CGAL::Side_of_triangle_mesh<Surface, Kernel>;
using Segment = std::array<Vec3d, 2>;
namespace Processing = CGAL::Polygon_mesh_processing;

Vec3d toVec(const Kernel::Point_3& p) { return {p.x(), p.y(), p.z()}; }

Surface toCgal(const Mesh& mesh) {
  Surface surface;
  for (const Vec3f& p : mesh.positions) surface.add_vertex({p.x, p.y, p.z});
  for (std::size_t i = 0; i < detail::triangleCount(mesh); ++i) {
    const Triangle t = detail::triangle(mesh, i);
    using Vertex = Surface::Vertex_index;
    surface.add_face(Vertex(t[0]), Vertex(t[1]), Vertex(t[2]));
  }
  return surface;
}

Surface unite(Surface a, Surface b) {
  Surface result;
  EXPECT_TRUE(Processing::corefine_and_compute_union(a, b, result));
  return result;
}

Surface subtract(Surface a, Surface b) {
  Surface result;
  EXPECT_TRUE(Processing::corefine_and_compute_difference(a, b, result));
  return result;
}

Mesh scaled(Mesh mesh, float scale, const Vec3f& by) {
  for (Vec3f& p : mesh.positions) p = p * scale + by;
  return mesh;
}

/// Turned so that no face or edge of a part meets one of the same direction.
Mesh turned(Mesh mesh, const Vec3d& by) {
  const double c = std::cos(0.6), s = std::sin(0.6);
  for (Vec3f& p : mesh.positions) {
    const Vec3d q = vecCast<double>(p), r{c * q.x - s * q.y, s * q.x + c * q.y, q.z};
    p = vecCast<float>(Vec3d{r.x, c * r.y - s * r.z, s * r.y + c * r.z} + by);
  }
  return mesh;
}

Mesh joint() {
  const auto path = test::dataFolder() / "mesh" / "cgal_joint.off";
  return std::filesystem::exists(path) ? readMesh(path) : Mesh{};
}

/// Edges with smaller angles between their faces are those of flat faces.
constexpr double kFlat = std::numbers::pi / 180;
constexpr double kSharp = 20 * kFlat;

/// Sharp edges of the result that are where the surfaces of both parts meet, and all other edges that are not flat.
struct Edges {
  std::vector<Segment> cut, other;
};

class MeshBooleansAndCgal : public testing::Test {
 protected:
  void SetUp() override { write("cube.stl", test::cube()); }
  void write(const std::string& name, const Mesh& mesh) { static_cast<void>(writeMesh(mesh, mFolder / name)); }

  void expectAgreement(const Mesh& first, const Mesh& second, const std::string& shape, const Surface& expected) {
    write("first.stl", first);
    write("second.stl", second);
    const Mesh result = contourScene(shape, expected);
    expectSameSolid(toCgal(result), expected);
    expectCreases(result, findEdges(first, second, expected));
  }

 private:
  Mesh contourScene(const std::string& shape, const Surface& expected) {
    mBox = Box::empty();
    for (const auto v : expected.vertices())
      if (!expected.is_removed(v)) mBox.include(toVec(expected.point(v)));
    const Vec3d size = mBox.hi - mBox.lo;
    mVoxel = std::max({size.x, size.y, size.z}) / 64;
    const Vec3d room = Vec3d{2.13, 2.27, 2.31} * mVoxel;
    mBox = {mBox.lo - room, mBox.hi + room};
    std::ofstream(mFolder / "scene.yaml") << "box: [[-9, -9, -9], [9, 9, 9]]\nresolution: 8\nshape: " << shape << '\n';
    FieldSource source(readScene(mFolder / "scene.yaml").field, {.box = mBox, .voxelSize = mVoxel});
    return contour(source, {.sigmaNormal = 0.02});
  }

  /// The share of the solid's points that are in one of the two alone.
  void expectSameSolid(const Surface& ours, const Surface& expected) const {
    constexpr int kSide = 48;
    const SideOf inOurs(ours), inExpected(expected);
    int solid = 0, different = 0;
    std::uint32_t random = 1;
    const auto at = [&](int axis, int i) {
      random = random * 1664525U + 1013904223U;
      return mBox.lo[axis] + (mBox.hi[axis] - mBox.lo[axis]) * (i + (random >> 8) * 0x1p-24) / kSide;
    };
    for (int x = 0; x < kSide; ++x)
      for (int y = 0; y < kSide; ++y)
        for (int z = 0; z < kSide; ++z) {
          const Kernel::Point_3 p(at(0, x), at(1, y), at(2, z));
          const bool in = inExpected(p) == CGAL::ON_BOUNDED_SIDE;
          solid += in ? 1 : 0;
          different += in != (inOurs(p) == CGAL::ON_BOUNDED_SIDE) ? 1 : 0;
        }
    EXPECT_GT(solid, 5000);
    EXPECT_LE(different, 1e-3 * solid);
  }

  [[nodiscard]] Edges findEdges(const Mesh& first, const Mesh& second, const Surface& result) const {
    const detail::NearestTriangles a(first), b(second);
    const double near = 1e-5 * mVoxel * mVoxel;
    Edges edges;
    for (const auto e : result.edges()) {
      const auto h = result.halfedge(e);
      const auto normal = [&](Surface::Halfedge_index half) {
        const Vec3d p = toVec(result.point(result.source(half))), q = toVec(result.point(result.target(half)));
        const Vec3d n = cross(q - p, toVec(result.point(result.target(result.next(half)))) - p);
        return n * (1 / length(n));
      };
      const double angle = std::acos(std::clamp(dot(normal(h), normal(result.opposite(h))), -1.0, 1.0));
      if (angle < kFlat) continue;
      const Segment s{toVec(result.point(result.source(h))), toVec(result.point(result.target(h)))};
      bool cut = true;
      for (const Vec3d& p : {s[0], s[1], (s[0] + s[1]) * 0.5})
        cut = cut && a.find(p).squared < near && b.find(p).squared < near;
      if (!cut) edges.other.push_back(s);
      if (cut && angle > kSharp) edges.cut.push_back(s);
    }
    return edges;
  }

  /// The creases of the cut, three voxels and more from other ones.
  void expectCreases(const Mesh& ours, const Edges& edges) const {
    const detail::NearestTriangles nearest(ours);
    double sum = 0;
    int count = 0;
    for (const Segment& s : edges.cut) {
      const int steps = static_cast<int>(std::ceil(4 * length(s[1] - s[0]) / mVoxel));
      for (int i = 0; i < steps; ++i) {
        const Vec3d p = s[0] + (s[1] - s[0]) * ((i + 0.5) / steps);
        if (std::any_of(edges.other.begin(), edges.other.end(), [&](const Segment& o) {
              return detail::squaredToSegment(p, o[0], o[1]) < 9 * mVoxel * mVoxel;
            }))
          continue;
        sum += nearest.find(p - ours.origin).squared;
        ++count;
      }
    }
    ASSERT_GT(count, 100);
    RecordProperty("rms", std::to_string(std::sqrt(sum / count) / mVoxel));
    EXPECT_LE(std::sqrt(sum / count), 0.01 * mVoxel);
  }

  TemporaryFolder mFolder;
  Box mBox{};
  double mVoxel = 0;
};

const std::string kBoth = "[{mesh: {file: first.stl}}, {mesh: {file: second.stl}}]";

TEST_F(MeshBooleansAndCgal, Union) {
  const Mesh a = test::cube(), b = turned(test::cube(), {0.9, 0.4, 0.3});
  expectAgreement(a, b, "{union: " + kBoth + "}", unite(toCgal(a), toCgal(b)));
}

TEST_F(MeshBooleansAndCgal, Difference) {
  const Mesh a = test::cube(), b = turned(test::cube(), {0.9, 0.4, 0.3});
  expectAgreement(a, b, "{difference: " + kBoth + "}", subtract(toCgal(a), toCgal(b)));
}

TEST_F(MeshBooleansAndCgal, ShellCutOpen) {
  const Mesh a = test::cube(), b = turned(test::cube(), {0.9, 0.4, 0.3});
  const Surface wall = subtract(toCgal(a), toCgal(scaled(a, 0.75F, {0.125F, 0.125F, 0.125F})));
  expectAgreement(
      a, b,
      "{difference: [{mesh: {file: first.stl}}, {offset: {distance: -0.125, of: {mesh: {file: first.stl}}}}, "
      "{mesh: {file: second.stl}}]}",
      subtract(wall, toCgal(b)));
}

TEST_F(MeshBooleansAndCgal, OffsetAndUnited) {
  const Mesh a = test::cube(), b = turned(test::cube(), {0.9, 0.4, 0.3});
  const Mesh inner = scaled(a, 0.75F, {0.125F, 0.125F, 0.125F});
  expectAgreement(inner, b,
                  "{union: [{offset: {distance: -0.125, of: {mesh: {file: cube.stl}}}}, {mesh: {file: second.stl}}]}",
                  unite(toCgal(inner), toCgal(b)));
}

TEST_F(MeshBooleansAndCgal, MachinedParts) {
  const Mesh a = joint();
  if (a.empty()) GTEST_SKIP() << "no cgal_joint.off in " << test::dataFolder();
  const Mesh b = turned(a, {0.35, 0.1, 0.2});
  expectAgreement(a, b, "{union: " + kBoth + "}", unite(toCgal(a), toCgal(b)));
  expectAgreement(a, b, "{difference: " + kBoth + "}", subtract(toCgal(a), toCgal(b)));
}

}  // namespace
}  // namespace pdc
