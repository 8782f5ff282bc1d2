// Meshes far from the origin of the world, written and read back.

#include <gtest/gtest.h>

#include <filesystem>
#include <stdexcept>
#include <string>

#include "io/file/temporary_folder.h"
#include "pdc/io/mesh/mesh_reader.h"
#include "pdc/io/mesh/mesh_writer.h"

namespace pdc {
namespace {

/// A triangle five thousand kilometres away.
Mesh farTriangle() {
  Mesh mesh;
  mesh.origin = {5000000.5, -0.5, 0};
  mesh.positions = {{0.001F, 0, 0}, {1, 0.5F, 0}, {0, 1, 0.25F}};
  mesh.triangles = {{0, 1, 2}};
  return mesh;
}

TEST(WriteMesh, DoublesAreWorldCoordinates) {
  const TemporaryFolder folder;
  const Mesh mesh = farTriangle();
  writeMesh(mesh, folder / "a.obj", {.doublePrecision = true});
  EXPECT_EQ(contentsOf(folder / "a.obj"), "# pdc\nv 5000000.501 -0.5 0\nv 5000001.5 0 0\nv 5000000.5 0.5 0.25\nf 1 2 3\n");
  writeMesh(mesh, folder / "a.ply", {.ascii = true, .doublePrecision = true});
  EXPECT_EQ(contentsOf(folder / "a.ply"),
            "ply\nformat ascii 1.0\ncomment pdc\n"
            "element vertex 3\nproperty double x\nproperty double y\nproperty double z\n"
            "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
            "5000000.501 -0.5 0\n5000001.5 0 0\n5000000.5 0.5 0.25\n3 0 1 2\n");
}

TEST(WriteMesh, DoublesAreReadBackAsPreciselyAsTheyWere) {
  const TemporaryFolder folder;
  const Mesh mesh = farTriangle();
  for (const char* name : {"a.ply", "a.obj"}) {
    for (const bool normals : {false, true}) {
      Mesh written = mesh;
      if (normals) written.normals.assign(3, {0, 0, 1});
      writeMesh(written, folder / name, {.doublePrecision = true});
      const Mesh read = readMesh(folder / name);
      ASSERT_EQ(read.positions.size(), 3u);
      for (std::size_t i = 0; i < 3; ++i)
        EXPECT_LT(
            length(read.origin + vecCast<double>(read.positions[i]) - mesh.origin - vecCast<double>(mesh.positions[i])),
            1e-7);
    }
  }
}

TEST(WriteMesh, OriginsAreReadBack) {
  const TemporaryFolder folder;
  for (const char* name : {"a.ply", "a.obj", "a.off", "a.stl"}) {
    for (const bool ascii : {false, true}) {
      SCOPED_TRACE(name);
      writeMesh(farTriangle(), folder / name, {.ascii = ascii});
      const Mesh read = readMesh(folder / name);
      EXPECT_EQ(read.origin, farTriangle().origin);
      EXPECT_EQ(read.positions, farTriangle().positions);
    }
  }
}

TEST(WriteMesh, OtherFormatsHoldNoDoubles) {
  const TemporaryFolder folder;
  EXPECT_THROW(writeMesh(farTriangle(), folder / "a.stl", {.doublePrecision = true}), std::invalid_argument);
  EXPECT_THROW(writeMesh(farTriangle(), folder / "a.off", {.doublePrecision = true}), std::invalid_argument);
  EXPECT_FALSE(std::filesystem::exists(folder / "a.off"));
}

}  // namespace
}  // namespace pdc
