#include "render/slivers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <numbers>
#include <random>

#include "pdc/render/render.h"
#include "render/shapes.h"

namespace pdc::test {
namespace {

/// A disc with a rod through its middle that shades it; the disc is n triangles about its centre.
Mesh disc(std::uint32_t n) {
  Mesh mesh = cube();
  for (Vec3f& p : mesh.positions) p = {0.1f * p.x, 0.1f * p.y, 0.5f * p.z};
  const auto middle = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.push_back({0, 0, 0});
  for (std::uint32_t k = 0; k < n; ++k) {
    const double u = 2 * std::numbers::pi * k / n;
    mesh.positions.push_back(vecCast<float>(Vec3d{std::cos(u), std::sin(u), 0}));
    mesh.triangles.push_back({middle, middle + 1 + k, middle + 1 + (k + 1) % n});
  }
  return mesh;
}

Image draw(const Mesh& mesh, int threads = 0) {
  return render(mesh, {.width = 300, .height = 300, .threads = threads});
}

std::size_t differentPixels(const Image& a, const Image& b) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i)
    for (int k = 0; k < 3; ++k)
      if (std::abs(a.pixels[i][k] - b.pixels[i][k]) > 16) {
        ++count;
        break;
      }
  return count;
}

detail::DividedTriangles divide(const Mesh& mesh) {
  const Camera camera = fitCamera({&mesh, 1}, {1, -1, 1}, 300, 300);
  return detail::divideTriangles(detail::viewMesh(mesh, camera, 300, 300), 300, 300);
}

TEST(Slivers, AreLeftToRaysWhereThereAreFew) {
  EXPECT_TRUE(divide(sphere(40)).slivers.empty());
  EXPECT_TRUE(divide(disc(100)).slivers.empty());
}

TEST(Slivers, AreDividedFromOthersAndWidenedAsOccluders) {
  const detail::DividedTriangles divided = divide(disc(20'000));
  EXPECT_EQ(divided.slivers.size(), 20'000u);
  EXPECT_EQ(divided.others.size(), 12u);
  EXPECT_EQ(divided.otherNumbers.size(), 12u);
  EXPECT_GT(divided.occluders.size(), 100u);
  EXPECT_LT(divided.occluders.size(), 500u);
}

TEST(Slivers, LookAsTheSurfaceThatTheyMake) {
  const Image wide = draw(disc(150)), thin = draw(disc(20'000));
  EXPECT_LT(differentPixels(wide, thin), 300u);
  EXPECT_GT(differentPixels(draw(disc(3)), thin), 3000u);
  EXPECT_EQ(draw(disc(20'000), 1).pixels, thin.pixels);
}

TEST(Slivers, EachSampleIsInOneOfTwoTrianglesAtAnEdge) {
  std::mt19937 random(41);
  std::uniform_real_distribution<float> uniform(0, 20);
  for (int i = 0; i < 300; ++i) {
    // A convex quad and its diagonal; corners on samples now and then.
    const auto at = [&](float x, float y) {
      const Vec3f p{x + uniform(random), y + uniform(random), 0};
      return i % 2 == 0 ? p : Vec3f{std::round(p.x), std::round(p.y), 0};
    };
    const Vec3f a = at(0, 0), b = at(60, 0), c = at(60, 60), d = at(0, 60);
    for (int row = 0; row < 80; ++row) {
      const detail::Span one = detail::rowSpan({a, b, c}, row), two = detail::rowSpan({a, c, d}, row);
      const detail::Span turned = detail::rowSpan({c, a, b}, row);
      EXPECT_EQ(one.begin, turned.begin);
      EXPECT_EQ(one.end, turned.end);
      if (one.begin < one.end && two.begin < two.end) EXPECT_EQ(two.end, one.begin);
    }
  }
}

TEST(Slivers, WeightsAreThoseOfThePoint) {
  const std::array<Vec3f, 3> t{{{0, 0, 1}, {4, 0, 2}, {0, 4, 3}}};
  const std::array<float, 3> w = detail::planeWeights(t, 1, 2);
  EXPECT_FLOAT_EQ(w[0], 0.25f);
  EXPECT_FLOAT_EQ(w[1], 0.25f);
  EXPECT_FLOAT_EQ(w[2], 0.5f);
  EXPECT_EQ(detail::planeWeights(t, -1, 2)[1], 0);
}

}  // namespace
}  // namespace pdc::test
