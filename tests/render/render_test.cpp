#include "pdc/render/render.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <limits>
#include <stdexcept>
#include <vector>

#include "pdc/error.h"
#include "render/shapes.h"

namespace pdc::test {
namespace {

using Pixel = std::array<std::uint8_t, 3>;

constexpr int kSide = 200;
constexpr Vec3d kFront{0, -1, 0}, kTop{0, 0, 1};

Image draw(const Mesh& mesh, RenderOptions options = {}) {
  options.width = options.height = kSide;
  return render(mesh, options);
}

TEST(Render, DoesNotDependOnTheOrigin) {
  Mesh mesh = cube();
  const Image near = draw(mesh);
  mesh.origin = {1 << 30, -(1 << 29), 1 << 28};
  EXPECT_EQ(draw(mesh).pixels, near.pixels);
}

int brightness(const Pixel& p) { return p[0] + p[1] + p[2]; }

std::size_t covered(const Image& image) {
  return image.pixels.size() -
         static_cast<std::size_t>(std::count(image.pixels.begin(), image.pixels.end(), image.at(0, 0)));
}

/// A floor at z = 0 from -2 to 2 with two walls of height 1 along y, at x = -0.1 and 0.1.
Mesh trench() {
  Mesh mesh;
  const auto quad = [&](Vec3f a, Vec3f b, Vec3f c, Vec3f d) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), {a, b, c, d});
    mesh.quads.push_back({first, first + 1, first + 2, first + 3});
  };
  quad({-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0});
  for (const float x : {-0.1F, 0.1F}) quad({x, -2, 0}, {x, 2, 0}, {x, 2, 1}, {x, -2, 1});
  return mesh;
}

TEST(Render, OutlineOfASphereIsACircle) {
  const double radius = 0.46 * kSide;
  EXPECT_NEAR(static_cast<double>(covered(draw(sphere(64)))) / (std::numbers::pi * radius * radius), 1, 0.02);
}

TEST(Render, SameBytesForAnyNumberOfThreads) {
  const Mesh mesh = sphere(40);
  const Image one = draw(mesh, {.edges = true, .threads = 1});
  for (const int threads : {0, 2, 5}) EXPECT_EQ(draw(mesh, {.edges = true, .threads = threads}).pixels, one.pixels);
}

// Neither acne nor cracks: nothing shades a convex body, so a face has one colour.
TEST(Render, AFaceOfACubeHasOneColour) {
  const Image image = draw(cube(), {.towardsViewer = kFront});
  for (int y = 12; y < kSide - 12; ++y)
    for (int x = 12; x < kSide - 12; ++x) ASSERT_EQ(image.at(x, y), image.at(100, 100)) << x << " " << y;
}

TEST(Render, CreasesAreDarkAndSmoothPartsHaveNone) {
  const Image box = draw(cube());
  const auto darkest = [](const Image& image, int x0, int x1, int y) {
    int least = 1000;
    for (int x = x0; x < x1; ++x) least = std::min(least, brightness(image.at(x, y)));
    return least;
  };
  // The nearest vertical edge runs down from the middle.
  const int crease = darkest(box, 97, 103, 150);
  EXPECT_LT(crease, 0.8 * std::min(brightness(box.at(85, 150)), brightness(box.at(115, 150))));
  const Image ball = draw(sphere(64));
  for (int x = 40; x < 160; ++x)
    EXPECT_LT(std::abs(brightness(ball.at(x, 100)) - brightness(ball.at(x + 1, 100))), 12) << x;
}

TEST(Render, WhatIsHiddenFromTheSkyIsDarker) {
  const Image image = draw(trench(), {.towardsViewer = kTop});
  EXPECT_LT(brightness(image.at(100, 100)), 0.8 * brightness(image.at(20, 100)));
}

TEST(Render, BackFacesAreReddish) {
  const Pixel front = draw(cube(), {.towardsViewer = kFront}).at(100, 100);
  const Pixel back = draw(insideOut(cube()), {.towardsViewer = kFront}).at(100, 100);
  EXPECT_LT(front[0], 1.2 * front[1]);
  EXPECT_GT(back[0], 1.5 * back[1]);
}

TEST(Render, NormalsAreColours) {
  const Pixel blue = draw(cube(), {.towardsViewer = kFront, .shading = Shading::kNormal}).at(100, 100);
  EXPECT_EQ(blue, (Pixel{128, 128, 255}));
}

TEST(Render, ValuesRunFromBlueToYellow) {
  const Mesh mesh = cube();
  std::vector<float> values(8);
  for (std::size_t i = 0; i < 8; ++i) values[i] = mesh.positions[i].x > 0 ? 3.0F : 1.0F;
  const Image image =
      draw(mesh, {.towardsViewer = kFront, .shading = Shading::kValues, .values = values, .valueLo = 1, .valueHi = 3});
  const Pixel low = image.at(12, 100), high = image.at(kSide - 13, 100);
  EXPECT_GT(low[2], 1.5 * low[0]);
  EXPECT_GT(high[0], 1.5 * high[2]);
  EXPECT_LT(brightness(low), brightness(image.at(100, 100)));
  EXPECT_LT(brightness(image.at(100, 100)), brightness(high));
}

TEST(Render, EdgesAreTheMeshsButNotTheDiagonalsOfQuads) {
  const Mesh quads = cube();
  Mesh triangles = quads;
  triangles.quads.clear();
  for (const Quad& q : quads.quads) {
    triangles.triangles.push_back({q[0], q[1], q[2]});
    triangles.triangles.push_back({q[0], q[2], q[3]});
  }
  const Pixel plain = draw(quads, {.towardsViewer = kFront}).at(100, 100);
  EXPECT_EQ(draw(quads, {.towardsViewer = kFront, .edges = true}).at(100, 100), plain);
  EXPECT_LT(brightness(draw(triangles, {.towardsViewer = kFront, .edges = true}).at(100, 100)), brightness(plain));
}

TEST(Render, BrokenFacesAreLeftOut) {
  Mesh mesh = cube();
  const Image sound = draw(mesh);
  mesh.positions.push_back({std::numeric_limits<float>::quiet_NaN(), 0, 0});
  mesh.positions.push_back({std::numeric_limits<float>::infinity(), 0, 0});
  mesh.triangles = {{0, 1, 8}, {0, 1, 9}, {0, 0, 1}, {3, 3, 3}};
  EXPECT_EQ(draw(mesh).pixels, sound.pixels);
}

TEST(Render, FarFromTheOriginNothingChanges) {
  Mesh mesh = cube();
  const Image here = draw(mesh);
  for (Vec3f& p : mesh.positions) p += Vec3f{4096, -8192, 1024};
  EXPECT_EQ(draw(mesh).pixels, here.pixels);
}

TEST(Render, Refusals) {
  const Mesh mesh = cube();
  const auto refuses = [&](RenderOptions options) {
    EXPECT_THROW(static_cast<void>(render(mesh, options)), std::invalid_argument);
  };
  refuses({.width = 0});
  refuses({.height = kMaxImageSide + 1});
  refuses({.shading = Shading::kValues});
  refuses({.threads = -1});
  EXPECT_THROW(static_cast<void>(render(Mesh{})), Error);
  Mesh wrong = cube();
  wrong.quads.push_back({0, 1, 2, 8});
  EXPECT_THROW(static_cast<void>(render(wrong)), Error);
  const std::atomic<bool> stop = true;
  EXPECT_THROW(static_cast<void>(render(mesh, {}, {.stop = &stop})), Cancelled);
}

}  // namespace
}  // namespace pdc::test
