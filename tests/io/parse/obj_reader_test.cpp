#include "io/parse/obj_reader.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "io/mesh/read_text.h"
#include "pdc/mesh/mesh_report.h"

namespace pdc {
namespace {

const std::string kVertices = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

TEST(ReadObj, KeywordsInCapitals) {
  const Mesh mesh = readText("a.obj", "V 0 0 0\nV 1 0 0\nV 0 1 0\nVN 0 0 1\nVN 0 0 1\nVN 0 1 0\nF 1//1 2//2 3//3\n");
  EXPECT_EQ(mesh.triangles, (Buffer<Triangle>{{0, 1, 2}}));
  EXPECT_EQ(mesh.normals, (Buffer<Vec3f>{{0, 0, 1}, {0, 0, 1}, {0, 1, 0}}));
}

TEST(ReadObj, LinesContinueAfterABackslash) {
  for (const char* face :
       {"f 1 2 \\\n3 4\n", "f 1 2 \\\r\n3 4\r\n", "f 1\\\n2\\\n3\\\n4\n", "f \\\n1 2 3 4", "f 1 2 3 4\\"}) {
    const Mesh mesh = readText("a.obj", kVertices + face);
    EXPECT_EQ(mesh.quads, (Buffer<Quad>{{0, 1, 2, 3}})) << face;
  }
  EXPECT_EQ(readText("a.obj", kVertices + "# C:\\models\\\nf 1 2 3\n").triangles.size(), 1u)
      << "a comment does not go on";
  EXPECT_EQ(errorOf("a.obj", kVertices + "f 1 2 \\\n3\nf 1 x 2\n"), "line 7: malformed face \"f 1 x 2\"");
}

TEST(ReadObj, CornersMayLackWhatFollowsTheVertex) {
  for (const char* face : {"f 1/1/ 2/1/ 3/1/\n", "f 1// 2// 3//\n", "f 1/ 2/ 3/\n", "f -4/1 -3/1 -2/1\n", "fo 1 2 3\n"})
    EXPECT_EQ(readText("a.obj", kVertices + "vt 0 0\n" + face).triangles, (Buffer<Triangle>{{0, 1, 2}})) << face;
  EXPECT_EQ(errorOf("a.obj", kVertices + "f 1/1/1/1 2 3\n"), "line 5: malformed face \"f 1/1/1/1 2 3\"");
  EXPECT_EQ(errorOf("a.obj", kVertices + "f 1.0 2.0 3.0\n"), "line 5: malformed face \"f 1.0 2.0 3.0\"");
}

TEST(ReadObj, MissingVerticesAreNamedAsTheFileNamesThem) {
  EXPECT_EQ(errorOf("a.obj", kVertices + "f 1 2 3\nf 1 2 99\n"),
            "line 6: a face names vertex 99, but there are 4 vertices, numbered from 1");
  EXPECT_EQ(errorOf("a.obj", kVertices + "f -1 -2 -5\n"), "line 5: a face names number -5, but only 4 come before it");
  EXPECT_EQ(errorOf("a.obj", kVertices + "f 1 2\n"), "line 5: a face has 2 corners, and needs 3 at least");
  EXPECT_EQ(readText("a.obj", "f 1 2 3\n" + kVertices).triangles.size(), 1u) << "vertices may come later";
}

TEST(ReadObj, VerticesMayHaveWeightsAndColours) {
  const Mesh mesh = readText("a.obj", "v 0 0 0 1.0\nv 1 0 0 0.5 0.5 0.5\nv 0 1 0 1 0 0 1\nf 1 2 3\n");
  EXPECT_EQ(mesh.positions, (Buffer<Vec3f>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
}

TEST(ReadObj, WhatSaysNothingOfFacesIsPassedOver) {
  EXPECT_EQ(
      warningsOf("a.obj", "mtllib a.mtl\no a\ng b\ns off\nusemtl c\n" + kVertices + "vt 0 0\nf 1 2 3\nl 1 2\np 1\n"),
      std::vector<std::string>{});
  EXPECT_EQ(
      warningsOf("a.obj", kVertices + "f 1 2 3\nhello\nworld\n"),
      std::vector<std::string>{"no statements of an OBJ file: 2 lines are not read; the first is line 6, \"hello\""});
}

TEST(ReadObj, FreeFormSurfacesAreNotRead) {
  const std::string surface = "cstype bspline\ndeg 1 1\nsurf 0 1 0 1 1 2 3 4\nend\n";
  EXPECT_EQ(errorOf("a.obj", kVertices + surface),
            "it has free-form surfaces and no faces: 4 lines are not read; the first is line 5, \"cstype\"");
  EXPECT_EQ(warningsOf("a.obj", kVertices + "f 1 2 3\n" + surface),
            std::vector<std::string>{
                "free-form surfaces are not read: 4 lines are not read; the first is line 6, \"cstype\""});
}

TEST(ReadObj, AMeshWithoutFacesArrives) {
  EXPECT_TRUE(readText("a.obj", "# nothing\n").empty());
  EXPECT_EQ(readText("a.obj", kVertices).positions.size(), 4u);
}

TEST(ReadObj, AConcavePolygonIsTriangulatedWithinItself) {
  const Mesh mesh =
      readText("a.obj",
               "v 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\nv 0 0 0\nv 2 0 0\nv 2 1 1\nv 1 1 1\nv 1 2 1\nv 0 2 1\n"
               "v 0 0 1\nv 2 0 1\nf 6 5 4 3 2 1\nf 7 8 9 10 11 12\nf 1 2 8 7\nf 2 3 9 8\nf 3 4 10 9\n"
               "f 4 5 11 10\nf 5 6 12 11\nf 6 1 7 12\n");
  const MeshReport report = analyze(mesh);
  EXPECT_EQ(report.area, 14);
  EXPECT_EQ(report.volume, 3);
  EXPECT_EQ(report.eulerNumber, 2);
  EXPECT_EQ(report.triangles, 8u);
}

TEST(ReadObj, AConcaveQuadBeginsWithACornerThatSplitsItUnlessWeWroteIt) {
  // The third corner is reflex.
  const std::string arrow = "v 0 2 0\nv -1 0 0\nv 0 1 0\nv 1 0 0\n";
  EXPECT_EQ(readText("a.obj", arrow + "f 2 3 4 1\n").quads, (Buffer<Quad>{{2, 3, 0, 1}}));
  EXPECT_EQ(readText("a.obj", arrow + "f 1 2 3 4\n").quads, (Buffer<Quad>{{0, 1, 2, 3}}));
  EXPECT_EQ(readText("a.obj", "# pdc\n" + arrow + "f 2 3 4 1\n").quads, (Buffer<Quad>{{1, 2, 3, 0}}));
}

}  // namespace
}  // namespace pdc
