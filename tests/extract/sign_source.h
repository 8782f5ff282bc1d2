#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "pdc/sample/hermite_source.h"

namespace pdc {

/// A dense volume of signs as a source: everything beyond it is outside. Crossings and normals are pseudo-random
/// functions of the lattice edge, so that vertices go wherever the placement lets them.
class SignSource final : public HermiteSource {
 public:
  explicit SignSource(int size, bool open = false)
      : mSize(size), mOpen(open), mInside(std::size_t(size) * size * size) {}

  void set(int x, int y, int z, bool inside) { mInside[index(x, y, z)] = inside; }
  [[nodiscard]] bool inside(int x, int y, int z) const {
    const auto in = [&](int v) { return v >= 0 && v < mSize; };
    return in(x) && in(y) && in(z) && mInside[index(x, y, z)];
  }

  [[nodiscard]] SurfaceBlocks surfaceBlocks(const Monitor&) const override {
    SurfaceBlocks out;
    out.open = mOpen;
    for (int bx = -1; bx * kBlockSize < mSize; ++bx)
      for (int by = -1; by * kBlockSize < mSize; ++by)
        for (int bz = -1; bz * kBlockSize < mSize; ++bz) {
          const BlockSigns signs = blockSigns({bx, by, bz});
          if (signs.uniform() || signs.cells.none()) continue;
          out.coords.push_back({bx, by, bz});
          out.signs.push_back(signs);
        }
    return out;
  }

  void fillHermite(const SurfaceBlock& block, HermiteBlock& hermite) const override {
    block.edges.forEach([&](int i, int axis, int x, int y, int z) {
      const Coord& b = block.coord;
      std::uint64_t h = hash(axis, b[0] * kBlockSize + x, b[1] * kBlockSize + y, b[2] * kBlockSize + z);
      const auto uniform = [&h] {
        h = h * 6364136223846793005ull + 1442695040888963407ull;
        return static_cast<double>(h >> 11) * 0x1p-53;
      };
      hermite.t[i] = static_cast<float>(0.01 + 0.98 * uniform());
      const double c = 2 * uniform() - 1, phi = 6.283185307179586 * uniform(), s = std::sqrt(1 - c * c);
      hermite.nx[i] = static_cast<float>(s * std::cos(phi));
      hermite.ny[i] = static_cast<float>(s * std::sin(phi));
      hermite.nz[i] = static_cast<float>(c);
    });
  }

  [[nodiscard]] SourceKnowledge knowledge() const override { return {.exactNormals = mExactNormals}; }
  /// Makes vertices count as being on creases where their random planes happen to meet.
  void claimExactNormals() { mExactNormals = true; }
  [[nodiscard]] const LatticeMap& map() const override { return mMap; }

 private:
  [[nodiscard]] std::size_t index(int x, int y, int z) const { return (std::size_t(x) * mSize + y) * mSize + z; }

  /// In open mode only cells whose corners all lie in the volume take part.
  [[nodiscard]] BlockSigns blockSigns(const Coord& b) const {
    BlockSigns s;
    for (int x = 0; x < kBlockPoints; ++x)
      for (int y = 0; y < kBlockPoints; ++y)
        for (int z = 0; z < kBlockPoints; ++z) {
          const int px = b[0] * kBlockSize + x, py = b[1] * kBlockSize + y, pz = b[2] * kBlockSize + z;
          s.row[kBlockPoints * x + y] |= static_cast<std::uint16_t>(inside(px, py, pz) << z);
          const auto cell = [&](int v) { return v >= 0 && v + 1 < mSize; };
          if (mOpen && x < kBlockSize && y < kBlockSize && z < kBlockSize && !(cell(px) && cell(py) && cell(pz)))
            s.cells.reset(x, y, z);
        }
    return s;
  }

  static std::uint64_t hash(int a, int x, int y, int z) {
    std::uint64_t h = 0x9E3779B97F4A7C15ull;
    for (const int v : {a, x, y, z}) {
      h = (h ^ static_cast<std::uint32_t>(v)) * 0xD6E8FEB86659FD93ull;
      h ^= h >> 29;
    }
    return h;
  }

  int mSize;
  bool mOpen, mExactNormals = false;
  std::vector<bool> mInside;
  LatticeMap mMap{Mat3d::identity(), Vec3d{}};
};

}  // namespace pdc
