// Solids on round numbers that touch: their union is what it is exactly.

#include <gtest/gtest.h>

#include <array>
#include <random>
#include <vector>

#include "extract/certify/sound_checks.h"
#include "pdc/field/operators.h"
#include "pdc/field/primitives.h"
#include "pdc/sample/implicit/field_source.h"

namespace pdc {
namespace {

constexpr int kUnits = 6;                // along each axis of an arrangement
constexpr int kPoints = 2 * kUnits + 3;  // every half unit, with a layer around

/// A union of boxes whose corners lie on whole units, and the same as unit cubes.
class Arrangement {
 public:
  explicit Arrangement(std::mt19937& engine) {
    std::uniform_int_distribution<int> low(0, kUnits - 1), size(1, 3);
    for (int i = 0; i < 7; ++i) {
      std::array<int, 3> a, b;
      for (int axis = 0; axis < 3; ++axis) {
        a[axis] = low(engine);
        b[axis] = std::min(kUnits, a[axis] + size(engine));
      }
      add(a, b);
    }
  }

  [[nodiscard]] FieldPtr field(double unit) const {
    std::vector<FieldPtr> boxes;
    for (const auto& [a, b] : mBoxes) {
      const Vec3d lo{a[0] * unit, a[1] * unit, a[2] * unit}, hi{b[0] * unit, b[1] * unit, b[2] * unit};
      boxes.push_back(box((lo + hi) * 0.5, (hi - lo) * 0.5));
    }
    return unite(std::move(boxes));
  }

  [[nodiscard]] int volume() const {
    int cubes = 0;
    for (int i = 0; i < kUnits * kUnits * kUnits; ++i)
      cubes += solid(i / (kUnits * kUnits), i / kUnits % kUnits, i % kUnits);
    return cubes;
  }

  /// Between parts of the solid and of the space around it, each connected, there is one surface less than there are
  /// parts: their nesting is a tree.
  [[nodiscard]] int surfaces() const {
    std::vector<int> part(kPoints * kPoints * kPoints, -1);
    int parts = 0;
    for (int i = 0; i < static_cast<int>(part.size()); ++i)
      if (part[i] < 0) spread(i, parts++, part);
    return parts - 1;
  }

 private:
  void add(const std::array<int, 3>& a, const std::array<int, 3>& b) {
    mBoxes.push_back({a, b});
    for (int x = a[0]; x < b[0]; ++x)
      for (int y = a[1]; y < b[1]; ++y)
        for (int z = a[2]; z < b[2]; ++z) mSolid[x][y][z] = true;
  }
  [[nodiscard]] bool solid(int x, int y, int z) const {
    const auto within = [](int i) { return i >= 0 && i < kUnits; };
    return within(x) && within(y) && within(z) && mSolid[x][y][z];
  }
  /// Whether a point, in half units from -1/2, belongs to the closed solid: it touches a solid cube.
  [[nodiscard]] bool inside(int i) const {
    const std::array<int, 3> p{i / (kPoints * kPoints) - 1, i / kPoints % kPoints - 1, i % kPoints - 1};
    for (int corner = 0; corner < 8; ++corner) {
      std::array<int, 3> cube;
      for (int axis = 0; axis < 3; ++axis) {
        const bool between = p[axis] % 2 != 0;
        cube[axis] = between ? (p[axis] - 1) / 2 : p[axis] / 2 - (corner >> axis & 1);
        if (p[axis] < 0) cube[axis] = -1;
      }
      if (solid(cube[0], cube[1], cube[2])) return true;
    }
    return false;
  }
  void spread(int from, int number, std::vector<int>& part) const {
    const bool side = inside(from);
    std::vector<int> open{from};
    part[from] = number;
    while (!open.empty()) {
      const int i = open.back();
      open.pop_back();
      const std::array<int, 3> p{i / (kPoints * kPoints), i / kPoints % kPoints, i % kPoints};
      const std::array<int, 3> step{kPoints * kPoints, kPoints, 1};
      for (int axis = 0; axis < 3; ++axis)
        for (const int s : {-1, 1}) {
          const int j = i + s * step[axis];
          if (p[axis] + s < 0 || p[axis] + s >= kPoints || part[j] >= 0 || inside(j) != side) continue;
          part[j] = number;
          open.push_back(j);
        }
    }
  }

