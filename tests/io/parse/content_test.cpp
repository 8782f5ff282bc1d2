#include "io/parse/content.h"

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "io/mesh/read_text.h"

namespace pdc {
namespace {

using namespace std::string_literals;

const std::string kObj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
const std::string kOff = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
const std::string kPly =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
const std::string kStl =
    "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid\n";
const std::string kBinaryStl = std::string(80, ' ') + bytes(std::uint32_t{1}) + std::string(12, '\0') +
                               bytes(Vec3f{0, 0, 0}, Vec3f{1, 0, 0}, Vec3f{0, 1, 0}, std::uint16_t{0});

TEST(Content, OfAnotherSuffixIsReadAsWhatItIs) {
  const std::array<std::string, 4> suffixes{".obj", ".off", ".ply", ".stl"};
  const std::array<std::string, 4> names{"an OBJ file", "an OFF file", "a PLY file", "an STL file"};
  const std::vector<std::pair<std::string, std::size_t>> contents{
      {kObj, 0}, {kOff, 1}, {kPly, 2}, {kStl, 3}, {kBinaryStl, 3}};
  for (const auto& [content, kind] : contents)
    for (std::size_t i = 0; i < suffixes.size(); ++i) {
      std::vector<std::string> warnings, expected;
      const Mesh mesh = readText("a" + suffixes[i], content, &warnings);
      EXPECT_EQ(mesh.triangles, (Buffer<Triangle>{{0, 1, 2}}));
      EXPECT_EQ(mesh.positions, (Buffer<Vec3f>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
      if (i != kind)
        expected.push_back(names[i] + " by its suffix, but " + names[kind] + " by its content, and read as that");
      EXPECT_EQ(warnings, expected);
    }
}

TEST(Content, OfOtherKindsIsNamed) {
  const std::vector<std::pair<std::string, std::string>> files{
      {"<!DOCTYPE html><html><body>404: Not Found</body></html>", "an HTML page"},
      {"\n  <HTML><p>", "an HTML page"},
      {"<?xml version=\"1.0\"?><amf/>", "XML"},
      {"{\"asset\": {\"version\": \"2.0\"}}", "JSON, as glTF is"},
      {"\x89PNG\r\n\x1A\n\0\0\0\rIHDR"s, "a PNG picture"},
      {"\x1F\x8B\x08\0\0\0\0\0"s, "gzip, which is to be unpacked first"},
      {"PK\x03\x04\x14\0\0\0"s, "zip, as 3MF and other archives are"},
      {"glTF\x02\0\0\0"s, "binary glTF"},
      {"ISO-10303-21;\nHEADER;\n", "STEP"},
      {" BDV\0\0\0\0\xE0\0\0\0"s, "a VDB grid"},
      {"# vtk DataFile Version 3.0\nv\n", "VTK"},
      {"version https://git-lfs.github.com/spec/v1\n", "a Git LFS pointer, whose file was not fetched"},
      {"\xFF\xFEv\0 \0001\0"s, "UTF-16 text, which is to be saved as UTF-8"},
      {"v\0 \0001\0 \0002\0 \0003\0\n\0"s, "UTF-16 text, which is to be saved as UTF-8"},
      {"\0v\0 \0001\0 \0002\0 \0003\0\n"s, "UTF-16 text, which is to be saved as UTF-8"},
  };
  for (const auto& [content, name] : files) {
    EXPECT_EQ(errorOf("a.obj", content), "not an OBJ file: it seems to be " + name);
    EXPECT_EQ(errorOf("a.off", content), "not an OFF file: it seems to be " + name);
    EXPECT_EQ(errorOf("a.ply", content), "not a PLY file: it seems to be " + name);
    EXPECT_EQ(errorOf("a.stl", content), "not an STL file: it seems to be " + name);
  }
}

TEST(Content, ThatNobodyKnowsIsAnError) {
  EXPECT_EQ(errorOf("a.obj", "Dear reader,\nthis is a letter.\n"), "not an OBJ file: line 1 begins with \"Dear\"");
  EXPECT_EQ(errorOf("a.obj", " \n\n"), "not an OBJ file: it is blank");
  EXPECT_EQ(errorOf("a.obj", "ab\0cd"s), "not an OBJ file: it is binary");
  EXPECT_EQ(errorOf("a.off", "# a letter\nDear reader\n"), "not an OFF file: line 2 begins with \"Dear\"");
  EXPECT_EQ(errorOf("a.ply", "plywood\n"), "not a PLY file");
  EXPECT_EQ(errorOf("a.stl", "Dear reader,\nthis is a letter.\n"),
            "not an STL file: a text without lines that begin with solid and facet");
  EXPECT_EQ(errorOf("a.stl", "solid as a rock\n"),
            "not an STL file: a text without lines that begin with solid and facet");
}

TEST(Content, ByteOrderMarksAreSkipped) {
  for (const auto& [name, content] : {std::pair{"a.obj", kObj}, {"a.off", kOff}, {"a.ply", kPly}, {"a.stl", kStl}}) {
    const Mesh mesh = readText(name, "\xEF\xBB\xBF" + content);
    EXPECT_EQ(mesh.positions.size(), 3u) << name;
    EXPECT_EQ(mesh.triangles.size(), 1u) << name;
  }
  std::string marked = kBinaryStl;
  marked.replace(0, 3, "\xEF\xBB\xBF");
  EXPECT_EQ(readText("a.stl", marked).triangles.size(), 1u);
}

TEST(Content, LinesMayEndWithReturns) {
  for (const char* end : {"\r", "\r\n"})
    for (const auto& [name, content] : {std::pair{"a.obj", kObj}, {"a.off", kOff}, {"a.ply", kPly}, {"a.stl", kStl}}) {
      std::string text;
      for (const char c : content) c == '\n' ? text += end : text += c;
      const Mesh mesh = readText(name, text);
      EXPECT_EQ(mesh.positions.size(), 3u) << name;
      EXPECT_EQ(mesh.triangles.size(), 1u) << name;
    }
}

}  // namespace
}  // namespace pdc
