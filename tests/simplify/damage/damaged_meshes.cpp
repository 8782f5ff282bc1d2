#include "simplify/damage/damaged_meshes.h"

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "simplify/shapes.h"

namespace pdc::test {
namespace {

class Random {
 public:
  explicit Random(std::uint32_t seed) : mEngine(seed) {}
  /// From 0 to below `size`, which is above 0.
  std::uint32_t below(std::size_t size) { return static_cast<std::uint32_t>(mEngine() % size); }
  bool chance(double share) { return unit() < share; }
  float unit() { return static_cast<float>(static_cast<double>(mEngine()) / 0x1p32); }

 private:
  std::mt19937 mEngine;
};

Mesh someShape(Random& random) {
  const int n = 2 + static_cast<int>(random.below(5));
  switch (random.below(4)) {
    case 0:
      return cube(n);
    case 1:
      return sphere(n);
    case 2:
      return torus(n + 2);
    default:
      return plate(2 * n);
  }
}

std::uint32_t someVertex(const Mesh& mesh, Random& random) { return random.below(mesh.positions.size()); }

Triangle& someFace(Mesh& mesh, Random& random) { return mesh.triangles[random.below(mesh.triangles.size())]; }

constexpr std::array kOddNumbers{std::numeric_limits<float>::quiet_NaN(),
                                 std::numeric_limits<float>::infinity(),
                                 -std::numeric_limits<float>::infinity(),
                                 std::numeric_limits<float>::max(),
                                 std::numeric_limits<float>::lowest(),
                                 std::numeric_limits<float>::denorm_min(),
                                 -std::numeric_limits<float>::min(),
                                 1e30F,
                                 -1e20F,
                                 1e-30F,
                                 -0.0F};

using Damage = std::function<void(Mesh&, Random&)>;

void nameOtherVertices(Mesh& mesh, Random& random) {
  for (int i = 0; i < 4; ++i) someFace(mesh, random)[random.below(3)] = someVertex(mesh, random);
}

void nameNoVertex(Mesh& mesh, Random& random) {
  if (random.chance(0.2)) someFace(mesh, random)[random.below(3)] = static_cast<std::uint32_t>(mesh.positions.size());
}

void swapCorners(Mesh& mesh, Random& random) {
  for (int i = 0; i < 4; ++i)
    std::swap(someFace(mesh, random)[random.below(3)], someFace(mesh, random)[random.below(3)]);
}

void placeOddly(Mesh& mesh, Random& random) {
  for (int i = 0; i < 3; ++i)
    mesh.positions[someVertex(mesh, random)][static_cast<int>(random.below(3))] =
        kOddNumbers[random.below(kOddNumbers.size())];
}

void doubleFaces(Mesh& mesh, Random& random) {
  for (int i = 0; i < 5; ++i) mesh.triangles.push_back(Triangle(someFace(mesh, random)));
}

void turnFacesOver(Mesh& mesh, Random& random) {
  for (int i = 0; i < 5; ++i) {
    Triangle& t = someFace(mesh, random);
    std::swap(t[1], t[2]);
  }
}

void foldFaces(Mesh& mesh, Random& random) {
  for (int i = 0; i < 3; ++i) {
    const auto [a, b, c] = someFace(mesh, random);
    mesh.triangles.push_back({a, c, b});
  }
}

void unweld(Mesh& mesh, Random& random) {
  const double share = random.unit();
  for (Triangle& t : mesh.triangles)
    for (std::uint32_t& v : t) {
      if (!random.chance(share)) continue;
      mesh.positions.push_back(Vec3f(mesh.positions[v]));
      v = static_cast<std::uint32_t>(mesh.positions.size() - 1);
    }
}

void makeHoles(Mesh& mesh, Random& random) {
  Buffer<Triangle> kept;
  for (const Triangle& t : mesh.triangles)
    if (!random.chance(0.2)) kept.push_back(t);
  if (!kept.empty()) mesh.triangles = kept;
}

void addFan(Mesh& mesh, Random& random) {
  const Triangle t = someFace(mesh, random);
  for (std::uint32_t i = 0, size = 1 + random.below(20); i < size; ++i)
    mesh.triangles.push_back({t[0], t[1], someVertex(mesh, random)});
}

void pinch(Mesh& mesh, Random& random) {
  const std::uint32_t from = someVertex(mesh, random), to = someVertex(mesh, random);
  for (Triangle& t : mesh.triangles)
    for (std::uint32_t& v : t)
      if (v == from) v = to;
}

void joinPlaces(Mesh& mesh, Random& random) {
  for (int i = 0; i < 6; ++i)
    mesh.positions[someVertex(mesh, random)] = Vec3f(mesh.positions[someVertex(mesh, random)]);
}

void coarsen(Mesh& mesh, Random& random) {
  const auto step = static_cast<float>(std::ldexp(1, -static_cast<int>(random.below(4))));
  for (Vec3f& p : mesh.positions)
    for (int i = 0; i < 3; ++i) p[i] = std::round(p[i] / step) * step;
}

void shake(Mesh& mesh, Random& random) {
  const float size = 0.5F * random.unit();
  for (Vec3f& p : mesh.positions)
    for (int i = 0; i < 3; ++i) p[i] += size * (random.unit() - 0.5F);
}

void addLooseVertices(Mesh& mesh, Random& random) {
  for (int i = 0; i < 5; ++i) mesh.positions.push_back({random.unit(), random.unit(), random.unit()});
}

void makeQuads(Mesh& mesh, Random& random) {
  for (int i = 0; i < 4; ++i) {
    const auto [a, b, c] = someFace(mesh, random);
    mesh.quads.push_back({a, b, c, someVertex(mesh, random)});
  }
}

void addProperties(Mesh& mesh, Random& random) {
  Buffer<float> odd;
  Buffer<std::int32_t> whole;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    odd.push_back(kOddNumbers[random.below(kOddNumbers.size())]);
    whole.push_back(std::numeric_limits<std::int32_t>::max() - static_cast<std::int32_t>(random.below(2)));
  }
  mesh.properties = {{"odd", 1, odd}, {"whole", 1, whole}};
  mesh.normals.assign(mesh.positions.size(), Vec3f{0, 0, 1});
}

constexpr std::array kDamages{nameOtherVertices, nameNoVertex,     swapCorners, placeOddly, doubleFaces, turnFacesOver,
                              foldFaces,         unweld,           makeHoles,   addFan,     pinch,       joinPlaces,
                              coarsen,           addLooseVertices, makeQuads,   shake};

/// Places that are flat in so many of their coordinates.
void flatten(Mesh& mesh, std::uint32_t coordinates) {
  for (Vec3f& p : mesh.positions)
    for (std::uint32_t i = 0; i < coordinates; ++i) p[static_cast<int>(2 - i)] = 1;
}

void turn(Mesh& mesh) {
  for (Vec3f& p : mesh.positions) p = {0.36F * p.x + 0.48F * p.y - 0.8F * p.z, -0.8F * p.x + 0.6F * p.y, p.z + p.x};
}

void stretch(Mesh& mesh, const Vec3f& by) {
  for (Vec3f& p : mesh.positions) p = {p.x * by.x, p.y * by.y, p.z * by.z};
}

}  // namespace

