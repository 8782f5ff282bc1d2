#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>

#include "fuzz/flips.h"
#include "io/volume/volume_files.h"
#include "pdc/io/mesh/mesh_reader.h"
#include "pdc/io/mesh/mesh_writer.h"
#include "pdc/mesh/mesh_report.h"

namespace pdc {
namespace {

/// A strip of quads and triangles with normals, a few kilobytes in each format.
Mesh strip() {
  Mesh mesh;
  for (std::uint32_t i = 0; i < 60; ++i) {
    mesh.positions.push_back({static_cast<float>(i / 2), static_cast<float>(i % 2), 0.1f * static_cast<float>(i % 5)});
    mesh.normals.push_back({0, 0, 1});
    if (i % 2 == 1 && i > 2) mesh.quads.push_back({i - 3, i - 1, i, i - 2});
    if (i % 10 == 2) mesh.triangles.push_back({i - 2, i - 1, i});
  }
  return mesh;
}

constexpr std::array<const char*, 6> kNames{"0.ply", "1.ply", "2.obj", "3.off", "4.stl", "5.stl"};

void readAndAnalyze(const std::filesystem::path& path) {
  const Mesh mesh = readMesh(path);
  try {
    static_cast<void>(analyze(mesh));
  } catch (const Error&) {
    throw std::logic_error("a face names a vertex that is not there");
  }
}

TEST(MeshFlips, DamagedFilesGiveAMeshOrAnError) {
  const TemporaryFolder folder;
  // In a child, because writing meshes starts threads, which do not survive a fork.
  const ForkedResult written = runForked(1, 1, [&](std::size_t) {
    for (const char* name : kNames) writeMesh(strip(), folder / name, {.ascii = name[0] == '1' || name[0] == '5'});
  });
  ASSERT_EQ(written.successes, 1u) << written.failure;
  WholeFiles files;
  for (const std::string name : kNames) {
    const std::string bytes = contentsOf(folder / name);
    files.emplace_back(name, bytes);
    files.emplace_back(name + ".gz", deflated(bytes));
  }
  expectReadOrRefused(files, 250, readAndAnalyze);
}

}  // namespace
}  // namespace pdc
