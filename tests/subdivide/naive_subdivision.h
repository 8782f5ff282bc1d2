#pragma once

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

// Another evaluation of subdivision, by maps of edges and by vectors of the dual space as the papers write them. It
// shares no code with what it checks.
namespace pdc::test {

/// A mesh whose vertices are vectors of any dimension.
struct NaiveMesh {
  std::vector<Eigen::VectorXd> vertices;
  std::vector<std::vector<int>> faces;
  std::set<std::pair<int, int>> creases{};  ///< Ends in ascending order.
};

namespace naive {

using EdgeKey = std::pair<int, int>;

inline EdgeKey key(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

struct Tables {
  std::map<EdgeKey, std::vector<int>> facesOf;  ///< By edge.
  std::vector<std::set<int>> neighbours, facesAt;
};

inline Tables tablesOf(const NaiveMesh& mesh) {
  Tables t;
  t.neighbours.resize(mesh.vertices.size());
  t.facesAt.resize(mesh.vertices.size());
  for (int f = 0; f < static_cast<int>(mesh.faces.size()); ++f) {
    const std::vector<int>& corners = mesh.faces[f];
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const int a = corners[k], b = corners[(k + 1) % corners.size()];
      t.facesOf[key(a, b)].push_back(f);
      t.neighbours[a].insert(b);
      t.neighbours[b].insert(a);
      t.facesAt[a].insert(f);
    }
  }
  return t;
}

inline bool isSharp(const NaiveMesh& mesh, const Tables& t, int a, int b) {
  return t.facesOf.at(key(a, b)).size() == 1 || mesh.creases.count(key(a, b)) == 1;
}

/// The neighbours of a vertex across sharp edges.
inline std::vector<int> sharpNeighbours(const NaiveMesh& mesh, const Tables& t, int v) {
  std::vector<int> found;
  for (const int w : t.neighbours[v])
    if (isSharp(mesh, t, v, w)) found.push_back(w);
  return found;
}

inline std::set<EdgeKey> splitCreases(const NaiveMesh& mesh, const std::map<EdgeKey, int>& middle) {
  std::set<EdgeKey> split;
  for (const auto& [a, b] : mesh.creases) {
    split.insert(key(a, middle.at({a, b})));
    split.insert(key(b, middle.at({a, b})));
  }
  return split;
}

}  // namespace naive

inline NaiveMesh naiveLoop(const NaiveMesh& mesh, bool warren) {
  using namespace naive;
  const Tables t = tablesOf(mesh);
  NaiveMesh r;
  for (int v = 0; v < static_cast<int>(mesh.vertices.size()); ++v) {
    const std::vector<int> sharp = sharpNeighbours(mesh, t, v);
    const Eigen::VectorXd& p = mesh.vertices[v];
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(p.size());
    if (sharp.size() > 2) {
      r.vertices.push_back(p);
    } else if (sharp.size() == 2) {
      r.vertices.push_back(0.75 * p + 0.125 * (mesh.vertices[sharp[0]] + mesh.vertices[sharp[1]]));
    } else {
      for (const int w : t.neighbours[v]) sum += mesh.vertices[w];
      const double n = static_cast<double>(t.neighbours[v].size());
      const double a = 0.375 + 0.25 * std::cos(2 * std::numbers::pi / n);
      const double alpha = warren ? (n == 3 ? 9.0 / 16 : 0.375) : 0.625 - a * a;
      r.vertices.push_back((1 - alpha) * p + alpha / n * sum);
    }
  }
  std::map<EdgeKey, int> middle;
  for (const auto& [edge, faces] : t.facesOf) {
    middle[edge] = static_cast<int>(r.vertices.size());
    const Eigen::VectorXd ends = mesh.vertices[edge.first] + mesh.vertices[edge.second];
    if (isSharp(mesh, t, edge.first, edge.second)) {
      r.vertices.push_back(ends / 2);
      continue;
    }
    Eigen::VectorXd sum = 3 * ends;
    for (const int f : faces)
      for (const int w : mesh.faces[f])
        if (w != edge.first && w != edge.second) sum += mesh.vertices[w];
    r.vertices.push_back(sum / 8);
  }
  for (const std::vector<int>& f : mesh.faces) {
    const int ab = middle[key(f[0], f[1])], bc = middle[key(f[1], f[2])], ca = middle[key(f[2], f[0])];
    r.faces.push_back({f[0], ab, ca});
    r.faces.push_back({f[1], bc, ab});
    r.faces.push_back({f[2], ca, bc});
    r.faces.push_back({ab, bc, ca});
  }
  r.creases = splitCreases(mesh, middle);
  return r;
}

inline NaiveMesh naiveCatmullClark(const NaiveMesh& mesh) {
  using namespace naive;
  const Tables t = tablesOf(mesh);
  std::vector<Eigen::VectorXd> centre;
  for (const std::vector<int>& f : mesh.faces) {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(mesh.vertices[0].size());
    for (const int v : f) sum += mesh.vertices[v];
    centre.push_back(sum / static_cast<double>(f.size()));
  }
  NaiveMesh r;
  for (int v = 0; v < static_cast<int>(mesh.vertices.size()); ++v) {
    const std::vector<int> sharp = sharpNeighbours(mesh, t, v);
    const Eigen::VectorXd& p = mesh.vertices[v];
    if (sharp.size() > 2) {
      r.vertices.push_back(p);
    } else if (sharp.size() == 2) {
      r.vertices.push_back(0.75 * p + 0.125 * (mesh.vertices[sharp[0]] + mesh.vertices[sharp[1]]));
    } else {
      const double n = static_cast<double>(t.neighbours[v].size());
      Eigen::VectorXd faceMean = Eigen::VectorXd::Zero(p.size()), edgeMean = faceMean;
      for (const int f : t.facesAt[v]) faceMean += centre[f] / n;
      for (const int w : t.neighbours[v]) edgeMean += (p + mesh.vertices[w]) / 2 / n;
      r.vertices.push_back((faceMean + 2 * edgeMean + (n - 3) * p) / n);
    }
  }
  std::map<EdgeKey, int> middle;
  for (const auto& [edge, faces] : t.facesOf) {
    middle[edge] = static_cast<int>(r.vertices.size());
    const Eigen::VectorXd ends = mesh.vertices[edge.first] + mesh.vertices[edge.second];
    if (isSharp(mesh, t, edge.first, edge.second)) {
      r.vertices.push_back(ends / 2);
    } else {
      r.vertices.push_back((ends + centre[faces[0]] + centre[faces[1]]) / 4);
    }
  }
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const std::vector<int>& c = mesh.faces[f];
    const int n = static_cast<int>(c.size()), amid = static_cast<int>(r.vertices.size());
    r.vertices.push_back(centre[f]);
    for (int k = 0; k < n; ++k)
      r.faces.push_back({c[k], middle[key(c[k], c[(k + 1) % n])], amid, middle[key(c[(k + n - 1) % n], c[k])]});
  }
  r.creases = splitCreases(mesh, middle);
  return r;
}

