#include "io/parse/narrowing.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "io/mesh/read_text.h"
#include "pdc/io/mesh/mesh_writer.h"
#include "pdc/mesh/mesh_report.h"

namespace pdc {
namespace {

using detail::chooseOrigin;
using detail::Narrowing;

Narrowing of(std::initializer_list<Vec3d> points) {
  Narrowing narrowing;
  for (const Vec3d& p : points) narrowing.include(p);
  return narrowing;
}

TEST(Narrowing, ShiftsOnlyWhereSinglePrecisionDoesNotServe) {
  const Vec3d zero{0, 0, 0};
  EXPECT_EQ(chooseOrigin(of({})), zero);
  EXPECT_EQ(chooseOrigin(of({{1e6, 0, 0}, {1e6 + 1, 1, 1}})), zero) << "exact in single precision";
  EXPECT_EQ(chooseOrigin(of({{16.01, 0.1, 0.1}, {17.01, 1.1, 1.1}})), zero) << "16 sides away";
  EXPECT_NE(chooseOrigin(of({{1000.01, 0, 0}, {1001.01, 1, 1}})), zero);
  EXPECT_EQ(chooseOrigin(of({{1e6 + 0.1, 0, 0}})), zero) << "a point has no size";
  EXPECT_EQ(chooseOrigin(of({{-1e300, 0, 0}, {1e300, 0, 0}})), zero) << "no shift makes these finite";
  EXPECT_EQ(chooseOrigin(of({{std::nan(""), 0, 0}, {INFINITY, 0.1, 0}})), zero);
}

TEST(Narrowing, TheOriginIsAMultipleOfAnEighthOrSoOfTheLargestSide) {
  EXPECT_EQ(chooseOrigin(of({{500000.01, 4600000.02, 7.03}, {500010.01, 4600005.02, 9.03}})),
            (Vec3d{500005, 4600003, 8}));
  EXPECT_EQ(chooseOrigin(of({{-1000.001, 0, 0}, {-999.001, 0.5, 0}})), (Vec3d{-999.5, 0.25, 0}));
}

/// A cube with this low corner and side, 17 digits.
std::string cube(const Vec3d& low, double side) {
  std::string text;
  for (int i = 0; i < 8; ++i)
    text += fmt::format("v {} {} {}\n", low.x + (i & 1) * side, low.y + (i >> 1 & 1) * side, low.z + (i >> 2) * side);
  return text + "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
}

TEST(FarMesh, KeepsItsShapeRelativeToAnOrigin) {
  const Mesh mesh = readText("a.obj", cube({500000.25, 4649776.5, 100.125}, 0.0625));
  EXPECT_EQ(mesh.origin, (Vec3d{500000.28125, 4649776.53125, 100.15625}));
  const MeshReport report = analyze(mesh);
  EXPECT_EQ(report.volume, 0.0625 * 0.0625 * 0.0625);
  EXPECT_EQ(report.bounds, (Box{{500000.25, 4649776.5, 100.125}, {500000.3125, 4649776.5625, 100.1875}}));
}

TEST(FarMesh, AFileCanSayItsOrigin) {
  const std::string triangle = "0 0 0\n1 0 0\n0 1 0\n";
  const Vec3d origin{500000.5, -4600000.25, 1e-9};
  const std::string line = "pdc_origin 500000.5 -4600000.25 1e-09";
  const std::string facet =
      "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";
  std::string binary = "made by hand, " + line;
  binary.resize(80, ' ');
  binary += bytes(std::uint32_t{1}) + std::string(12, '\0') +
            bytes(Vec3f{0, 0, 0}, Vec3f{1, 0, 0}, Vec3f{0, 1, 0}, std::uint16_t{0});
  for (const auto& [name, content] :
       {std::pair<std::string, std::string>{"a.obj", "# " + line + "\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"},
        {"b.off", "OFF\n# " + line + "\r\n3 1 0\n" + triangle + "3 0 1 2\n"},
        {"c.ply", "ply\nformat ascii 1.0\ncomment " + line +
                      "\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                      "element face 1\nproperty list uchar int vertex_indices\nend_header\n" +
                      triangle + "3 0 1 2\n"},
        {"d.stl", "solid part " + line + "\n" + facet + "endsolid\n"},
        {"e.stl", binary}}) {
    const Mesh mesh = readText(name, content);
    EXPECT_EQ(mesh.origin, origin) << name;
    EXPECT_EQ(mesh.positions[1], (Vec3f{1, 0, 0})) << name;
  }
  EXPECT_EQ(
      readText("a.obj", "# pdc_origin of all things\n# pdc_origin 1 2\n# origin 1 2 3\n# pdc_origin 1 2 3 4\nv 0 0 0\n")
          .origin,
      (Vec3d{0, 0, 0}));
  EXPECT_EQ(errorOf("a.obj", "# pdc_origin 1 2 3\nv 0 0 0\n# pdc_origin 1 2 4\n"),
            "two different origins: \"pdc_origin 1 2 3\" and \"pdc_origin 1 2 4\"");
  EXPECT_EQ(errorOf("a.ply", "ply\nformat ascii 1.0\ncomment pdc_origin 1 2 3\ncomment pdc_origin 1 2 4\n"),
            "two different origins: \"pdc_origin 1 2 3\" and \"pdc_origin 1 2 4\"");
}

TEST(FarMesh, IsWrittenWithItsOriginAndReadBack) {
  const TemporaryFolder folder;
  const Mesh mesh = readText("a.obj", cube({1e6 + 0.1, 0.2, 1e7 + 0.3}, 0.7));
  ASSERT_NE(mesh.origin, (Vec3d{0, 0, 0}));
  for (const bool ascii : {true, false})
    for (const char* name : {"a.ply", "a.obj", "a.off", "a.stl"}) {
      writeMesh(mesh, folder / name, {.ascii = ascii});
      const Mesh again = readMesh(folder / name);
      EXPECT_EQ(again.origin, mesh.origin) << name;
      EXPECT_EQ(analyze(again).bounds, analyze(mesh).bounds) << name;
      EXPECT_NEAR(analyze(again).volume, 0.343, 1e-6) << name;
    }
}

}  // namespace
}  // namespace pdc
