#include "mesh/mesh_checks.h"

#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <stdexcept>
#include <string>
#include <utility>

#include "pdc/error.h"
#include "pdc/io/mesh/mesh_writer.h"
#include "pdc/mesh/distance.h"
#include "pdc/mesh/mesh_report.h"
#include "pdc/mesh/minimum_angles.h"
#include "pdc/mesh/roughness.h"
#include "pdc/mesh/self_intersections.h"
#include "pdc/render/render.h"

namespace pdc {
namespace {

Mesh triangle() {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}};
  return mesh;
}

/// What is wrong with a mesh; empty if nothing is.
std::string complaint(const Mesh& mesh) {
  try {
    detail::checkSizes(mesh, "caller");
    return "";
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
}

std::string complaint(std::vector<VertexProperty> properties) {
  Mesh mesh = triangle();
  mesh.properties = std::move(properties);
  return complaint(mesh);
}

TEST(CheckSizes, ArraysOfOneLengthAreFine) {
  Mesh mesh = triangle();
  EXPECT_EQ(complaint(mesh), "");
  EXPECT_EQ(complaint(Mesh{}), "");
  mesh.normals.resize(3);
  mesh.properties = {{"a", 1, Buffer<float>(3)}, {"b", 4, Buffer<std::uint8_t>(12)}};
  EXPECT_EQ(complaint(mesh), "");
}

TEST(CheckSizes, WrongLengthsAndNamesAreRefused) {
  Mesh mesh = triangle();
  mesh.normals.resize(2);
  EXPECT_EQ(complaint(mesh), "caller: 2 normals for 3 vertices");
  EXPECT_EQ(complaint({{"a", 1, Buffer<float>(2)}}),
            "caller: property \"a\" has 2 numbers for 3 vertices of 1 components");
  EXPECT_EQ(complaint({{"a", 2, Buffer<float>(3)}}),
            "caller: property \"a\" has 3 numbers for 3 vertices of 2 components");
  EXPECT_EQ(complaint({{"a", 0, Buffer<float>(0)}}), "caller: property \"a\" has 0 components, must be 1 to 4");
  EXPECT_EQ(complaint({{"a", 5, Buffer<float>(15)}}), "caller: property \"a\" has 5 components, must be 1 to 4");
  EXPECT_EQ(complaint({{"", 1, Buffer<float>(3)}}), "caller: a property without a name");
  EXPECT_EQ(complaint({{"a", 1, Buffer<float>(3)}, {"a", 1, Buffer<double>(3)}}), "caller: two properties \"a\"");
}

TEST(CheckIndices, NamesTheFirstFaceOfAMissingVertex) {
  Mesh mesh = triangle();
  EXPECT_NO_THROW(detail::checkIndices(mesh));
  mesh.quads = {{0, 1, 2, 0}, {0, 7, 1, 3}};
  mesh.triangles.push_back({0, 1, 9});
  try {
    detail::checkIndices(mesh);
    ADD_FAILURE() << "no error";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "face 1 names vertex 7, but the mesh has 3 vertices");
  }
}

using Call = std::pair<const char*, std::function<void(const Mesh&)>>;

const std::array<Call, 9> kCalls{
    Call{"analyze", [](const Mesh& mesh) { static_cast<void>(analyze(mesh)); }},
    Call{"distances", [](const Mesh& mesh) { static_cast<void>(distances({}, mesh)); }},
    Call{"fitCamera",
         [](const Mesh& mesh) {
           static_cast<void>(fitCamera({&mesh, 1}, {0, 0, 1}, 8, 8));
         }},
    Call{"flatVertices", [](const Mesh& mesh) { static_cast<void>(flatVertices(mesh, 10)); }},
    Call{"minimumAngles", [](const Mesh& mesh) { static_cast<void>(minimumAngles(mesh)); }},
    Call{"render", [](const Mesh& mesh) { static_cast<void>(render(mesh, {.width = 8, .height = 8})); }},
    Call{"roughness", [](const Mesh& mesh) { static_cast<void>(roughness(mesh, {})); }},
    Call{"selfIntersections", [](const Mesh& mesh) { static_cast<void>(selfIntersections(mesh)); }},
    Call{"writeMesh", [](const Mesh& mesh) { writeMesh(mesh, "/dev/null/a.ply"); }}};

TEST(MeshChecks, EveryFunctionRefusesArraysThatDoNotFit) {
  Mesh mesh = triangle();
  mesh.normals.resize(2);
  for (const auto& [name, call] : kCalls) {
    try {
      call(mesh);
      ADD_FAILURE() << name;
    } catch (const std::invalid_argument& error) {
      EXPECT_EQ(error.what(), std::string(name) + ": 2 normals for 3 vertices");
    }
  }
}

TEST(MeshChecks, PolygonsAreRefusedWhereOnlyTrianglesAndQuadsAreKnown) {
  Mesh mesh = triangle();
  mesh.polygons.add(std::array<std::uint32_t, 5>{0, 1, 2, 1, 2});
  for (const auto& [name, call] : kCalls) {
    const std::string caller = name;
    if (caller == "analyze" || caller == "writeMesh") continue;
    try {
      call(mesh);
      ADD_FAILURE() << name;
    } catch (const std::invalid_argument& error) {
      EXPECT_EQ(error.what(), caller + ": 1 polygons, must be triangles and quads; see triangulatePolygons");
    }
  }
}

TEST(MeshChecks, IndicesOfPolygonsAreLookedAt) {
  Mesh mesh = triangle();
  mesh.polygons.add(std::array<std::uint32_t, 5>{0, 1, 2, 1, 3});
  EXPECT_THROW(detail::checkIndices(mesh), Error);
}

TEST(MeshChecks, EveryFunctionNamesFacesOfMissingVertices) {
  Mesh mesh = triangle();
  mesh.triangles[0][1] = 3;
  for (const auto& [name, call] : kCalls) {
    try {
      call(mesh);
      ADD_FAILURE() << name;
    } catch (const Error& error) {
      EXPECT_STREQ(error.what(), "face 0 names vertex 3, but the mesh has 3 vertices") << name;
    }
  }
}

}  // namespace
}  // namespace pdc
