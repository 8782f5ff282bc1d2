#pragma once

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <random>
#include <tuple>
#include <vector>

#include "mesh/faces.h"
#include "pdc/mesh/mesh.h"
#include "pdc/mesh/vertex_covariances.h"
#include "subdivide/naive_subdivision.h"

namespace pdc::test {

inline Vec3d toVec(const Eigen::Vector3d& p) { return {p.x(), p.y(), p.z()}; }
inline Eigen::Vector3d toEigen(const Vec3d& p) { return {p.x, p.y, p.z}; }
inline Eigen::Matrix3d toEigen(const SymMat3<double>& m) {
  Eigen::Matrix3d full;
  full << m.xx, m.xy, m.xz, m.xy, m.yy, m.yz, m.xz, m.yz, m.zz;
  return full;
}
inline SymMat3<double> toSymmetric(const Eigen::Matrix3d& m) {
  return {m(0, 0), m(0, 1), m(0, 2), m(1, 1), m(1, 2), m(2, 2)};
}

/// The cube [-1, 1]³ as six quads.
inline Mesh quadCube() {
  Mesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.positions.push_back({i % 2 == 0 ? -1.F : 1.F, i / 2 % 2 == 0 ? -1.F : 1.F, i / 4 == 0 ? -1.F : 1.F});
  mesh.quads = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  return mesh;
}

inline Mesh octahedron() {
  Mesh mesh;
  mesh.positions = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  mesh.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  return mesh;
}

/// One triangle or quad.
inline Mesh singleFace(int corners) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {2, 0, 1}, {2, 3, 0}};
  if (corners == 3) {
    mesh.triangles = {{0, 1, 2}};
  } else {
    mesh.positions.push_back({-1, 2, 0});
    mesh.quads = {{0, 1, 2, 3}};
  }
  return mesh;
}

/// A bumpy disk: a fan of triangles, or quads, about vertex 0, with a boundary.
inline Mesh fan(int n, bool quads) {
  Mesh mesh;
  mesh.positions.push_back({0, 0, 0.5F});
  const int ring = quads ? 2 * n : n;
  for (int i = 0; i < ring; ++i) {
    const double angle = 2 * std::numbers::pi * i / ring;
    const double radius = quads && i % 2 == 1 ? 1.4 : 1;
    mesh.positions.push_back({static_cast<float>(radius * std::cos(angle)),
                              static_cast<float>(radius * std::sin(angle)),
                              static_cast<float>(0.1 * std::sin(3 * angle))});
  }
  const auto at = [ring](int i) { return static_cast<std::uint32_t>(1 + i % ring); };
  for (int i = 0; i < n; ++i) {
    if (quads) {
      mesh.quads.push_back({0, at(2 * i), at(2 * i + 1), at(2 * i + 2)});
    } else {
      mesh.triangles.push_back({0, at(i), at(i + 1)});
    }
  }
  return mesh;
}

/// Figure 10 of Preiner et al. 2019: a cone over an octagon, open below, with the coordinates that the authors publish.
inline Mesh cone() {
  constexpr float kDiagonal = 1.41421F;
  Mesh mesh;
  mesh.positions = {{0, 1.5F, 0}};
  for (const auto& [x, z] : std::array<std::array<float, 2>, 8>{{{kDiagonal, -kDiagonal},
                                                                 {0, -2},
                                                                 {-kDiagonal, -kDiagonal},
                                                                 {-2, 0},
                                                                 {-kDiagonal, kDiagonal},
                                                                 {0, 2},
                                                                 {kDiagonal, kDiagonal},
                                                                 {2, 0}}})
    mesh.positions.push_back({x, -1.5F, z});
  for (std::uint32_t i = 0; i < 8; ++i) mesh.triangles.push_back({0, 1 + i, 1 + (i + 1) % 8});
  return mesh;
}

