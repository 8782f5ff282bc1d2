#include "pdc/io/mesh/mesh_writer.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "io/file/temporary_folder.h"
#include "io/mesh/ply_writer.h"
#include "pdc/error.h"
#include "pdc/io/mesh/mesh_reader.h"
#include "pdc/mesh/triangulate_polygons.h"

namespace pdc {
namespace {

namespace fs = std::filesystem;

struct FloatTraits : OpenMesh::DefaultTraits {};
using PolyMesh = OpenMesh::PolyMesh_ArrayKernelT<FloatTraits>;

Mesh tinyMesh() {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1.5f, 0}, {0, 1, 0}, {0.1f, -0.0f, 1e-20f}};
  mesh.quads = {{0, 1, 2, 3}};
  mesh.triangles = {{1, 0, 4}};
  return mesh;
}

std::uint32_t bitsOf(float v) { return std::bit_cast<std::uint32_t>(v); }

/// Any finite float: denormals, both zeros, the largest.
float anyFloat(std::mt19937& random) {
  for (;;) {
    const auto v = std::bit_cast<float>(static_cast<std::uint32_t>(random()));
    if (std::isfinite(v)) return v;
  }
}

/// A closed strip of quads, one of each four of them as two triangles, at random places.
Mesh randomMesh(std::uint32_t columns, std::uint32_t rows, bool normals) {
  std::mt19937 random(12345);
  Mesh mesh;
  for (std::uint32_t i = 0; i < columns * (rows + 1); ++i) {
    mesh.positions.push_back({anyFloat(random), anyFloat(random), anyFloat(random)});
    if (normals) mesh.normals.push_back({anyFloat(random), anyFloat(random), anyFloat(random)});
  }
  mesh.positions[0] = {-0.0f, std::numeric_limits<float>::denorm_min(), std::numeric_limits<float>::max()};
  mesh.positions[1] = {std::numeric_limits<float>::min(), -std::numeric_limits<float>::max(), 0.1f};
  const auto at = [&](std::uint32_t column, std::uint32_t row) { return row * columns + column % columns; };
  for (std::uint32_t r = 0; r < rows; ++r)
    for (std::uint32_t c = 0; c < columns; ++c) {
      const Quad q{at(c, r), at(c + 1, r), at(c + 1, r + 1), at(c, r + 1)};
      if (c % 4 != 0) {
        mesh.quads.push_back(q);
      } else {
        mesh.triangles.push_back({q[0], q[1], q[2]});
        mesh.triangles.push_back({q[0], q[2], q[3]});
      }
    }
  return mesh;
}

void expectSameBits(const Buffer<Vec3f>& a, const Buffer<Vec3f>& b) {
  ASSERT_EQ(a.size(), b.size());
  std::size_t different = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (int k = 0; k < 3; ++k) different += bitsOf(a[i][k]) != bitsOf(b[i][k]);
  EXPECT_EQ(different, 0u);
}

/// Writes, reads back with OpenMesh, and compares bit by bit.
void expectOpenMeshReadsBack(const std::string& name, const MeshWriteOptions& options, bool normals) {
  SCOPED_TRACE(name);
  const TemporaryFolder folder;
  const Mesh mesh = randomMesh(17, 9, normals);
  writeMesh(mesh, folder / name, options);

  PolyMesh read;
  if (normals) read.request_vertex_normals();
  OpenMesh::IO::Options wanted = normals ? OpenMesh::IO::Options::VertexNormal : OpenMesh::IO::Options::Default;
  ASSERT_TRUE(OpenMesh::IO::read_mesh(read, (folder / name).string(), wanted));
  ASSERT_EQ(read.n_vertices(), mesh.positions.size());
  ASSERT_EQ(read.n_faces(), mesh.quads.size() + mesh.triangles.size());
  std::size_t different = 0, quads = 0;
  for (const auto v : read.vertices())
    for (unsigned k = 0; k < 3; ++k) {
      const auto i = static_cast<std::size_t>(v.idx());
      different += bitsOf(read.point(v)[k]) != bitsOf(mesh.positions[i][static_cast<int>(k)]);
      if (normals) different += bitsOf(read.normal(v)[k]) != bitsOf(mesh.normals[i][static_cast<int>(k)]);
    }
  EXPECT_EQ(different, 0u);
  for (const auto f : read.faces()) quads += read.valence(f) == 4;
  EXPECT_EQ(quads, mesh.quads.size());
  const auto first = read.fv_range(PolyMesh::FaceHandle(0)).to_vector();
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_TRUE(std::any_of(first.begin(), first.end(),
                            [&](const auto v) { return v.idx() == static_cast<int>(mesh.quads[0][k]); }));
}