Mesh damagedMesh(std::uint32_t seed) {
  Random random(seed);
  if (random.below(100) == 0) return {};
  Mesh mesh = someShape(random);
  for (std::uint32_t i = 0, size = 1 + random.below(4); i < size; ++i)
    kDamages[random.below(kDamages.size())](mesh, random);
  if (random.chance(0.2)) addProperties(mesh, random);
  if (random.below(100) == 0) mesh.triangles.clear();
  return mesh;
}

Mesh degenerateMesh(std::uint32_t seed) {
  Random random(seed);
  Mesh mesh = someShape(random);
  constexpr std::array kScales{1e-38F, 1e-30F, 1e-20F, 1e-6F, 1e6F, 1e19F, 1e30F, 1e38F};
  const float scale = kScales[random.below(kScales.size())];
  switch (random.below(6)) {
    case 0:
    case 1:
      flatten(mesh, 1 + random.below(3));
      break;
    case 2:
      stretch(mesh, {1, 1, scale < 1 ? scale : 1 / scale});
      break;
    case 3:
      shake(mesh, random);
      break;
    case 4:
      for (Vec3f& p : mesh.positions)
        p += Vec3f{1e7F, -3e6F, 1e7F * random.unit()};  // Steps of one, many fall together.
      break;
    default:
      break;
  }
  if (random.chance(0.3)) turn(mesh);
  if (random.chance(0.7)) stretch(mesh, {scale, scale, scale});
  return mesh;
}

}  // namespace pdc::test
