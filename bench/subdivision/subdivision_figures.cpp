// The figures of docs/subdivision.md: makes their meshes and prints their tables.
// Usage: subdivision_figures [FOLDER FOR MESHES [TWEETY.off]]

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <functional>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "pdc/io/mesh/mesh_reader.h"
#include "pdc/io/mesh/mesh_writer.h"
#include "pdc/math/gaussian_product.h"
#include "pdc/mesh/mesh_report.h"
#include "pdc/subdivide/subdivide.h"
#include "subdivide/control_meshes.h"

namespace {

using pdc::Gaussian;
using pdc::Mesh;
using pdc::SubdivideOptions;
using pdc::Vec3d;
using Matrix = pdc::SymMat3<double>;

constexpr auto kCatmullClark = pdc::SubdivisionScheme::kCatmullClark;

std::filesystem::path outputFolder;

void write(const Mesh& mesh, const std::string& name) {
  if (!outputFolder.empty()) pdc::writeMesh(mesh, outputFolder / (name + ".ply"));
}

Matrix diagonal(double x, double y, double z) { return {x, 0, 0, y, 0, z}; }

/// Variance `along` a direction of unit length, and `across` it.
Matrix along(const Vec3d& direction, double along, double across) {
  return outer(direction) * (along - across) + Matrix::identity() * across;
}

/// Angles between the normals of faces that share an edge, in degrees, in ascending order.
std::vector<double> turns(const Mesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, Vec3d> seen;
  std::vector<double> angles;
  for (std::size_t f = 0; f < pdc::detail::faceCount(mesh); ++f) {
    const auto named = pdc::detail::face(mesh, f);
    const auto at = [&](std::size_t k) { return pdc::vecCast<double>(mesh.positions[named[k]]); };
    const Vec3d normal = cross(at(2) - at(0), at(named.size() - 1) - at(1));
    for (std::size_t k = 0; k < named.size(); ++k) {
      const auto ends = std::minmax(named[k], named[(k + 1) % named.size()]);
      const auto [it, isNew] = seen.try_emplace({ends.first, ends.second}, normal);
      if (!isNew)
        angles.push_back(std::atan2(length(cross(normal, it->second)), dot(normal, it->second)) * 180 /
                         std::numbers::pi);
    }
  }
  std::sort(angles.begin(), angles.end());
  return angles;
}

/// A curve between two plane Gaussians that meet at a right angle: its largest distance from the straight line, and its
/// largest curvature.
void printCurve(const std::string& name, double tangential, double normal, double factor = 1) {
  const Gaussian a = Gaussian::fromCovariance({-1, 0, 0}, diagonal(normal, tangential, normal) * factor).value();
  const Gaussian b = Gaussian::fromCovariance({0, 1, 0}, diagonal(tangential, normal, normal)).value();
  constexpr int kSteps = 2000;
  std::vector<Vec3d> points;
  for (int i = 0; i <= kSteps; ++i) points.push_back(pdc::gaussianCurve(a, b, static_cast<double>(i) / kSteps).mean);
  double farthest = 0, bend = 0;
  for (int i = 1; i < kSteps; ++i) {
    const Vec3d u = points[i] - points[i - 1], v = points[i + 1] - points[i];
    farthest = std::max(farthest, std::abs(points[i].y - points[i].x - 1) / std::numbers::sqrt2);
    bend = std::max(bend, 2 * length(cross(u, v)) / (length(u) * length(v) * length(u + v)));
  }
  const Vec3d middle = points[kSteps / 2];
  fmt::print("| {} | {:g} | {:g} | {:.3f}, {:.3f} | {:.4f} | {:.3f} |\n", name, tangential, normal, middle.x, middle.y,
             farthest, bend);
}

void printCurves() {
  fmt::print(
      "## Figures 4 and 6\n\n| | tangential | normal variance | product at t = 1/2 | from the line | largest curvature "
      "|\n|---|---|---|---|---|---|\n");
  printCurve("4a", 1, 0.05);
  printCurve("4b, first kernel doubled", 1, 0.05, 2);
  printCurve("4b, first kernel halved", 1, 0.05, 0.5);
  for (const double t : {1.0, 0.3, 0.1, 0.06, 0.05}) printCurve("6a, less along", t, 0.05);
  for (const double n : {0.2, 0.1, 0.05, 0.02, 0.01}) printCurve("6b, 6c, less across", 1, n);
}

Mesh gaussians(Mesh mesh, const std::vector<Matrix>& covariances, SubdivideOptions options) {
  setVertexCovariances(mesh, covariances);
  options.covariances = pdc::InferenceOptions{.source = pdc::CovarianceSource::kProperties};
  return subdivide(mesh, options);
}

void printShape(const std::string& name, const Mesh& mesh, const std::string& file) {
  const pdc::MeshReport report = pdc::analyze(mesh);
  const std::vector<double> angles = turns(mesh);
  const std::string volume = report.boundaryEdges > 0 ? "open" : fmt::format("{:.3f}", report.volume);
  fmt::print("| {} | {} | {:.3f} | {} | {:.1f} | {:.1f} |\n", name, pdc::detail::faceCount(mesh), report.area, volume,
             angles[angles.size() * 999 / 1000], angles.back());
  write(mesh, file);
}

void printShapeHead(const char* title) {
  fmt::print("\n## {}\n\n| | faces | area | volume | turn of faces, 99.9 % | largest |\n|---|---|---|---|---|---|\n",
             title);
}

/// With y up, as the figure has it, turned for pictures, where z is.
Mesh upright(Mesh mesh) {
  for (pdc::Vec3f& p : mesh.positions) p = {p.x, -p.z, p.y};
  return mesh;
}

void printCones() {
  printShapeHead("Figure 10");
  const std::array<std::pair<const char*, Matrix>, 5> apexes{{{"isotropic", diagonal(0.01, 0.01, 0.01)},
                                                              {"pointed", diagonal(1e-5, 1e-5, 1e-5)},
                                                              {"concave ridge", diagonal(1e-3, 1e-2, 1e-2)},
                                                              {"plateau", diagonal(1e-2, 1e-3, 1e-2)},
                                                              {"sharp plateau", diagonal(1, 1e-5, 1)}}};
  for (const auto& [name, covariance] : apexes) {
    const Mesh cone = pdc::test::cone();
    std::vector<Matrix> all(cone.positions.size(), diagonal(0.01, 0.01, 0.01));
    all[0] = covariance;
    std::string file = std::string("cone_") + name;
    std::replace(file.begin(), file.end(), ' ', '_');
    printShape(name, upright(gaussians(cone, all, {.levels = 5, .weights = pdc::LoopWeights::kWarren})), file);
  }
}

void printCubes() {
  printShapeHead("Figure 9");
  const Mesh cube = pdc::test::quadCube();
  const SubdivideOptions options{.levels = 5, .scheme = kCatmullClark};
  SubdivideOptions linear = options;
  linear.covariances.reset();
  printShape("linear", subdivide(cube, linear), "cube_linear");
  // What each corner has, from the direction of the corner.
  const std::array<std::pair<const char*, std::function<Matrix(const Vec3d&)>>, 5> kinds{{
      {"isotropic", [](const Vec3d&) { return Matrix::identity(); }},
      {"needles", [](const Vec3d& d) { return along(d, 1, 0.02); }},
      {"plates", [](const Vec3d& d) { return along(d, 0.02, 1); }},
      {"edges", [](const Vec3d& d) { return d.z > 0 ? diagonal(1, 0.02, 0.02) : diagonal(0.02, 1, 0.02); }},
      {"small on top", [](const Vec3d& d) { return Matrix::identity() * (d.z > 0 ? 0.02 : 1); }},
  }};
  for (const auto& [name, covariance] : kinds) {
    std::vector<Matrix> all;
    for (const pdc::Vec3f& p : cube.positions)
      all.push_back(covariance(pdc::vecCast<double>(p) * (1 / std::numbers::sqrt3)));
    std::string file = std::string("cube_") + name;
    std::replace(file.begin(), file.end(), ' ', '_');
    printShape(name, gaussians(cube, all, options), file);
  }
}

/// Figure 5 of Trettner & Kobbelt 2020.
void printQuadrics() {
  printShapeHead("Quadric interpolation, Figure 5 of the other paper");
  for (const double sigma : {0.02, 0.05, 0.1, 0.2, 0.5, 2.0}) {
    const pdc::InferenceOptions normals{.source = pdc::CovarianceSource::kNormals, .sigmaNormal = sigma};
    printShape(fmt::format("σn = {:g}", sigma),
               subdivide(pdc::test::quadCube(), {.levels = 5, .scheme = kCatmullClark, .covariances = normals}),
               fmt::format("quadrics_{:g}", sigma));
  }
}

void printTweety(const std::filesystem::path& file) {
  printShapeHead("Figure 7");
  const Mesh mesh = pdc::readMesh(file);
  write(upright(mesh), "tweety");
  SubdivideOptions options{.levels = 4, .weights = pdc::LoopWeights::kWarren};
  printShape("products of Gaussians", upright(subdivide(mesh, options)), "tweety_gaussians");
  options.covariances.reset();
  printShape("linear", upright(subdivide(mesh, options)), "tweety_linear");
}

/// Figure 11 has a helix of thin quads, whose numbers are not printed: this is one of our own, closed into a ring. Each
/// ring of its corners is turned against the one before, so that quads lie askew.
Mesh twistedRing() {
  constexpr int kAround = 12, kSides = 12;
  constexpr double kRadius = 0.4, kTwist = 2;  // In sides, from ring to ring.
  Mesh mesh;
  for (int i = 0; i < kAround; ++i)
    for (int k = 0; k < kSides; ++k) {
      const double u = 2 * std::numbers::pi * i / kAround, v = 2 * std::numbers::pi * (k + kTwist * i) / kSides;
      const double s = 1 + kRadius * std::cos(v);
      mesh.positions.push_back(pdc::vecCast<float>(Vec3d{s * std::cos(u), s * std::sin(u), kRadius * std::sin(v)}));
    }
  const auto at = [](int i, int k) { return static_cast<std::uint32_t>(i % kAround * kSides + k % kSides); };
  for (int i = 0; i < kAround; ++i)
    for (int k = 0; k < kSides; ++k) mesh.quads.push_back({at(i, k), at(i + 1, k), at(i + 1, k + 1), at(i, k + 1)});
  return mesh;
}

void printRing() {
  fmt::print("\n## Figure 11\n\n| | radius, mean | deviation | mean curvature, deviation |\n|---|---|---|---|\n");
  const Mesh ring = twistedRing();
  write(ring, "ring");
  const auto print = [](const std::string& name, const Mesh& mesh) {
    double sum = 0, squares = 0, bend = 0, bends = 0;
    const auto curvature = mesh.values<float>("mean_curvature");
    const auto n = static_cast<double>(mesh.positions.size());
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
      const pdc::Vec3f p = mesh.positions[v];
      const double radius = std::hypot(std::hypot(p.x, p.y) - 1, p.z);
      sum += radius / n;
      squares += radius * radius / n;
      bend += curvature[v] / n;
      bends += static_cast<double>(curvature[v]) * curvature[v] / n;
    }
    fmt::print("| {} | {:.4f} | {:.4f} | {:.3f} |\n", name, sum, std::sqrt(squares - sum * sum),
               std::sqrt(bends - bend * bend));
    write(mesh, "ring_" + name);
  };
  SubdivideOptions options{.levels = 4, .scheme = kCatmullClark, .limit = true, .curvature = true};
  for (const double bias : {0.01, 0.05, 0.2}) {
    options.covariances = pdc::InferenceOptions{.bias = bias};
    print(fmt::format("Gaussians_{:g}", bias), subdivide(ring, options));
  }
  options.covariances.reset();
  print("linear", subdivide(ring, options));
}