TEST(WriteMesh, BinaryPlyByteForByte) {
  const TemporaryFolder folder;
  const std::size_t size = writeMesh(tinyMesh(), folder / "a.ply");
  std::string expected =
      "ply\nformat binary_little_endian 1.0\ncomment pdc\n"
      "element vertex 5\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 2\nproperty list uchar int vertex_indices\nend_header\n";
  const auto append = [&](const auto& value) { expected.append(reinterpret_cast<const char*>(&value), sizeof(value)); };
  for (const Vec3f& p : tinyMesh().positions) append(p);
  append(std::uint8_t{4});
  for (const std::int32_t v : {0, 1, 2, 3}) append(v);
  append(std::uint8_t{3});
  for (const std::int32_t v : {1, 0, 4}) append(v);
  EXPECT_EQ(contentsOf(folder / "a.ply"), expected);
  EXPECT_EQ(size, expected.size());
}

TEST(WriteMesh, TextPlyByteForByte) {
  const TemporaryFolder folder;
  Mesh mesh = tinyMesh();
  mesh.normals.assign(5, {0, 0, 1});
  writeMesh(mesh, folder / "a.ply", {.ascii = true});
  EXPECT_EQ(contentsOf(folder / "a.ply"),
            "ply\nformat ascii 1.0\ncomment pdc\n"
            "element vertex 5\nproperty float x\nproperty float y\nproperty float z\n"
            "property float nx\nproperty float ny\nproperty float nz\n"
            "element face 2\nproperty list uchar int vertex_indices\nend_header\n"
            "0 0 0 0 0 1\n1 0 0 0 0 1\n1 1.5 0 0 0 1\n0 1 0 0 0 1\n0.1 -0 1e-20 0 0 1\n"
            "4 0 1 2 3\n3 1 0 4\n");
}

TEST(WriteMesh, ObjByteForByte) {
  const TemporaryFolder folder;
  writeMesh(tinyMesh(), folder / "a.obj");
  EXPECT_EQ(contentsOf(folder / "a.obj"),
            "# pdc\nv 0 0 0\nv 1 0 0\nv 1 1.5 0\nv 0 1 0\nv 0.1 -0 1e-20\nf 1 2 3 4\nf 2 1 5\n");
}

TEST(WriteMesh, ObjWithNormalsByteForByte) {
  const TemporaryFolder folder;
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.normals = {{0, 0, 1}, {0, 0, 1}, {0, 0.6f, 0.8f}};
  mesh.triangles = {{0, 1, 2}};
  writeMesh(mesh, folder / "a.obj");
  EXPECT_EQ(contentsOf(folder / "a.obj"),
            "# pdc\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nvn 0 0 1\nvn 0 0.6 0.8\nf 1//1 2//2 3//3\n");
}

TEST(WriteMesh, OpenMeshReadsTheSameFloatsAndFaces) {
  expectOpenMeshReadsBack("a.ply", {}, false);
  expectOpenMeshReadsBack("a.ply", {}, true);
  expectOpenMeshReadsBack("a.ply", {.ascii = true}, true);
  expectOpenMeshReadsBack("a.obj", {}, false);
  expectOpenMeshReadsBack("a.obj", {}, true);
  expectOpenMeshReadsBack("a.off", {}, false);
}