/// The nine numbers of equation 11.
inline Eigen::VectorXd naiveDual(const Eigen::Vector3d& mean, const Eigen::Matrix3d& covariance) {
  const Eigen::Matrix3d p = covariance.inverse();
  Eigen::VectorXd q(9);
  q << p(0, 0), p(1, 0), p(2, 0), p(1, 1), p(2, 1), p(2, 2), p * mean;
  return q;
}

/// The mean of equation 12.
inline Eigen::Vector3d naiveMean(const Eigen::VectorXd& q) {
  Eigen::Matrix3d p;
  p << q(0), q(1), q(2), q(1), q(3), q(4), q(2), q(4), q(5);
  return p.ldlt().solve(Eigen::Vector3d(q.tail<3>()));
}

/// Equations 16 and 17, with the bias as a share of each face's largest eigenvalue.
inline std::vector<Eigen::Matrix3d> naiveFaceCovariances(const std::vector<Eigen::Vector3d>& points,
                                                         const std::vector<std::vector<int>>& faces, double bias) {
  std::vector<Eigen::Matrix3d> sum(points.size(), Eigen::Matrix3d::Zero());
  for (const std::vector<int>& f : faces) {
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (const int v : f) mean += points[v] / static_cast<double>(f.size());
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
    for (const int v : f) covariance += (points[v] - mean) * (points[v] - mean).transpose();
    covariance /= static_cast<double>(f.size());
    const double largest = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance).eigenvalues()(2);
    covariance += bias * largest * Eigen::Matrix3d::Identity();
    for (const int v : f) sum[v] += covariance.inverse();
  }
  for (Eigen::Matrix3d& m : sum) m = m.inverse().eval();
  return sum;
}

}  // namespace pdc::test
