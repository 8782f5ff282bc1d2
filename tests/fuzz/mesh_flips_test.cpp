#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "fuzz/forked.h"
#include "fuzz/mutate.h"
#include "io/file/temporary_folder.h"
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

TEST(MeshFlips, DamagedFilesGiveAMeshOrAnError) {
  const TemporaryFolder folder;
  const ForkedResult written = runForked(1, 1, [&](std::size_t) {
    for (const char* name : kNames) writeMesh(strip(), folder / name, {.ascii = name[0] == '1' || name[0] == '5'});
  });
  ASSERT_EQ(written.successes, 1u) << written.failure;
  std::vector<std::string> files;
  for (const char* name : kNames) files.push_back(contentsOf(folder / name));

  constexpr std::size_t kAttempts = 3000, kPerChild = 500;
  const ForkedResult result = runForked(kAttempts, kPerChild, [&](std::size_t i) {
    const auto path = folder / ("damaged" + std::string(kNames[i % kNames.size()]));
    std::filesystem::remove(path);  // file systems flush a file that is overwritten
    writeContents(path, mutate(files[i % kNames.size()], static_cast<std::uint32_t>(i)));
    const Mesh mesh = readMesh(path);
    try {
      static_cast<void>(analyze(mesh));
    } catch (const Error&) {
      throw std::logic_error("a face names a vertex that is not there");
    }
  });
  EXPECT_EQ(result.failure, "");
  EXPECT_EQ(result.successes + result.errors, kAttempts);
  EXPECT_GT(result.successes, kAttempts / 20);
  EXPECT_GT(result.errors, kAttempts / 4);
}

}  // namespace
}  // namespace pdc
