#include "io/parse/off_reader.h"

#include <gtest/gtest.h>

#include <string>

#include "io/mesh/read_text.h"

namespace pdc {
namespace {

const Buffer<Vec3f> kCorners{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}};

TEST(ReadOff, WithCountsBehindTheKeywordOrWithoutOne) {
  for (const char* head : {"OFF3 1 0\n", "OFF 3 1 0\n", "OFF\n3 1\n", "3 1 0\n", "off\n3 1 0\n", "Off\n\n3 1 0\n",
                           "# kind\nOFF\n# counts\n3\n1 0\n", "COFF3 1 3\n"}) {
    const Mesh mesh = readText("a.off", std::string(head) + "0 0 0\n2 0 0\n0 2 0\n3 0 1 2\n");
    EXPECT_EQ(mesh.positions, kCorners) << head;
    EXPECT_EQ(mesh.triangles, (Buffer<Triangle>{{0, 1, 2}})) << head;
  }
}

TEST(ReadOff, OfAllKindsInThreeDimensions) {
  const std::string face = "3 0 1 2\n";
  EXPECT_EQ(readText("a.off", "STOFF\n3 1 0\n0 0 0 0 0\n2 0 0 1 0\n0 2 0 0 1\n" + face).positions, kCorners);
  EXPECT_EQ(readText("a.off", "4OFF\n3 1 0\n0 0 0 1\n4 0 0 2\n0 1 0 0.5\n" + face).positions, kCorners);
  EXPECT_EQ(readText("a.off", "nOFF\n3\n3 1 0\n0 0 0\n2 0 0\n0 2 0\n" + face).positions, kCorners);
  EXPECT_EQ(readText("a.off", "nOFF 3 3 1 0\n0 0 0\n2 0 0\n0 2 0\n" + face).positions, kCorners);
  for (const char* kind : {"NOFF", "noff", "CNOFF", "STCNOFF"}) {
    const Mesh mesh = readText("a.off", std::string(kind) + "\n3 1 0\n0 0 0 0 0 1\n2 0 0 0 0 1\n0 2 0 0 1 0\n" + face);
    EXPECT_EQ(mesh.positions, kCorners) << kind;
    EXPECT_EQ(mesh.normals, (Buffer<Vec3f>{{0, 0, 1}, {0, 0, 1}, {0, 1, 0}})) << kind;
  }
}

TEST(ReadOff, OtherKindsAreNamed) {
  EXPECT_EQ(errorOf("a.off", "nOFF\n4\n1 0 0\n0 0 0 0\n"), "OFF of dimension 4; only 3 is read");
  EXPECT_EQ(errorOf("a.off", "off binary\n"), "binary OFF is not read, only OFF as text");
  EXPECT_EQ(errorOf("a.off", "XOFF\n1 0 0\n0 0 0\n"), "not an OFF file: line 1 begins with \"XOFF\"");
  EXPECT_EQ(errorOf("a.off", "OFFICE\n1 0 0\n0 0 0\n"), "not an OFF file: line 1 begins with \"OFFICE\"");
}

TEST(ReadOff, MissingVerticesAreNamedWithTheirLine) {
  const std::string vertices = "OFF\n3 1 0\n0 0 0\n2 0 0\n0 2 0\n";
  EXPECT_EQ(errorOf("a.off", vertices + "3 0 1 3\n"),
            "line 6: a face names vertex 3, but there are 3 vertices, numbered from 0");
  EXPECT_EQ(errorOf("a.off", vertices + "3 0 1 -1\n"),
            "line 6: a face names vertex -1, but vertices are numbered from 0");
  EXPECT_EQ(errorOf("a.off", vertices + "2 0 1\n"), "line 6: a face has 2 corners, and needs 3 at least");
}

}  // namespace
}  // namespace pdc