TEST(WriteMesh, OurReaderReadsTheSame) {
  const TemporaryFolder folder;
  const Mesh mesh = randomMesh(40, 30, true);
  for (const char* name : {"a.ply", "a.obj", "a.off"}) {
    for (const bool ascii : {false, true}) {
      SCOPED_TRACE(name);
      writeMesh(mesh, folder / name, {.ascii = ascii});
      const Mesh read = readMesh(folder / name);
      expectSameBits(read.positions, mesh.positions);
      if (name != std::string("a.off")) expectSameBits(read.normals, mesh.normals);
      EXPECT_EQ(read.quads, mesh.quads);
      EXPECT_EQ(read.triangles, mesh.triangles);
    }
  }
}

TEST(WriteMesh, NonFiniteFloatsComeBack) {
  const TemporaryFolder folder;
  Mesh mesh = tinyMesh();
  mesh.positions[2] = {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                       -std::numeric_limits<float>::infinity()};
  for (const char* name : {"a.ply", "a.obj", "a.off"}) {
    writeMesh(mesh, folder / name, {.ascii = true});
    const Vec3f p = readMesh(folder / name).positions[2];
    EXPECT_TRUE(std::isnan(p.x)) << name;
    EXPECT_EQ(p.y, std::numeric_limits<float>::infinity()) << name;
    EXPECT_EQ(p.z, -std::numeric_limits<float>::infinity()) << name;
  }
}

TEST(WriteMesh, StlAsTrianglesAlongTheDiagonal) {
  const TemporaryFolder folder;
  for (const bool ascii : {false, true}) {
    const std::size_t size = writeMesh(tinyMesh(), folder / "a.stl", {.ascii = ascii});
    const std::string bytes = contentsOf(folder / "a.stl");
    EXPECT_EQ(bytes.size(), size);
    EXPECT_EQ(bytes.starts_with("solid"), ascii);
    EXPECT_TRUE(ascii || size == 84 + 3 * 50);
    const Mesh read = readMesh(folder / "a.stl");
    EXPECT_TRUE(read.quads.empty());
    EXPECT_EQ(read.triangles, (Buffer<Triangle>{{0, 1, 2}, {0, 2, 3}, {1, 0, 4}}));
    EXPECT_EQ(read.positions.size(), 5u);
    EXPECT_EQ(read.positions[2], (Vec3f{1, 1.5f, 0}));
  }
}

TEST(WriteMesh, StlNormals) {
  const TemporaryFolder folder;
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {2, 0, 0}, {0, 0, 3}, {1, 0, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 1, 3}};
  writeMesh(mesh, folder / "a.stl");
  const std::string bytes = contentsOf(folder / "a.stl");
  Vec3f normal;
  std::memcpy(&normal, bytes.data() + 84, sizeof(normal));
  EXPECT_EQ(normal, (Vec3f{0, -1, 0}));
  std::memcpy(&normal, bytes.data() + 134, sizeof(normal));
  EXPECT_EQ(normal, (Vec3f{0, 0, 0})) << "a triangle without area";
}

TEST(WriteMesh, NonManifoldMeshGoesThroughOpenMesh) {
  const TemporaryFolder folder;
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {-1, 1, 0}, {-1, -1, 0}};
  mesh.triangles = {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}, {0, 1, 4}};
  for (const char* name : {"a.off", "a.stl"}) {
    writeMesh(mesh, folder / name);
    EXPECT_EQ(readMesh(folder / name).triangles.size(), 4u) << name;
  }
  EXPECT_EQ(contentsOf(folder / "a.off"),
            "OFF\n5 4 0\n0 0 0\n0 0 1\n1 0 0\n-1 1 0\n-1 -1 0\n3 0 1 2 \n3 1 0 3 \n3 0 1 4 \n3 0 1 4 \n");
}