  std::vector<std::array<std::array<int, 3>, 2>> mBoxes;
  bool mSolid[kUnits][kUnits][kUnits]{};
};

TEST(TouchingSolids, UnionsOfBoxesAreWhatTheyAreExactly) {
  std::mt19937 engine(3);
  for (int i = 0; i < 50; ++i) {
    const double unit = std::array{1.0, 0.1, 0.3, 0.7, 2.5}[i % 5];
    const Arrangement arrangement(engine);
    const double margin = unit, side = kUnits * unit + margin;
    const FieldSource source(arrangement.field(unit),
                             {.box = {{-margin, -margin, -margin}, {side, side, side}}, .voxelSize = unit / 2});
    ContourReport report;
    const Mesh mesh = contour(source, {.sigmaNormal = 0.0}, &report);
    expectSound(mesh, report);
    const MeshReport facts = analyze(mesh);
    EXPECT_EQ(facts.components, static_cast<std::size_t>(arrangement.surfaces())) << i;
    // Vertices stay a ten-thousandth of a voxel within their cells, whose walls the faces lie in.
    EXPECT_NEAR(facts.volume, arrangement.volume() * unit * unit * unit, 1.5e-4 * (unit / 2) * facts.area) << i;
  }
}

Mesh contourOf(const FieldPtr& field) {
  return contour(FieldSource(field, {.box = {{-2, -2, -2}, {2, 2, 2}}, .voxelSize = 0.1}));
}

void expectBox(const FieldPtr& field, double volume) {
  const MeshReport facts = analyze(contourOf(field));
  EXPECT_EQ(facts.components, 1u);
  EXPECT_EQ(facts.eulerNumber, 2);
  EXPECT_NEAR(facts.volume, volume, 1e-3 * volume);
}

TEST(TouchingSolids, MirroredAndRepeatedPartsJoin) {
  expectBox(mirror(box({0.5, 0, 0}, {0.5, 0.6, 0.7}), 0), 2 * 1.2 * 1.4);
  expectBox(repeat(box({0, 0, 0}, {0.15, 0.6, 0.7}), {0.3, 0, 0}, {2, 0, 0}), 1.5 * 1.2 * 1.4);
  expectBox(unite({translate(box({0, 0, 0}, {0.3, 0.6, 0.7}), {0.3, 0, 0}), box({-0.3, 0, 0}, {0.3, 0.6, 0.7})}),
            1.2 * 1.2 * 1.4);
  expectBox(unite({complement(complement(box({0.3, 0, 0}, {0.3, 0.6, 0.7}))), box({-0.3, 0, 0}, {0.3, 0.6, 0.7})}),
            1.2 * 1.2 * 1.4);
}

TEST(TouchingSolids, FlushCutsLeaveNoFilm) {
  expectBox(subtract({box({0, 0, 0}, {1, 0.6, 0.7}), box({1, 0, 0}, {1, 0.6, 0.7})}), 1 * 1.2 * 1.4);
  EXPECT_TRUE(contourOf(subtract({box({0, 0, 0}, {0.5, 0.6, 0.7}), box({0, 0, 0}, {0.5, 0.6, 0.7})})).empty());
  EXPECT_TRUE(contourOf(subtract({box({0, 0, 0}, {0.5, 0.6, 0.7}), box({0, 0, 0}, {1, 0.6, 0.7})})).empty());
}

TEST(TouchingSolids, ThePlateBetweenTwoLayersStaysAbsent) {
  EXPECT_TRUE(contourOf(box({0, 0, 0.05}, {1, 1, 0.04})).empty());
  // One that reaches from layer to layer is there, as thick as it is.
  expectBox(box({0, 0, 0.05}, {1, 1, 0.05}), 2 * 2 * 0.1);
}

}  // namespace
}  // namespace pdc
