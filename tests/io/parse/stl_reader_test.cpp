#include "io/parse/stl_reader.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "io/mesh/read_text.h"

namespace pdc {
namespace {

const std::string kFacet =
    "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";
const std::string kOther =
    "facet normal 0 0 1\nouter loop\nvertex 1 0 0\nvertex 1 1 0\nvertex 0 1 0\nendloop\nendfacet\n";
const Buffer<Triangle> kOne{{0, 1, 2}}, kTwo{{0, 1, 2}, {1, 3, 2}};

std::string binaryFacet() {
  return std::string(12, '\0') + bytes(Vec3f{0, 0, 0}, Vec3f{1, 0, 0}, Vec3f{0, 1, 0}, std::uint16_t{0});
}

TEST(ReadStl, TextMayBeginWithBlanksAndHoldSeveralSolids) {
  EXPECT_EQ(readText("a.stl", " \n\t solid a\n" + kFacet + "endsolid a\n").triangles, kOne);
  EXPECT_EQ(readText("a.stl", "SOLID a\n" + kFacet + "endsolid a\nsolid b\n" + kOther + "endsolid b\n").triangles,
            kTwo);
  EXPECT_EQ(readText("a.stl", "solid facet\n" + kFacet + kOther + "endsolid").triangles, kTwo);
}

TEST(ReadStl, AFacetMayStandOnOneLine) {
  std::string line = "solid a\n" + kFacet + kOther;
  for (std::size_t i = 8; i < line.size(); ++i)
    if (line[i] == '\n') line[i] = ' ';
  EXPECT_EQ(readText("a.stl", line + "\nendsolid\n").triangles, kTwo);
}

TEST(ReadStl, WhatIsNotOfAnStlTextIsWarnedOf) {
  const std::string file = "solid a\ncolor 1 0 0\n" + kFacet + "endsolid a\nmore words\n";
  EXPECT_EQ(readText("a.stl", file).triangles, kOne);
  EXPECT_EQ(warningsOf("a.stl", file),
            std::vector<std::string>{"2 lines are not of an STL file and not read; the first is line 2"});
}

TEST(ReadStl, BytesAfterATextAreWarnedOf) {
  const std::string file = "solid a\n" + kFacet + "endsolid a\n%%\n" + std::string(3, '\0');
  EXPECT_EQ(readText("a.stl", file).triangles, kOne);
  EXPECT_EQ(warningsOf("a.stl", file),
            std::vector<std::string>{"1 lines are not of an STL file and not read; the first is line 10"});
}

TEST(ReadStl, TextThatEndsEarlyIsAnError) {
  EXPECT_EQ(errorOf("a.stl", "solid a\n" + kFacet), "ends after line 8 without endsolid");
  EXPECT_EQ(errorOf("a.stl", "solid a\n" + kFacet + "endsolid\n" + kFacet), "ends after line 16 without endsolid");
  EXPECT_EQ(errorOf("a.stl", "solid a\n" + kFacet + "endsolid\nvertex 1 2 3\n"), "ends after line 10 without endsolid");
}

TEST(ReadStl, BytesAfterABinaryFileAreWarnedOf) {
  for (const char* title : {"", "solid", "solid facet"}) {
    std::string file = title;
    file.resize(80, '\0');
    file += bytes(std::uint32_t{1}) + binaryFacet() + std::string(37, 'x');
    EXPECT_EQ(readText("a.stl", file).triangles, kOne);
    EXPECT_EQ(warningsOf("a.stl", file), std::vector<std::string>{"37 bytes after the last of 1 facets are not read"});
  }
}

TEST(ReadStl, FacetsBehindACountOfZeroAreAnError) {
  EXPECT_EQ(errorOf("a.stl", std::string(84, '\0') + binaryFacet()), "0 facets make 84 bytes, but the file has 134");
  EXPECT_TRUE(readText("a.stl", std::string(84, '\0')).empty());
  EXPECT_TRUE(readText("a.stl", "solid\nendsolid\n").empty());
}

}  // namespace
}  // namespace pdc