/// Polygons of 5 to 304 corners beside quads and triangles.
Mesh meshWithPolygons(std::uint32_t polygons) {
  Mesh mesh = randomMesh(40, 30, false);
  const auto vertices = static_cast<std::uint32_t>(mesh.positions.size());
  for (std::uint32_t i = 0; i < polygons; ++i) {
    std::vector<std::uint32_t> corners;
    for (std::uint32_t k = 0; k < 5 + i; ++k) corners.push_back((7 * i + k) % vertices);
    mesh.polygons.add(corners);
  }
  return mesh;
}

TEST(WriteMesh, PolygonsComeBack) {
  const TemporaryFolder folder;
  for (const std::uint32_t polygons : {3u, 251u, 252u, 300u})  // The last but one has 255 and 256 corners.
    for (const char* name : {"a.ply", "a.obj", "a.off"})
      for (const bool ascii : {false, true}) {
        SCOPED_TRACE(testing::Message() << name << " " << polygons);
        const Mesh mesh = meshWithPolygons(polygons);
        writeMesh(mesh, folder / name, {.ascii = ascii});
        const Mesh read = readMesh(folder / name, {.keepPolygons = true});
        expectSameBits(read.positions, mesh.positions);
        EXPECT_EQ(read.quads, mesh.quads);
        EXPECT_EQ(read.triangles, mesh.triangles);
        EXPECT_EQ(read.polygons, mesh.polygons);
      }
}

TEST(WriteMesh, CountsOfCornersAreBytesAsLongAsTheyFit) {
  const TemporaryFolder folder;
  writeMesh(meshWithPolygons(251), folder / "a.ply");
  EXPECT_NE(contentsOf(folder / "a.ply").find("property list uchar int vertex_indices"), std::string::npos);
  writeMesh(meshWithPolygons(252), folder / "a.ply");
  EXPECT_NE(contentsOf(folder / "a.ply").find("property list uint int vertex_indices"), std::string::npos);
}

TEST(WriteMesh, PolygonsAreTrianglesInStl) {
  const TemporaryFolder folder;
  Mesh mesh = tinyMesh();
  mesh.polygons.add(std::vector<std::uint32_t>{0, 1, 2, 3, 4});
  writeMesh(mesh, folder / "a.stl");
  EXPECT_EQ(readMesh(folder / "a.stl").triangles,
            (Buffer<Triangle>{{0, 1, 2}, {0, 2, 3}, {1, 0, 4}, {4, 0, 1}, {4, 1, 2}, {2, 3, 4}}))
      << "its last corner lies on its first edge";
}

/// All suffixes but those that only compress another's.
constexpr const char* kAllNames[] = {"a.ply", "a.obj", "a.off", "a.stl", "a.glb", "a.3mf", "a.vtp", "a.ply.gz"};

TEST(WriteMesh, PolygonsAreTrianglesInGlbAnd3mf) {
  const TemporaryFolder folder;
  Mesh mesh = tinyMesh();
  mesh.polygons.add(std::vector<std::uint32_t>{0, 1, 2, 3, 4});
  Mesh triangles = mesh;
  triangulatePolygons(triangles);
  for (const char* name : {"a.glb", "a.3mf"}) {
    writeMesh(mesh, folder / name);
    const std::string bytes = contentsOf(folder / name);
    writeMesh(triangles, folder / name);
    EXPECT_EQ(bytes, contentsOf(folder / name)) << name;
  }
}

TEST(WriteMesh, EmptyMesh) {
  const TemporaryFolder folder;
  for (const char* name : kAllNames) EXPECT_GT(writeMesh(Mesh{}, folder / name), 0u) << name;
  for (const char* name : {"a.ply", "a.obj", "a.off", "a.stl"}) {
    writeMesh(Mesh{}, folder / name);
    EXPECT_TRUE(readMesh(folder / name).empty()) << name;
  }
}

