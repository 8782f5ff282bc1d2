#include "pdc/io/mesh/mesh_reader.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "folders.h"
#include "io/file/temporary_folder.h"
#include "io/mesh/read_text.h"
#include "pdc/error.h"
#include "pdc/mesh/mesh_report.h"

namespace pdc {
namespace {

namespace fs = std::filesystem;

std::string swapped(std::string number) { return {number.rbegin(), number.rend()}; }

const std::string kPlyVertices = "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
const std::string kPlyFaces = "element face 1\nproperty list uchar int vertex_indices\n";

struct Figures {
  const char* name;
  std::size_t vertices, triangles, boundaryEdges, nonManifoldEdges, components, unusedVertices;
  long long eulerNumber;
  Vec3d extent;
};

void PrintTo(const Figures& f, std::ostream* out) { *out << f.name; }

/// Figures that another program found in the same files.
class ReadRealMesh : public testing::TestWithParam<Figures> {};

TEST_P(ReadRealMesh, HasTheFiguresOfTheManifest) {
  const Figures& f = GetParam();
  const fs::path path = test::dataFolder() / "mesh" / f.name;
  if (!fs::exists(path)) GTEST_SKIP() << path << " is not there";
  const MeshReport r = analyze(readMesh(path));
  EXPECT_EQ(r.vertices, f.vertices);
  EXPECT_EQ(r.triangles, f.triangles);
  EXPECT_EQ(r.quads, 0u);
  EXPECT_EQ(r.boundaryEdges, f.boundaryEdges);
  EXPECT_EQ(r.nonManifoldEdges, f.nonManifoldEdges);
  EXPECT_EQ(r.components, f.components);
  EXPECT_EQ(r.unusedVertices, f.unusedVertices);
  EXPECT_EQ(r.eulerNumber, f.eulerNumber);
  const Vec3d extent = r.bounds.hi - r.bounds.lo;
  for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(extent[axis], f.extent[axis], 1e-3 * f.extent[axis]);
}

INSTANTIATE_TEST_SUITE_P(
    Manifest, ReadRealMesh,
    testing::Values(Figures{"stanford_bun_zipper_res2.ply", 8171, 16301, 123, 150, 1, 25, 84, {0.1555, 0.1533, 0.1206}},
                    Figures{"wingnut_cad.obj", 3047, 6090, 0, 0, 1, 0, 2, {3.027, 4.275, 7.199}},
                    Figures{"plane_holes.obj", 8519, 16747, 341, 0, 1, 0, -25, {14.69, 13.29, 4.367}},
                    Figures{"cad_featuretype.stl", 2010, 3476, 576, 0, 1, 0, -16, {5.0, 2.5, 1.375}},
                    Figures{"cad_angle_block.stl", 398, 704, 166, 0, 1, 0, -37, {1.339, 1.0, 1.352}},
                    Figures{"cad_cycloidal_assembly.ply", 21384, 43368, 0, 242, 100, 0, -58, {1.875, 1.875, 1.107}},
                    Figures{"fandisk_13k.off", 6475, 12946, 0, 0, 1, 0, 2, {1.841, 2.0, 1.022}},
                    Figures{"cgal_joint.off", 221, 446, 0, 0, 1, 0, -2, {0.7501, 1.0, 0.9542}},
                    Figures{"cgal_elephant-with-holes.off", 2798, 4463, 1353, 0, 1, 0, -110, {0.7204, 1.0, 0.603}},
                    Figures{"bad_fan3.obj", 5, 3, 6, 1, 1, 0, 1, {6.0, 4.0, 5.151}},
                    Figures{"bad_degenerate.obj", 7, 24, 0, 6, 1, 0, 13, {2.0, 2.0, 2.0}}),
    [](const auto& parameter) {
      std::string name = parameter.param.name;
      for (char& c : name)
        if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
      return name;
    });

TEST(ReadMesh, GzipGivesWhatIsInIt) {
  const fs::path path = test::dataFolder() / "mesh" / "stanford_dragon_res3.ply.gz";
  if (!fs::exists(path)) GTEST_SKIP() << path << " is not there";
  const Mesh mesh = readMesh(path);
  EXPECT_EQ(mesh.positions.size(), 22998u);
  EXPECT_EQ(mesh.triangles.size(), 47794u);
  const TemporaryFolder folder;
  const std::string bytes = contentsOf(path);
  writeContents(folder / "cut.ply.gz", bytes.substr(0, bytes.size() / 2));
  EXPECT_THROW(static_cast<void>(readMesh(folder / "cut.ply.gz")), Error);
  writeContents(folder / "plain.ply.gz", "ply");
  EXPECT_THROW(static_cast<void>(readMesh(folder / "plain.ply.gz")), Error);
}

TEST(ReadMesh, PlyOfEitherByteOrderAndAnyType) {
  const std::string head =
      "element vertex 3\nproperty uchar red\nproperty double x\nproperty float y\nproperty short z\n"
      "element face 1\nproperty list ushort uint vertex_index\nproperty char flag\nend_header\n";
  std::string little, big;
  for (int i = 0; i < 3; ++i) {
    const auto red = std::uint8_t{200};
    const double x = 0.5 * i;
    const auto y = static_cast<float>(i * i);
    const auto z = static_cast<std::int16_t>(-i);
    little += bytes(red) + bytes(x) + bytes(y) + bytes(z);
    big += bytes(red) + swapped(bytes(x)) + swapped(bytes(y)) + swapped(bytes(z));
  }
  little += bytes(std::uint16_t{3}, std::uint32_t{2}, std::uint32_t{1}, std::uint32_t{0}, std::int8_t{-1});
  big += swapped(bytes(std::uint16_t{3}));
  for (const std::uint32_t v : {2u, 1u, 0u}) big += swapped(bytes(v));
  big += bytes(std::int8_t{-1});
  for (const Mesh& mesh : {readText("a.ply", "ply\nformat binary_little_endian 1.0\n" + head + little),
                           readText("a.ply", "ply\nformat binary_big_endian 1.0\n" + head + big)}) {
    ASSERT_EQ(mesh.positions.size(), 3u);
    EXPECT_EQ(mesh.positions[2], (Vec3f{1, 4, -2}));
    EXPECT_EQ(mesh.triangles, (Buffer<Triangle>{{2, 1, 0}}));
  }
}

TEST(ReadMesh, PlyWithOtherElementsListsCommentsAndCarriageReturns) {
  const Mesh mesh =
      readText("a.ply",
               "ply\r\nformat ascii 1.0\r\ncomment end_header\r\nobj_info element face 7\r\n"
               "element camera 2\r\nproperty list int float a\r\nproperty int b\r\n"
               "element vertex 4\r\nproperty list uchar uchar tags\r\nproperty float x\r\nproperty float y\r\n"
               "property float z\r\nproperty float nx\r\nproperty float ny\r\nproperty float nz\r\n"
               "element face 2\r\nproperty uchar red\r\nproperty list uchar int vertex_indices\r\n"
               "element rest 1\r\nproperty int c\r\nend_header\r\n"
               "2 0.5 0.5 1\r\n0 2\r\n"
               "0 0 0 0 0 0 1\r\n1 7 1 0 0 0 0 1\r\n2 7 7 1 1 0 0 0 1\r\n0 0 1 0 0 1 0\r\n"
               "255 4 0 1 2 3\r\n255 3 0 1 2\r\n9\r\n");
  EXPECT_EQ(mesh.quads, (Buffer<Quad>{{0, 1, 2, 3}}));
  EXPECT_EQ(mesh.triangles, (Buffer<Triangle>{{0, 1, 2}}));
  EXPECT_EQ(mesh.positions[2], (Vec3f{1, 1, 0}));
  ASSERT_EQ(mesh.normals.size(), 4u);
  EXPECT_EQ(mesh.normals[3], (Vec3f{0, 1, 0}));
}

TEST(ReadMesh, PlyWithFacesFirst) {
  const Mesh mesh = readText(
      "a.ply", "ply\nformat ascii 1.0\n" + kPlyFaces + kPlyVertices + "end_header\n3 0 1 2\n0 0 0\n1 0 0\n0 1 0\n");
  EXPECT_EQ(mesh.triangles.size(), 1u);
  EXPECT_EQ(mesh.positions.size(), 3u);
}

TEST(ReadMesh, ObjWithAllItsWaysToNameACorner) {
  const Mesh mesh =
      readText("a.obj",
               "# comment\nmtllib /dev/zero\no thing\nv 0 0 0\nv 1 0 0 1.0\nv +1 1e0 0 0.5 0.5 0.5\n\n"
               "v 0 1 0\nvt 0 0\nvn 0 0 1\nusemtl x\nf 1 2 3\nf 1/1 2/1 3/1 4/1\n\tf  1//1\t2//1 -1//-1 \r\n"
               "f 1/1/1 2/1/1 3/1/1 4/1/1 1/1/1 # five\nl 1 2\n");
  EXPECT_EQ(mesh.positions.size(), 4u);
  EXPECT_EQ(mesh.positions[2], (Vec3f{1, 1, 0}));
  EXPECT_EQ(mesh.quads, (Buffer<Quad>{{0, 1, 2, 3}}));
  EXPECT_EQ(mesh.triangles, (Buffer<Triangle>{{0, 1, 2}, {0, 1, 3}, {0, 1, 2}, {0, 2, 3}, {0, 3, 0}}));
  EXPECT_TRUE(mesh.normals.empty()) << "normals that are not the vertices' own";
}

TEST(ReadMesh, FacesOfManyCornersBecomeFansAfterTheOthersUnlessTheyAreKept) {
  const TemporaryFolder folder;
  writeContents(folder / "a.obj", "v 0 0 0\nv 1 0 0\nv 2 1 0\nv 1 2 0\nv 0 1 0\nf 1 2 3 4 5\nf 1 2 5\nf 2 3 4 5\n");
  writeContents(folder / "a.off", "OFF\n5 3 0\n0 0 0\n1 0 0\n2 1 0\n1 2 0\n0 1 0\n5 0 1 2 3 4\n3 0 1 4\n4 1 2 3 4\n");
  writeContents(folder / "a.ply",
                "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\n"
                "element face 3\nproperty list uchar int vertex_indices\nend_header\n"
                "0 0 0\n1 0 0\n2 1 0\n1 2 0\n0 1 0\n5 0 1 2 3 4\n3 0 1 4\n4 1 2 3 4\n");
  for (const char* name : {"a.obj", "a.off", "a.ply"}) {
    const Mesh fans = readMesh(folder / name);
    EXPECT_EQ(fans.triangles, (Buffer<Triangle>{{0, 1, 4}, {0, 1, 2}, {0, 2, 3}, {0, 3, 4}})) << name;
    EXPECT_TRUE(fans.polygons.empty()) << name;
    const Mesh kept = readMesh(folder / name, {.keepPolygons = true});
    EXPECT_EQ(kept.triangles, (Buffer<Triangle>{{0, 1, 4}})) << name;
    EXPECT_EQ(kept.polygons, (Polygons{.corners = {0, 1, 2, 3, 4}, .starts = {0}})) << name;
    for (const Mesh& mesh : {fans, kept}) EXPECT_EQ(mesh.quads, (Buffer<Quad>{{1, 2, 3, 4}})) << name;
  }
}

TEST(ReadMesh, OffWithCommentsColoursAndNormals) {
  const std::string faces = "4 0 1 2 3 255 0 0\n3 0 1 2\n";
  const Mesh plain = readText("a.off", "OFF # kind\n# counts\n4 2 0\n\n0 0 0\n1 0 0\n1 1 0 # third\n0 1 0\n" + faces);
  EXPECT_EQ(plain.quads, (Buffer<Quad>{{0, 1, 2, 3}}));
  EXPECT_EQ(plain.triangles, (Buffer<Triangle>{{0, 1, 2}}));
  const Mesh colours =
      readText("a.off", "COFF 4 2 0\n0 0 0 1 2 3 4\n1 0 0 1 2 3 4\n1 1 0 1 2 3 4\n0 1 0 1 2 3 4\n" + faces);
  EXPECT_EQ(colours.positions, plain.positions);
  const Mesh normals = readText("a.off", "NOFF\n4 2 0\n0 0 0 0 0 1\n1 0 0 0 0 1\n1 1 0 0 0 1\n0 1 0 0 1 0\n" + faces);
  EXPECT_EQ(normals.positions, plain.positions);
  ASSERT_EQ(normals.normals.size(), 4u);
  EXPECT_EQ(normals.normals[3], (Vec3f{0, 1, 0}));
}

std::string textStl(std::string_view corners) {
  return "solid name with endsolid\nfacet normal 0 0 1\nouter loop\n" + std::string(corners) +
         "endloop\nendfacet\nendsolid name\n";
}

TEST(ReadMesh, StlAsText) {
  const Mesh mesh = readText("a.stl", textStl("vertex 0 0 0\n  VERTEX 1 0 0\nvertex 0 1e-3 0\n"));
  EXPECT_EQ(mesh.positions, (Buffer<Vec3f>{{0, 0, 0}, {1, 0, 0}, {0, 1e-3f, 0}}));
  EXPECT_EQ(mesh.triangles, (Buffer<Triangle>{{0, 1, 2}}));
}

/// Binary, with a header that starts as that of a text.
std::string binaryStl(const std::vector<Vec3f>& corners) {
  std::string result = "solid";
  result.resize(80, ' ');
  result += bytes(static_cast<std::uint32_t>(corners.size() / 3));
  for (std::size_t i = 0; i < corners.size(); i += 3)
    result += bytes(Vec3f{0, 0, 0}, corners[i], corners[i + 1], corners[i + 2], std::uint16_t{0});
  return result;
}

TEST(ReadMesh, StlIsWeldedByExactPosition) {
  const float next = std::nextafter(1.0f, 2.0f), nan = std::numeric_limits<float>::quiet_NaN();
  const Mesh mesh = readText("a.stl", binaryStl({{0, 0, 0},
                                                 {1, 0, 0},
                                                 {0, 1, 0},  //
                                                 {1, -0.0f, 0},
                                                 {-0.0f, 0, 0},
                                                 {0, 0, 1},  //
                                                 {next, 0, 0},
                                                 {0, 1, 0},
                                                 {nan, 0, 0},  //
                                                 {nan, 0, 0},
                                                 {nan, 0, 0},
                                                 {5e-39f, 0, 0}}));
  EXPECT_EQ(mesh.triangles, (Buffer<Triangle>{{0, 1, 2}, {1, 0, 3}, {4, 2, 5}, {5, 5, 6}}));
  EXPECT_EQ(mesh.positions.size(), 7u);
  EXPECT_EQ(analyze(mesh).degenerateFaces, 1u);
}

TEST(ReadMesh, FacesThatNameAVertexTwiceArrive) {
  for (const Mesh& mesh : {readText("a.obj", "v 0 0 0\nv 1 0 0\nf 1 2 2\nf 1 1 1 2\n"),
                           readText("a.off", "OFF\n2 2 0\n0 0 0\n1 0 0\n3 0 1 1\n4 0 0 0 1\n"),
                           readText("a.ply",
                                    "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\n"
                                    "property float z\nelement face 2\nproperty list uchar int vertex_indices\n"
                                    "end_header\n0 0 0\n1 0 0\n3 0 1 1\n4 0 0 0 1\n")}) {
    EXPECT_EQ(mesh.triangles, (Buffer<Triangle>{{0, 1, 1}}));
    EXPECT_EQ(mesh.quads, (Buffer<Quad>{{0, 0, 0, 1}}));
  }
}

TEST(ReadMesh, FilesThatCannotBeReadAreErrors) {
  const TemporaryFolder folder;
  EXPECT_THROW(static_cast<void>(readMesh(folder / "missing.ply")), Error);
  EXPECT_THROW(static_cast<void>(readMesh(folder.path())), Error);
  fs::create_directory(folder / "folder.ply");
  EXPECT_THROW(static_cast<void>(readMesh(folder / "folder.ply")), Error);
  ASSERT_EQ(::mkfifo((folder / "pipe.ply").c_str(), 0600), 0);
  EXPECT_THROW(static_cast<void>(readMesh(folder / "pipe.ply")), Error);
  for (const char* name : {"a.ply", "a.obj", "a.off", "a.stl"}) EXPECT_EQ(errorOf(name, ""), "the file is empty");
  EXPECT_EQ(errorOf("a.ply.gz", "x"), "the compressed data ends early");
}

TEST(ReadMesh, DamagedPlyIsAnError) {
  const std::string head = "ply\nformat ascii 1.0\n", end = "end_header\n";
  const std::string vertices = "0 0 0\n1 0 0\n0 1 0\n";
  EXPECT_EQ(errorOf("a.ply", "pl\n"), "not a PLY file");
  EXPECT_EQ(errorOf("a.ply", head + kPlyVertices), "a PLY header without end_header");
  EXPECT_EQ(errorOf("a.ply", "ply\nformat text 1.0\n"), "line 2: malformed format \"format text 1.0\"");
  EXPECT_EQ(errorOf("a.ply", "ply\n" + kPlyVertices + end + vertices), "a PLY header without format");
  EXPECT_EQ(errorOf("a.ply", head + "property float x\n" + end),
            "line 3: malformed property, which belongs to no element: \"property float x\"");
  EXPECT_EQ(errorOf("a.ply", head + "element vertex x\n" + end), "line 3: malformed element \"element vertex x\"");
  EXPECT_EQ(errorOf("a.ply", head + "element vertex 1\nproperty vec3 x\n" + end + "1\n"),
            "line 4: malformed property \"property vec3 x\"");
  EXPECT_EQ(errorOf("a.ply", head + "element vertex 1\nproperty float x\n" + end + "1\n"),
            "PLY vertices need x, y and z, each once");
  EXPECT_EQ(errorOf("a.ply", head + kPlyVertices + kPlyVertices + end + vertices + vertices),
            "a PLY file with two elements named vertex");
  EXPECT_EQ(errorOf("a.ply", head + kPlyVertices + "property uchar red\n" + end + "0 0 0 255\n0 0 0 256\n0 0 0 1\n"),
            "vertex 1: \"red\" is 256, which is no uchar");
  EXPECT_EQ(errorOf("a.ply", head + kPlyVertices + "property int k\n" + end + "0 0 0 0.5\n0 0 0 0\n0 0 0 0\n"),
            "vertex 0: \"k\" is 0.5, which is no int");
  EXPECT_EQ(errorOf("a.ply", head + "element vertex 4000000000\n" + end + "1\n"),
            "PLY element vertex has no properties");
  EXPECT_EQ(errorOf("a.ply", head + kPlyVertices + kPlyFaces + end + vertices + "3 0 1 3\n"),
            "line 13: a face names vertex 3, but there are 3 vertices, numbered from 0");
  EXPECT_EQ(errorOf("a.ply", head + kPlyVertices + kPlyFaces + end + vertices + "3 0 1 -1\n"),
            "line 13: a face names vertex -1, but vertices are numbered from 0");
  EXPECT_EQ(errorOf("a.ply", head + kPlyVertices + kPlyFaces + end + vertices + "2 0 1\n"),
            "line 13: a face has 2 corners, and needs 3 at least");
  EXPECT_EQ(errorOf("a.ply", head + kPlyVertices + kPlyFaces + end + vertices + "3 0 x 1\n"),
            "line 13: \"x\" is not a number");
  EXPECT_EQ(errorOf("a.ply", head + kPlyVertices + kPlyFaces + end + vertices + "3 0 1\n"),
            "ends before the last of the elements announced in its header");
}

TEST(ReadMesh, CountsThatLieAreErrorsAtOnce) {
  const std::string many = "element vertex 1000000000\nproperty float x\nproperty float y\nproperty float z\n";
  EXPECT_EQ(errorOf("a.ply", "ply\nformat binary_little_endian 1.0\n" + many + "end_header\n" + std::string(100, ' ')),
            "1000000000 elements of kind vertex are announced, but only 100 bytes follow the header");
  EXPECT_NE(errorOf("a.ply", "ply\nformat binary_little_endian 1.0\n" + kPlyVertices +
                                 "element face 1\nproperty list uint int vertex_indices\nend_header\n" +
                                 std::string(36, '\0') + "\xff\xff\xff\xff" + std::string(8, '\0')),
            "");
  EXPECT_EQ(errorOf("a.off", "OFF\n1000000000 1000000000 0\n0 0 0\n"),
            "1000000000 vertices and 1000000000 faces announced in 34 bytes");
  std::string stl(80, ' ');
  stl += bytes(std::uint32_t{1'000'000'000}) + std::string(50, '\0');
  EXPECT_EQ(errorOf("a.stl", stl), "1000000000 facets make 50000000084 bytes, but the file has 134");
}

TEST(ReadMesh, DamagedTextIsAnErrorWithItsLine) {
  EXPECT_EQ(errorOf("a.obj", "v 0 0 0\nv 1 0\n"), "line 2: malformed vertex \"v 1 0\"");
  EXPECT_EQ(errorOf("a.obj", "v 0 0 0\nf 1 1 /1\n"), "line 2: malformed face \"f 1 1 /1\"");
  EXPECT_EQ(errorOf("a.obj", "v 0 0 0\nf 1 1 0\n"), "line 2: malformed face \"f 1 1 0\"");
  EXPECT_EQ(errorOf("a.obj", "v 0 0 0\nf 1 1 -2\n"), "line 2: a face names number -2, but only 1 come before it");
  EXPECT_EQ(errorOf("a.obj", "v 0 0 0\nf 1 1 2\n"),
            "line 2: a face names vertex 2, but there are 1 vertices, numbered from 1");
  EXPECT_EQ(errorOf("a.off", "OFF\n2 0 0\n0 0 0\n"), "ends after line 3; 2 vertices and 0 faces were announced");
  EXPECT_EQ(errorOf("a.off", "OFF\n1 1 0\n0 0 0\n3 0 0\n"), "line 4: malformed face \"3 0 0\"");
  EXPECT_EQ(errorOf("a.off", "OFF\n1 0 0\n0 0 x\n"), "line 3: malformed vertex \"0 0 x\"");
  EXPECT_EQ(errorOf("a.off", "OFF\n1 0 0\n0 0 0\n3 0 0 0\n"),
            "line 4: malformed end: more lines than vertices and faces \"3 0 0 0\"");
  EXPECT_EQ(errorOf("a.off", "4OFF\n1 0 0\n0 0 0 0\n"), "line 3: malformed homogeneous vertex \"0 0 0 0\"");
  EXPECT_EQ(errorOf("a.off", "OFF BINARY\n1 0 0\n"), "binary OFF is not read, only OFF as text");
  EXPECT_EQ(errorOf("a.stl", textStl("vertex 0 0 0\nvertex 1 0 0\n")), "line 7: a facet that is not a triangle");
  EXPECT_EQ(errorOf("a.stl", textStl("vertex 0 0 0\nvertex 1 0 0\nvertex 1 0\n")),
            "line 6: malformed vertex \"vertex 1 0\"");
  EXPECT_EQ(errorOf("a.stl", "solid\nfacet normal 0 0 1\nouter loop\n"), "ends after line 3 without endsolid");
  EXPECT_NE(errorOf("a.stl", "something else"), "");
}

}  // namespace
}  // namespace pdc