/// How fast meshes come to their limit, and how fast the turn between neighbours goes.
void printLimits() {
  fmt::print(
      "\n## Limits\n\n| level | from the limit: linear | Gaussians | turn of normals: linear | Gaussians "
      "|\n|---|---|---|---|---|\n");
  Mesh cube = pdc::test::quadCube();
  setVertexCovariances(cube, pdc::test::randomCovariances(8, 0.05, 3));
  std::array<SubdivideOptions, 2> options;
  for (SubdivideOptions& o : options) o = {.scheme = kCatmullClark, .keepPlaces = true};
  options[0].covariances.reset();
  options[1].covariances->source = pdc::CovarianceSource::kProperties;
  for (int level = 1; level <= 8; ++level) {
    std::array<double, 2> distance{}, turn{};
    for (std::size_t i = 0; i < 2; ++i) {
      SubdivideOptions o = options[i];
      o.levels = level;
      pdc::SubdivideReport mesh, limit;
      (void)subdivide(cube, o, &mesh);
      o.limit = o.normals = true;
      const Mesh onLimit = subdivide(cube, o, &limit);
      for (std::size_t v = 0; v < limit.places.size(); ++v)
        distance[i] = std::max(distance[i], length(limit.places[v] - mesh.places[v]) / 2);
      for (const pdc::Quad& q : onLimit.quads)
        for (std::size_t k = 0; k < 4; ++k)
          turn[i] = std::max<double>(turn[i], length(onLimit.normals[q[k]] - onLimit.normals[q[(k + 1) % 4]]));
    }
    fmt::print("| {} | {:.2e} | {:.2e} | {:.4f} | {:.4f} |\n", level, distance[0], distance[1], turn[0], turn[1]);
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc > 1) outputFolder = argv[1];
    printCurves();
    printCones();
    printCubes();
    printQuadrics();
    if (argc > 2) printTweety(argv[2]);
    printRing();
    printLimits();
  } catch (const std::exception& e) {
    fmt::print(stderr, "subdivision_figures: {}\n", e.what());
    return 1;
  }
}