/// Large enough for several chunks of vertices and of quads.
TEST(WriteMesh, SameBytesForAnyNumberOfThreads) {
  const TemporaryFolder folder;
  const Mesh mesh = randomMesh(250, 250, true);
  const auto all = [&] {
    writeMesh(mesh, folder / "text.ply", {.ascii = true});
    std::string bytes;
    for (const char* name : kAllNames) {
      writeMesh(mesh, folder / name);
      bytes += contentsOf(folder / name);
    }
    return bytes + contentsOf(folder / "text.ply");
  };
  const std::string expected = all();
  EXPECT_GT(expected.size(), 10u << 20);
  for (const std::size_t threads : {1u, 2u, 8u}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    EXPECT_TRUE(all() == expected) << threads << " threads";
  }
}

TEST(WriteMesh, FullDeviceIsAnErrorInEachFormat) {
  const TemporaryFolder folder;
  const Mesh mesh = randomMesh(100, 100, true);
  for (const char* name : kAllNames) {
    fs::create_symlink("/dev/full", folder / name);
    try {
      writeMesh(mesh, folder / name);
      ADD_FAILURE() << name << ": no error";
    } catch (const Error& error) {
      EXPECT_EQ(error.what(), (folder / name).string() + ": cannot be written: No space left on device");
    }
    EXPECT_TRUE(fs::is_symlink(folder / name));
  }
  EXPECT_EQ(folder.entries(), std::size(kAllNames));
}

TEST(WriteMesh, MistakesOfTheCaller) {
  const TemporaryFolder folder;
  Mesh mesh = tinyMesh();
  EXPECT_THROW(writeMesh(mesh, folder / "a.xyz"), Error);
  EXPECT_THROW(writeMesh(mesh, folder / "a"), Error);
  EXPECT_THROW(writeMesh(mesh, folder / "missing/a.ply"), Error);
  mesh.normals.resize(3);
  EXPECT_THROW(writeMesh(mesh, folder / "a.ply"), std::invalid_argument);
  mesh.normals.clear();
  mesh.properties = {{"confidence", 1, Buffer<float>(4)}};
  for (const char* name : kAllNames) EXPECT_THROW(writeMesh(mesh, folder / name), std::invalid_argument) << name;
  mesh.properties.clear();
  mesh.quads[0][2] = 5;
  for (const char* name : kAllNames) EXPECT_THROW(writeMesh(mesh, folder / name), Error) << name;
  EXPECT_EQ(folder.entries(), 0u);
}

TEST(CheckMeshPath, KnowsSuffixesAndFolders) {
  const TemporaryFolder folder;
  for (const char* name : {"a.ply", "a.OBJ", "a.Stl", "a.off", "a b.c.ply", "a.glb", "a.3mf", "a.vtp", "a.STL.gz"})
    EXPECT_NO_THROW(checkMeshPath(folder / name));
  for (const char* name : {"a.txt", "a", "", ".ply", "missing/a.ply", "a.glb.gz", "a.gz"})
    EXPECT_THROW(checkMeshPath(folder / name), Error);
  EXPECT_THROW(checkMeshPath(""), Error);
  EXPECT_EQ(folder.entries(), 0u);
  fs::create_directory(folder / "folder.ply");
  EXPECT_THROW(checkMeshPath(folder / "folder.ply"), Error);
}

TEST(PlyIndexType, IntAsLongAsItHoldsThem) {
  constexpr std::size_t kLimit = std::size_t{1} << 31;
  EXPECT_STREQ(detail::plyIndexType(0), "int");
  EXPECT_STREQ(detail::plyIndexType(kLimit), "int");
  EXPECT_STREQ(detail::plyIndexType(kLimit + 1), "uint");
}

}  // namespace
}  // namespace pdc
