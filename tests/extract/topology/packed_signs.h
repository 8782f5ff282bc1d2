#pragma once

#include <random>

#include "extract/sign_source.h"

namespace pdc {

/// Small grids are packed into one volume, this far apart: not a multiple of the block size, so that they lie across
/// block borders in every way.
inline constexpr int kPitch = 9;
inline constexpr int kPerAxis = 12;

/// Calls fill(source, index, x, y, z) with the low corner of each of kPerAxis³ places.
template <typename Fill>
SignSource pack(bool open, Fill&& fill) {
  SignSource source(kPitch * kPerAxis, open);
  int i = 0;
  for (int x = 0; x < kPerAxis; ++x)
    for (int y = 0; y < kPerAxis; ++y)
      for (int z = 0; z < kPerAxis; ++z) fill(source, i++, kPitch * x + 1, kPitch * y + 1, kPitch * z + 1);
  return source;
}

/// Packs 6×6×6 grids of random signs.
inline SignSource randomGrids(std::mt19937& engine, double density, bool open = false) {
  std::bernoulli_distribution inside(density);
  return pack(open, [&](SignSource& source, int, int x, int y, int z) {
    for (int i = 0; i < 6 * 6 * 6; ++i) source.set(x + i / 36, y + i / 6 % 6, z + i % 6, inside(engine));
  });
}

}  // namespace pdc
