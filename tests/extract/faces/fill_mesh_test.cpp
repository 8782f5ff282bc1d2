#include "extract/faces/fill_mesh.h"

#include <gtest/gtest.h>

#include <cstring>
#include <random>

#include "extract/sign_source.h"
#include "simd_levels.h"

namespace pdc {
namespace {

template <typename T>
bool sameBytes(const Buffer<T>& a, const Buffer<T>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

Mesh fill(const HermiteSource& source, const detail::FillMeshOptions& options) {
  const SurfaceBlocks blocks = source.surfaceBlocks({});
  const detail::Topology topology = detail::buildTopology(blocks, {});
  Mesh mesh;
  fillMesh({source, blocks, topology}, options, mesh, nullptr, {});
  return mesh;
}

TEST(FillMesh, GivesTheSameBytesWithEveryInstructionSet) {
  std::mt19937 engine(5);
  std::bernoulli_distribution inside(0.5);
  SignSource source(30);
  for (int i = 0; i < 30 * 30 * 30; ++i) source.set(i / 900, i / 30 % 30, i % 30, inside(engine));
  for (const double halfSize : {detail::kCellHalfSize, detail::kFreeHalfSize})
    for (const double sigma : {0.0, 0.001, 0.05, 0.5}) {
      detail::FillMeshOptions options{
          .sigma = sigma, .halfSize = halfSize, .normals = true, .level = SimdLevel::kBaseline};
      const Mesh plain = fill(source, options);
      ASSERT_GT(plain.quads.size(), 10'000u);
      for (const SimdLevel level : test::wideSimdLevels()) {
        options.level = level;
        const Mesh mesh = fill(source, options);
        EXPECT_TRUE(sameBytes(mesh.positions, plain.positions)) << sigma;
        EXPECT_TRUE(sameBytes(mesh.normals, plain.normals)) << sigma;
        EXPECT_TRUE(sameBytes(mesh.quads, plain.quads)) << sigma;
      }
    }
}

}  // namespace
}  // namespace pdc
