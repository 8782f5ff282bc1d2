#include "extract/faces/fill_mesh.h"

#include <gtest/gtest.h>

#include <cstring>
#include <random>

#include "extract/sign_source.h"

namespace pdc {
namespace {

template <typename T>
bool sameBytes(const Buffer<T>& a, const Buffer<T>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

Mesh fill(const HermiteSource& source, const ContourOptions& options, SimdLevel level) {
  const SurfaceBlocks blocks = source.surfaceBlocks({});
  Mesh mesh;
  fillMesh(source, blocks, detail::buildTopology(blocks, {}), options, mesh, nullptr, {}, level);
  return mesh;
}

TEST(FillMesh, GivesTheSameBytesWithEveryInstructionSet) {
  std::mt19937 engine(5);
  std::bernoulli_distribution inside(0.5);
  SignSource source(30);
  for (int i = 0; i < 30 * 30 * 30; ++i) source.set(i / 900, i / 30 % 30, i % 30, inside(engine));
  for (const Placement placement : {Placement::kCell, Placement::kFree})
    for (const double sigma : {0.0, 0.001, 0.05, 0.5}) {
      const ContourOptions options{.sigmaNormal = sigma, .placement = placement, .normals = true};
      const Mesh plain = fill(source, options, SimdLevel::kBaseline);
      ASSERT_GT(plain.quads.size(), 10'000u);
      for (const SimdLevel level : {SimdLevel::kAvx2, SimdLevel::kAvx512}) {
        const Mesh mesh = fill(source, options, level);
        EXPECT_TRUE(sameBytes(mesh.positions, plain.positions)) << sigma;
        EXPECT_TRUE(sameBytes(mesh.normals, plain.normals)) << sigma;
        EXPECT_TRUE(sameBytes(mesh.quads, plain.quads)) << sigma;
      }
    }
}

}  // namespace
}  // namespace pdc
