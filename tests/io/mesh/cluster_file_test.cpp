#include "pdc/io/mesh/cluster_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <cstring>
#include <stdexcept>

#include "io/file/temporary_folder.h"
#include "pdc/io/mesh/mesh_reader.h"
#include "pdc/io/mesh/mesh_writer.h"
#include "simplify/shapes.h"

namespace pdc {
namespace {

using test::plate, test::sphere;

bool sameBytes(const Mesh& a, const Mesh& b) {
  return a.triangles == b.triangles && a.origin == b.origin && a.positions.size() == b.positions.size() &&
         std::memcmp(a.positions.data(), b.positions.data(), a.positions.size() * sizeof(Vec3f)) == 0;
}

/// Expects that the file gives what readMesh() and cluster() make of it.
void expectSame(const std::filesystem::path& path, double cell) {
  ClusterReport fromFile, fromMemory;
  const Mesh streamed = clusterFile(path, {.cell = cell}, &fromFile);
  const Mesh whole = cluster(readMesh(path), {.cell = cell}, &fromMemory);
  EXPECT_TRUE(sameBytes(streamed, whole)) << path;
  EXPECT_FALSE(streamed.triangles.empty());
  EXPECT_EQ(fromFile.trianglesBefore, fromMemory.trianglesBefore);
  EXPECT_EQ(fromFile.collapsedTriangles, fromMemory.collapsedTriangles);
}

template <typename Number>
void put(std::string& bytes, Number number, bool swap = false) {
  std::array<char, sizeof(Number)> raw;
  std::memcpy(raw.data(), &number, sizeof(number));
  if (swap) std::reverse(raw.begin(), raw.end());
  bytes.append(raw.data(), raw.size());
}

/// A binary .ply with big-endian doubles and columns and lists that nobody asked for.
std::string oddPly(const Mesh& mesh, const Vec3d& offset) {
  std::string bytes = "ply\nformat binary_big_endian 1.0\nelement camera 1\nproperty float f\nelement vertex " +
                      std::to_string(mesh.positions.size()) +
                      "\nproperty uchar red\nproperty double y\nproperty double x\nproperty double z\nelement face " +
                      std::to_string(mesh.triangles.size()) +
                      "\nproperty list uchar float texture\nproperty list uint ushort vertex_index\nproperty short s\n"
                      "end_header\n";
  constexpr bool kSwap = std::endian::native == std::endian::little;
  put(bytes, 1.5F, kSwap);
  for (const Vec3f& p : mesh.positions) {
    const Vec3d q = vecCast<double>(p) + offset;
    put(bytes, std::uint8_t{255});
    for (const double c : {q.y, q.x, q.z}) put(bytes, c, kSwap);
  }
  for (const Triangle& t : mesh.triangles) {
    put(bytes, std::uint8_t{2});
    put(bytes, 0.5F, kSwap);
    put(bytes, 0.25F, kSwap);
    put(bytes, std::uint32_t{3}, kSwap);
    for (const std::uint32_t v : t) put(bytes, static_cast<std::uint16_t>(v), kSwap);
    put(bytes, std::int16_t{-1}, kSwap);
  }
  return bytes;
}

std::string errorOf(const std::filesystem::path& path) {
  try {
    static_cast<void>(clusterFile(path, {.cell = 0.2}));
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(ClusterFile, GivesWhatTheMeshInMemoryGives) {
  const TemporaryFolder folder;
  Mesh ball = sphere(30);  // Several blocks.
  test::addNoise(ball, 0.005);
  ball.normals.resize(ball.positions.size(), {0, 0, 1});
  ball.origin = {100, 0, -50};
  for (const char* name : {"ball.ply", "ball.stl", "ball.obj", "ball.off"}) {
    writeMesh(ball, folder / name);
    expectSame(folder / name, 0.15);
  }
  for (const char* name : {"text.ply", "text.stl"}) {
    writeMesh(ball, folder / name, {.ascii = true});
    expectSame(folder / name, 0.15);
  }
}

TEST(ClusterFile, ReadsEveryKindOfBinaryPly) {
  const TemporaryFolder folder;
  const Mesh ball = sphere(20);
  writeContents(folder / "odd.ply", oddPly(ball, {0, 0, 0}));
  expectSame(folder / "odd.ply", 0.15);
  writeContents(folder / "far.ply", oddPly(ball, {5e6, -4e6, 0}));
  expectSame(folder / "far.ply", 0.15);
  EXPECT_NE(clusterFile(folder / "far.ply", {.cell = 0.15}).origin, (Vec3d{0, 0, 0}));
}

TEST(ClusterFile, SplitsQuadsAndPolygonsAsTheReaderDoes) {
  const TemporaryFolder folder;
  Mesh mesh = plate(20);
  mesh.quads = {{0, 40, 100, 60}, {0, 10, 1, 200}};
  mesh.polygons.add(std::vector<std::uint32_t>{0, 20, 440, 210, 420});
  writeMesh(mesh, folder / "own.ply");
  expectSame(folder / "own.ply", 0.17);
  // Without the comment that says who wrote it, concave quads are split along the other diagonal.
  std::string bytes = contentsOf(folder / "own.ply");
  const std::size_t comment = bytes.find("comment pdc\n");
  ASSERT_NE(comment, std::string::npos);
  writeContents(folder / "other.ply", bytes.erase(comment, 12));
  expectSame(folder / "other.ply", 0.17);
}

TEST(ClusterFile, WarnsAsTheReaderDoes) {
  const TemporaryFolder folder;
  writeMesh(plate(8), folder / "plate.ply");
  writeContents(folder / "longer.ply", contentsOf(folder / "plate.ply") + "more");
  std::vector<std::string> warnings;
  const auto warn = [&](const std::string& warning) { warnings.push_back(warning); };
  static_cast<void>(clusterFile(folder / "longer.ply", {.cell = 0.2}, nullptr, warn));
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("longer.ply: 4 bytes after the last element are not read"), std::string::npos);
  warnings.clear();
  writeContents(folder / "named.stl", contentsOf(folder / "plate.ply"));
  const Mesh named = clusterFile(folder / "named.stl", {.cell = 0.2}, nullptr, warn);
  EXPECT_EQ(warnings.size(), 1u);
  EXPECT_TRUE(sameBytes(named, clusterFile(folder / "plate.ply", {.cell = 0.2})));
}

TEST(ClusterFile, RefusesWhatIsWrongAndNamesTheFile) {
  const TemporaryFolder folder;
  writeMesh(plate(8), folder / "plate.ply");
  const std::string bytes = contentsOf(folder / "plate.ply");
  EXPECT_EQ(errorOf(folder / "plate.ply"), "");

  writeContents(folder / "cut.ply", bytes.substr(0, bytes.size() - 5));
  EXPECT_NE(errorOf(folder / "cut.ply").find("cut.ply: ends before the last"), std::string::npos);
  std::string wrong = bytes;
  wrong[wrong.size() - 2] = 1;  // The third byte of the last index.
  writeContents(folder / "wrong.ply", wrong);
  EXPECT_NE(errorOf(folder / "wrong.ply").find("wrong.ply: face 127 names vertex 65615, but there are 81"),
            std::string::npos)
      << errorOf(folder / "wrong.ply");
  wrong = bytes;
  wrong[wrong.size() - 13] = 2;
  writeContents(folder / "two.ply", wrong);
  EXPECT_NE(errorOf(folder / "two.ply").find("two.ply: face 127 has 2 corners"), std::string::npos);

  Mesh far = plate(8);
  far.positions[3].x = 1e30F;
  writeMesh(far, folder / "far.ply");
  writeMesh(far, folder / "far.obj");
  for (const char* name : {"far.ply", "far.obj"})
    EXPECT_NE(errorOf(folder / name).find(std::string(name) + ": the corner 1e+30"), std::string::npos);
  EXPECT_NE(errorOf(folder / "none.ply").find("none.ply: cannot be read"), std::string::npos);
  EXPECT_NE(errorOf(folder / "none.txt").find("none.txt"), std::string::npos);
  EXPECT_THROW(static_cast<void>(clusterFile(folder / "none.ply", {.cell = 0})), std::invalid_argument);
}

TEST(ClusterFile, StopsWhenAsked) {
  const TemporaryFolder folder;
  for (const char* name : {"ball.ply", "ball.stl", "ball.obj"}) {
    writeMesh(sphere(30), folder / name);
    std::atomic<bool> stop{false};
    const Monitor monitor{.progress = [&](const char*, double) { stop = true; }, .stop = &stop};
    EXPECT_THROW(static_cast<void>(clusterFile(folder / name, {.cell = 0.1}, nullptr, {}, monitor)), Cancelled);
  }
}

}  // namespace
}  // namespace pdc