/// A hexagonal prism with a pointed roof: faces of three, four and six corners.
inline Mesh mixedFaces() {
  Mesh mesh;
  for (const float z : {0.F, 1.F})
    for (int i = 0; i < 6; ++i) {
      const double angle = std::numbers::pi * i / 3;
      mesh.positions.push_back({static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle)), z});
    }
  mesh.positions.push_back({0.1F, 0.2F, 2});
  mesh.polygons.add(std::array<std::uint32_t, 6>{5, 4, 3, 2, 1, 0});
  for (std::uint32_t i = 0; i < 6; ++i) {
    const std::uint32_t j = (i + 1) % 6;
    mesh.quads.push_back({i, j, j + 6, i + 6});
    mesh.triangles.push_back({i + 6, j + 6, 12});
  }
  return mesh;
}

/// Random covariances with eigenvalues from `least` to 1.
inline std::vector<SymMat3<double>> randomCovariances(std::size_t n, double least, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> exponent(std::log(least), 0);
  std::vector<SymMat3<double>> all;
  for (std::size_t i = 0; i < n; ++i) {
    const Eigen::Quaterniond turn =
        Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random)).normalized();
    const Eigen::Vector3d values(std::exp(exponent(random)), std::exp(exponent(random)), std::exp(exponent(random)));
    const Eigen::Matrix3d m = turn.toRotationMatrix();
    all.push_back(toSymmetric(m * values.asDiagonal() * m.transpose()));
  }
  return all;
}

inline std::vector<std::vector<int>> facesOf(const Mesh& mesh) {
  std::vector<std::vector<int>> faces;
  for (std::size_t f = 0; f < detail::faceCount(mesh); ++f) {
    const auto named = detail::face(mesh, f);
    faces.emplace_back(named.begin(), named.end());
  }
  return faces;
}

inline std::vector<Eigen::Vector3d> pointsOf(const Mesh& mesh) {
  std::vector<Eigen::Vector3d> points;
  for (const Vec3f& p : mesh.positions) points.push_back(toEigen(vecCast<double>(p)));
  return points;
}

/// The mesh with its vertices in the dual space.
inline NaiveMesh naiveGaussians(const Mesh& mesh, const std::vector<Eigen::Matrix3d>& covariances) {
  NaiveMesh naive{{}, facesOf(mesh)};
  const std::vector<Eigen::Vector3d> points = pointsOf(mesh);
  for (std::size_t v = 0; v < points.size(); ++v) naive.vertices.push_back(naiveDual(points[v], covariances[v]));
  return naive;
}

inline NaiveMesh naivePoints(const Mesh& mesh) {
  NaiveMesh naive{{}, facesOf(mesh)};
  for (const Eigen::Vector3d& p : pointsOf(mesh)) naive.vertices.emplace_back(p);
  return naive;
}

inline std::vector<Vec3d> meansOf(const NaiveMesh& naive) {
  std::vector<Vec3d> means;
  for (const Eigen::VectorXd& q : naive.vertices)
    means.push_back(toVec(q.size() == 9 ? naiveMean(q) : Eigen::Vector3d(q)));
  return means;
}

/// The largest distance from a point to its partner, where each of one set takes the nearest that is left of the other;
/// infinity where the sets differ in size or a point finds no partner within 1e-3.
template <typename Points>
double distanceOfSets(const Points& a, const std::vector<Vec3d>& b) {
  constexpr double kCell = 1e-3;
  using Cell = std::tuple<long, long, long>;
  if (a.size() != b.size()) return std::numeric_limits<double>::infinity();
  std::map<Cell, std::vector<Vec3d>> cells;
  const auto index = [](double x) { return std::lround(std::floor(x / kCell)); };
  for (const Vec3d& p : b) cells[{index(p.x), index(p.y), index(p.z)}].push_back(p);
  double most = 0;
  for (const Vec3d& p : a) {
    std::vector<Vec3d>* best = nullptr;
    std::size_t place = 0;
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 27; ++k) {
      const auto it = cells.find({index(p.x) + k % 3 - 1, index(p.y) + k / 3 % 3 - 1, index(p.z) + k / 9 - 1});
      if (it == cells.end()) continue;
      for (std::size_t i = 0; i < it->second.size(); ++i) {
        const double d = length(it->second[i] - p);
        if (d >= least) continue;
        least = d;
        best = &it->second;
        place = i;
      }
    }
    if (best == nullptr) return least;
    best->erase(best->begin() + static_cast<std::ptrdiff_t>(place));
    most = std::max(most, least);
  }
  return most;
}

}  // namespace pdc::test
