#pragma once

#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <random>
#include <tuple>

#include "pdc/mesh/mesh.h"

namespace pdc::test {

/// The square [0, 1]² in z = 0 as 2 n² triangles that look upwards.
inline Mesh plate(int n) {
  Mesh mesh;
  for (int y = 0; y <= n; ++y)
    for (int x = 0; x <= n; ++x)
      mesh.positions.push_back(
          {static_cast<float>(x) / static_cast<float>(n), static_cast<float>(y) / static_cast<float>(n), 0});
  const auto at = [n](int x, int y) { return static_cast<std::uint32_t>(y * (n + 1) + x); };
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) {
      mesh.triangles.push_back({at(x, y), at(x + 1, y), at(x + 1, y + 1)});
      mesh.triangles.push_back({at(x, y), at(x + 1, y + 1), at(x, y + 1)});
    }
  return mesh;
}

/// The boundary of [-1, 1]³ as 12 n² triangles that look outwards.
inline Mesh cube(int n) {
  Mesh mesh;
  std::map<std::tuple<int, int, int>, std::uint32_t> numbers;
  const auto vertex = [&](int axis, int side, int u, int v) {
    int c[3];
    c[axis] = side * n;
    c[(axis + 1) % 3] = u;
    c[(axis + 2) % 3] = v;
    const auto [it, isNew] = numbers.try_emplace({c[0], c[1], c[2]}, static_cast<std::uint32_t>(mesh.positions.size()));
    const auto place = [n](int k) { return 2 * static_cast<float>(k) / static_cast<float>(n) - 1; };
    if (isNew) mesh.positions.push_back({place(c[0]), place(c[1]), place(c[2])});
    return it->second;
  };
  for (int axis = 0; axis < 3; ++axis)
    for (const int side : {0, 1})
      for (int u = 0; u < n; ++u)
        for (int v = 0; v < n; ++v) {
          const std::uint32_t a = vertex(axis, side, u, v), b = vertex(axis, side, u + 1, v),
                              c = vertex(axis, side, u + 1, v + 1), d = vertex(axis, side, u, v + 1);
          mesh.triangles.push_back(side == 1 ? Triangle{a, b, c} : Triangle{a, c, b});
          mesh.triangles.push_back(side == 1 ? Triangle{a, c, d} : Triangle{a, d, c});
        }
  return mesh;
}

/// The unit sphere as 12 n² triangles.
inline Mesh sphere(int n) {
  Mesh mesh = cube(n);
  for (Vec3f& p : mesh.positions) p *= 1 / std::sqrt(dot(p, p));
  return mesh;
}

/// A torus about the z axis, radii 1 and 0.4, as 4 n² triangles.
inline Mesh torus(int n) {
  Mesh mesh;
  const int m = 2 * n;
  for (int i = 0; i < m; ++i)
    for (int k = 0; k < n; ++k) {
      const double a = 2 * std::numbers::pi * i / m, b = 2 * std::numbers::pi * k / n, r = 1 + 0.4 * std::cos(b);
      mesh.positions.push_back(vecCast<float>(Vec3d{r * std::cos(a), r * std::sin(a), 0.4 * std::sin(b)}));
    }
  const auto at = [m, n](int i, int k) { return static_cast<std::uint32_t>(i % m * n + k % n); };
  for (int i = 0; i < m; ++i)
    for (int k = 0; k < n; ++k) {
      mesh.triangles.push_back({at(i, k), at(i + 1, k), at(i + 1, k + 1)});
      mesh.triangles.push_back({at(i, k), at(i + 1, k + 1), at(i, k + 1)});
    }
  return mesh;
}

/// Moves vertices by noise of this standard deviation in each coordinate.
inline void addNoise(Mesh& mesh, double sigma) {
  std::mt19937 engine(5);
  std::normal_distribution<double> noise(0, sigma);
  for (Vec3f& p : mesh.positions)
    for (int i = 0; i < 3; ++i) p[i] += static_cast<float>(noise(engine));
}

}  // namespace pdc::test
