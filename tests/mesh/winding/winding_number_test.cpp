#include "mesh/winding/winding_number.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "mesh/winding/cubes.h"

namespace pdc::detail {
namespace {

/// By the sum over all triangles.
double exactly(const Mesh& mesh, const Vec3d& p) {
  double sum = 0;
  for (const Triangle& t : mesh.triangles) {
    const Vec3d a = vecCast<double>(mesh.positions[t[0]]) - p, b = vecCast<double>(mesh.positions[t[1]]) - p,
                c = vecCast<double>(mesh.positions[t[2]]) - p;
    const double la = length(a), lb = length(b), lc = length(c);
    sum += 2 * std::atan2(dot(a, cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
  }
  return sum / (4 * std::numbers::pi);
}

/// A tube around z of many triangles, open at both ends.
Mesh tube() {
  constexpr std::uint32_t kSides = 200;
  Mesh mesh;
  for (std::uint32_t i = 0; i < kSides; ++i) {
    const double angle = 2 * std::numbers::pi * i / kSides;
    for (const float z : {-1.0F, 1.0F})
      mesh.positions.push_back({static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle)), z});
    const std::uint32_t a = 2 * i, b = 2 * ((i + 1) % kSides);
    mesh.triangles.push_back({a, b, b + 1});
    mesh.triangles.push_back({a, b + 1, a + 1});
  }
  return mesh;
}

TEST(WindingNumber, OfAClosedMeshIsWhole) {
  Mesh twice = test::cube();
  twice.triangles.insert(twice.triangles.end(), twice.triangles.begin(), twice.triangles.begin() + 12);
  const ClosedSurface cube = closeSurface(test::cube()), turned = closeSurface(test::insideOut(test::cube())),
                      doubled = closeSurface(twice);
  for (const double x : {-0.5, 0.0, 0.25, 0.5, 1.0, 1.5})
    for (const double y : {-0.5, 0.0, 0.25, 0.5, 1.0})
      for (const double z : {-0.5, 0.0, 0.25, 1.0, 1.5}) {
        const auto within = [](double v) { return v >= 0 && v < 1; };
        const int expected = within(x) && within(y) && within(z) ? 1 : 0;
        EXPECT_EQ(WindingNumber(cube).at({x, y, z}), expected) << x << ' ' << y << ' ' << z;
        EXPECT_EQ(WindingNumber(turned).at({x, y, z}), -expected);
        EXPECT_EQ(WindingNumber(doubled).at({x, y, z}), 2 * expected);
      }
}

TEST(WindingNumber, OfAnOpenMeshIsThatOfItsSolidAngles) {
  EXPECT_NEAR(WindingNumber(closeSurface(test::openCube())).at({0.5, 0.5, 0.5}), 5.0 / 6, 1e-6);
  for (const Mesh& mesh : {test::openCube(), tube()}) {
    const ClosedSurface closed = closeSurface(mesh);
    const WindingNumber number(closed);
    std::mt19937 random(1);
    std::uniform_real_distribution<double> anywhere(-2, 2);
    for (int i = 0; i < 2000; ++i) {
      const Vec3d p{anywhere(random), anywhere(random), anywhere(random)};
      EXPECT_NEAR(number.at(p), exactly(mesh, p), 0.003);
    }
  }
}

TEST(SolidAngles, BoundsHold) {
  const ClosedSurface closed = closeSurface(tube());
  const SolidAngles angles(closed, closed.caps());
  std::mt19937 random(2);
  std::uniform_real_distribution<double> anywhere(-3, 3), share(0, 1);
  int below = 0;
  for (int i = 0; i < 500; ++i) {
    const Vec3d low{anywhere(random), anywhere(random), anywhere(random)};
    const double bound = angles.bound({low, low + Vec3d{0.3, 0.3, 0.3}}, 0.4);
    below += bound < 0.4 ? 1 : 0;
    for (int k = 0; k < 20 && bound < 0.4; ++k) {
      const Vec3d p = low + Vec3d{share(random), share(random), share(random)} * 0.3;
      EXPECT_LE(std::abs(angles.at(p)), bound + 0.003);
    }
  }
  EXPECT_GT(below, 100);
}

TEST(SolidAngles, GradientIsThatOfDifferencesAlsoAcrossCaps) {
  for (const Mesh& mesh : {test::openCube(), tube()}) {
    const ClosedSurface closed = closeSurface(mesh);
    const SolidAngles angles(closed, closed.caps());
    std::mt19937 random(3);
    std::uniform_real_distribution<double> anywhere(-1.5, 1.5);
    for (int i = 0; i < 1000; ++i) {
      const Vec3d p{anywhere(random), anywhere(random), anywhere(random)}, gradient = angles.gradient(p);
      for (int axis = 0; axis < 3; ++axis) {
        constexpr double kStep = 1e-5;
        Vec3d low = p, high = p;
        low[axis] -= kStep;
        high[axis] += kStep;
        const double difference = angles.at(high) - angles.at(low);
        if (std::abs(difference) > 0.003 && std::abs(difference) < 0.9) continue;  // Other nodes count together.
        EXPECT_NEAR(gradient[axis], (difference - std::round(difference)) / (2 * kStep),
                    1e-4 + 1e-3 * length(gradient));
      }
    }
  }
  // Where caps meet it is finite.
  const ClosedSurface closed = closeSurface(tube());
  EXPECT_LT(length(SolidAngles(closed, closed.caps()).gradient({0, 0, 1})), 10);
}

}  // namespace
}  // namespace pdc::detail
