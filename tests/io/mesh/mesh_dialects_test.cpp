#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>
#include <tuple>

#include "io/mesh/dialects.h"
#include "io/mesh/read_text.h"
#include "pdc/mesh/mesh_report.h"
#include "pdc/mesh/self_intersections.h"

namespace pdc::test {
namespace {

struct Dialect {
  const char* name;
  std::string (*write)(const Solid&, Dice&);
};

constexpr std::array<Dialect, 4> kDialects{
    {{"a.obj", objDialect}, {"a.off", offDialect}, {"a.ply", plyDialect}, {"a.stl", stlDialect}}};

Buffer<Vec3f> sorted(Buffer<Vec3f> positions) {
  std::sort(positions.begin(), positions.end(),
            [](const Vec3f& a, const Vec3f& b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); });
  return positions;
}

TEST(MeshDialects, AllReadToTheSameSolid) {
  constexpr std::uint32_t kFiles = 400;
  for (std::uint32_t seed = 0; seed < kFiles; ++seed) {
    const Dialect& dialect = kDialects[seed % kDialects.size()];
    const Solid& solid = solids()[seed / kDialects.size() % solids().size()];
    Dice dice(seed);
    const std::string file = dialect.write(solid, dice);
    SCOPED_TRACE(std::string(dialect.name) + " of the " + solid.name + ", seed " + std::to_string(seed));
    const Mesh mesh = readText(dialect.name, file);
    const MeshReport report = analyze(mesh);
    EXPECT_EQ(report.boundaryEdges + report.nonManifoldEdges + report.misorientedEdges + report.degenerateFaces, 0u);
    EXPECT_EQ(report.eulerNumber, 2);
    EXPECT_NEAR(report.area, solid.area, 1e-9);
    EXPECT_NEAR(report.volume, solid.volume, 1e-9);
    EXPECT_TRUE(selfIntersections(mesh).pairs.empty());
    const Mesh expected = solid.triangulated();
    if (dialect.write == stlDialect) {
      EXPECT_EQ(sorted(mesh.positions), sorted(expected.positions));
    } else {
      EXPECT_EQ(mesh.positions, expected.positions);
    }
    if (testing::Test::HasFailure()) {
      ADD_FAILURE() << testing::PrintToString(file);
      return;
    }
  }
}

/// Each damage is one that no reader can mend.
std::string damaged(const char* name, std::string file, const Solid& solid, Dice& dice) {
  switch (dice.below(4)) {
    case 0:
      return "<!DOCTYPE html>\n<html><body>404: Not Found</body></html>\n";
    case 1:
      return "\x89PNG\r\n" + file;
    case 2: {
      std::string wide;
      for (const char c : file) wide += {c, '\0'};
      return wide;
    }
    default:
      break;
  }
  const std::size_t vertices = solid.positions.size();
  if (std::string(name) == "a.obj") return "v 0 0 0\nv 1 0 0\nf 1 2 " + std::to_string(3 + dice.below(9)) + "\n";
  if (std::string(name) == "a.off") return "OFF\n" + std::to_string(vertices) + " 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  if (std::string(name) == "a.ply") return file.substr(0, file.size() - 40);
  return "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid\n";
}

TEST(MeshDialects, DamagedOnesAreErrorsInOneLine) {
  for (std::uint32_t seed = 0; seed < 100; ++seed) {
    const Dialect& dialect = kDialects[seed % kDialects.size()];
    const Solid& solid = solids()[seed / kDialects.size() % solids().size()];
    Dice dice(seed);
    const std::string file = damaged(dialect.name, dialect.write(solid, dice), solid, dice);
    const TemporaryFolder folder;
    writeContents(folder / dialect.name, file);
    try {
      static_cast<void>(readMesh(folder / dialect.name));
      ADD_FAILURE() << "seed " << seed << " was read: " << testing::PrintToString(file);
    } catch (const Error& error) {
      const std::string message = error.what();
      EXPECT_EQ(message.find('\n'), std::string::npos);
      EXPECT_TRUE(message.starts_with((folder / dialect.name).string() + ": ")) << message;
    }
  }
}

}  // namespace
}  // namespace pdc::test
