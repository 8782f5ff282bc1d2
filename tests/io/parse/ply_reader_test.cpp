#include "io/parse/ply_reader.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "io/mesh/read_text.h"

namespace pdc {
namespace {

const std::string kHead = "ply\nformat ascii 1.0\n";
const std::string kVertices = "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n";
const std::string kPositions = "0 0 0\n1 0 0\n0 1 0\n1 1 0\n";

std::string strips(const std::string& lists) {
  return kHead + kVertices + "element tristrips 1\nproperty list int int vertex_indices\nend_header\n" + kPositions +
         lists;
}

TEST(ReadPly, StripsOfTrianglesFaceOneWay) {
  EXPECT_EQ(readText("a.ply", strips("4 0 1 2 3\n")).triangles, (Buffer<Triangle>{{0, 1, 2}, {2, 1, 3}}));
  EXPECT_EQ(readText("a.ply", strips("9 0 1 2 -1 1 3 2 -1 -1\n")).triangles, (Buffer<Triangle>{{0, 1, 2}, {1, 3, 2}}));
  EXPECT_EQ(readText("a.ply", strips("6 0 1 2 2 3 0\n")).triangles, (Buffer<Triangle>{{0, 1, 2}, {3, 2, 0}}))
      << "a vertex named twice turns the strip";
  EXPECT_EQ(errorOf("a.ply", strips("4 0 1 2 4\n")),
            "line 14: a face names vertex 4, but there are 4 vertices, numbered from 0");
}

TEST(ReadPly, FacesThatAreNotReadAreErrors) {
  EXPECT_EQ(
      errorOf("a.ply", kHead + kVertices + "element trifans 1\nproperty list int int vertex_indices\nend_header\n" +
                           kPositions + "4 0 1 2 3\n"),
      "faces in elements of kind \"trifans\" are not read");
  EXPECT_EQ(errorOf("a.ply", kHead + kVertices + "element face 1\nproperty list uchar int corners\nend_header\n" +
                                 kPositions + "3 0 1 2\n"),
            "elements of kind \"face\" need a list vertex_indices");
  EXPECT_EQ(
      warningsOf("a.ply", kHead + kVertices + "element face 1\nproperty list uchar int vertex_indices\nend_header\n" +
                              kPositions + "3 0 1 2\n3 1 2 3\n"),
      std::vector<std::string>{"7 bytes after the last element are not read"});
}

TEST(ReadPly, KeywordsInCapitals) {
  const Mesh mesh = readText("a.ply",
                             "PLY\nFORMAT ASCII 1.0\nELEMENT VERTEX 3\nPROPERTY FLOAT X\nPROPERTY FLOAT Y\n"
                             "PROPERTY FLOAT Z\nELEMENT FACE 1\nPROPERTY LIST UCHAR INT VERTEX_INDICES\nEND_HEADER\n"
                             "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  EXPECT_EQ(mesh.triangles, (Buffer<Triangle>{{0, 1, 2}}));
  EXPECT_TRUE(mesh.properties.empty());
}

TEST(ReadPly, TheBodyOfABinaryFileStaysWhenLinesEndWithReturns) {
  // The first byte after the header and one within are those of line ends.
  const std::string head =
      "ply\rformat binary_little_endian 1.0\relement vertex 3\rproperty uchar x\rproperty uchar y\rproperty uchar z\r"
      "element face 1\rproperty list uchar uchar vertex_indices\rend_header\r";
  const Mesh mesh = readText("a.ply", head + "\n\r\r" + std::string("\r\r\n") + "\n\n\n" + std::string("\3\0\1\2", 4));
  EXPECT_EQ(mesh.positions, (Buffer<Vec3f>{{10, 13, 13}, {13, 13, 10}, {10, 10, 10}}));
  EXPECT_EQ(mesh.triangles, (Buffer<Triangle>{{0, 1, 2}}));
}

TEST(ReadPly, MissingVerticesOfABinaryFileAreNamedWithTheirFace) {
  const std::string file = "ply\nformat binary_little_endian 1.0\n" + kVertices +
                           "element face 2\nproperty list uchar int vertex_indices\nend_header\n" +
                           std::string(48, '\0') + "\3" + bytes(0, 1, 2) + "\3";
  EXPECT_EQ(errorOf("a.ply", file + bytes(0, 1, 7)),
            "face 1 names vertex 7, but there are 4 vertices, numbered from 0");
  EXPECT_EQ(errorOf("a.ply", file + bytes(0, 1, -1)), "face 1 names vertex -1, but vertices are numbered from 0");
}

}  // namespace
}  // namespace pdc
