#pragma once

#include <cstdint>
#include <initializer_list>
#include <random>
#include <string>
#include <vector>

#include "pdc/mesh/mesh.h"

namespace pdc::test {

/// A solid whose faces, of any number of corners, point outwards. Coordinates are small whole numbers.
struct Solid {
  const char* name;
  std::vector<Vec3d> positions;
  std::vector<std::vector<std::uint32_t>> faces;
  double area, volume;

  /// With triangles in place of larger faces.
  [[nodiscard]] Mesh triangulated() const;
};

/// A tetrahedron, a cube, and prisms over an L, an arrow and a star, whose ends are concave.
[[nodiscard]] const std::vector<Solid>& solids();

/// Random choices that depend on a seed only.
class Dice {
 public:
  explicit Dice(std::uint32_t seed) : mRandom(seed) {}

  /// From 0 to count - 1.
  [[nodiscard]] std::size_t below(std::size_t count) { return mRandom() % count; }
  [[nodiscard]] bool once(std::size_t in) { return below(in) == 0; }
  template <typename Value>
  [[nodiscard]] Value of(std::initializer_list<Value> values) {
    return *(values.begin() + below(values.size()));
  }

 private:
  std::mt19937 mRandom;
};

// Files as programs write them, in one of the ways that the format leaves open.

[[nodiscard]] std::string objDialect(const Solid& solid, Dice& dice);
[[nodiscard]] std::string offDialect(const Solid& solid, Dice& dice);
[[nodiscard]] std::string plyDialect(const Solid& solid, Dice& dice);
[[nodiscard]] std::string textStl(const Solid& solid, Dice& dice);
/// Text or binary.
[[nodiscard]] std::string stlDialect(const Solid& solid, Dice& dice);

}  // namespace pdc::test
