// The tables of docs/smoothing.md on meshes of which one half is clean and the other noisy, as in Figure 4 of Trettner
// & Kobbelt 2020: how far from the clean surface smoothing with one noise for all, and with that of each vertex, lies
// on either half; and beside other smoothers, how far normals beside creases are off where as much noise is gone.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <functional>
#include <map>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "pdc/extract/contour.h"
#include "pdc/field/primitives.h"
#include "pdc/io/mesh/mesh_reader.h"
#include "pdc/io/mesh/mesh_writer.h"
#include "pdc/mesh/distance.h"
#include "pdc/sample/implicit/field_source.h"
#include "pdc/smooth/smooth.h"
#include "simplify/shapes.h"
#include "smoothing/smoothing_peers.h"

namespace {

using pdc::Mesh;
using pdc::Vec3d;
using pdc::Vec3f;

/// The most noise, in mean edges, and what is little beside it.
constexpr double kMost = 0.3, kLow = 0.05;

/// Faces that turn by more than this where they meet, in the clean mesh, lie beside a crease.
constexpr double kCreaseCosine = 0.9;

Vec3d corner(const Mesh& mesh, std::uint32_t v) { return pdc::vecCast<double>(mesh.positions[v]); }

Vec3d normalOf(const Mesh& mesh, const pdc::Triangle& t) {
  const Vec3d p = corner(mesh, t[0]), n = cross(corner(mesh, t[1]) - p, corner(mesh, t[2]) - p);
  return n * (1 / std::max(length(n), 1e-300));
}

double meanEdge(const Mesh& mesh) {
  double sum = 0;
  for (const pdc::Triangle& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) sum += length(corner(mesh, t[k]) - corner(mesh, t[(k + 1) % 3]));
  return sum / (3 * static_cast<double>(mesh.triangles.size()));
}

struct Input {
  std::string name;
  Mesh clean;
  double unit = 1, middle = 0, end = 0;      ///< The mean edge; along x, where noise begins, and the end.
  std::vector<std::uint32_t> creaseFaces{};  ///< Those with noise.
};

Input makeInput(std::string name, Mesh clean) {
  Input input{std::move(name), std::move(clean)};
  input.unit = meanEdge(input.clean);
  const auto [low, high] = std::minmax_element(input.clean.positions.begin(), input.clean.positions.end(),
                                               [](const Vec3f& a, const Vec3f& b) { return a.x < b.x; });
  input.middle = 0.5 * (double{low->x} + double{high->x});
  input.end = high->x;
  std::map<std::array<std::uint32_t, 2>, std::uint32_t> firstFace;
  std::vector<std::uint32_t>& faces = input.creaseFaces;
  for (std::uint32_t f = 0; f < input.clean.triangles.size(); ++f)
    for (int k = 0; k < 3; ++k) {
      const pdc::Triangle& t = input.clean.triangles[f];
      const auto [a, b] = std::minmax(t[k], t[(k + 1) % 3]);
      const auto [it, isNew] = firstFace.try_emplace({a, b}, f);
      const pdc::Triangle& other = input.clean.triangles[it->second];
      if (isNew || dot(normalOf(input.clean, t), normalOf(input.clean, other)) > kCreaseCosine) continue;
      for (const std::uint32_t face : {f, it->second})
        if (input.clean.positions[input.clean.triangles[face][0]].x > input.middle) faces.push_back(face);
    }
  std::sort(faces.begin(), faces.end());
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
  return input;
}

/// A box with round edges, contoured.
Mesh roundedPart() {
  const pdc::FieldSource source(pdc::roundedBox({0, 0, 0}, {1, 0.7, 0.5}, 0.25),
                                {.box = {{-1.1, -0.8, -0.6}, {1.1, 0.8, 0.6}}, .voxelSize = 0.05});
  return contour(source, {.triangles = true});
}

Mesh withNoise(const Input& input, unsigned seed) {
  Mesh mesh = input.clean;
  std::mt19937 engine(seed);
  std::normal_distribution<double> normal;
  for (Vec3f& p : mesh.positions) {
    const double s = kMost * input.unit * std::max(0.0, (p.x - input.middle) / (input.end - input.middle));
    for (int axis = 0; axis < 3; ++axis) p[axis] += static_cast<float>(s * normal(engine));
  }
  return mesh;
}

/// Distances are root mean squares over vertices, to the clean mesh and back, in mean edges; the angle is that between
/// normals of faces beside creases and those of the clean mesh, in degrees.
struct Figures {
  double clean = 0, noisy = 0, whole = 0, angle = 0;

  Figures& operator+=(const Figures& o) {
    return *this = {clean + o.clean, noisy + o.noisy, whole + o.whole, angle + o.angle};
  }
  friend Figures operator*(const Figures& f, double s) { return {f.clean * s, f.noisy * s, f.whole * s, f.angle * s}; }
};

Figures measure(const Mesh& mesh, const Input& input) {
  std::array<double, 2> squares{}, count{};
  const std::array<pdc::Buffer<double>, 2> ways{vertexDistances(mesh, input.clean), vertexDistances(input.clean, mesh)};
  for (const pdc::Buffer<double>& distances : ways)
    for (std::size_t v = 0; v < distances.size(); ++v) {
      const std::size_t half = input.clean.positions[v].x > input.middle ? 1 : 0;
      squares[half] += distances[v] * distances[v];
      count[half] += 1;
    }
  Figures f;
  f.clean = std::sqrt(squares[0] / count[0]) / input.unit;
  f.noisy = std::sqrt(squares[1] / count[1]) / input.unit;
  f.whole = std::sqrt((squares[0] + squares[1]) / (count[0] + count[1])) / input.unit;
  for (const std::uint32_t face : input.creaseFaces) {
    const Vec3d a = normalOf(mesh, mesh.triangles[face]), b = normalOf(input.clean, input.clean.triangles[face]);
    f.angle += std::atan2(length(cross(a, b)), dot(a, b)) * 180 / std::numbers::pi;
  }
  if (!input.creaseFaces.empty()) f.angle /= static_cast<double>(input.creaseFaces.size());
  return f;
}

struct Method {
  std::string name;
  std::function<Mesh(const Mesh&)> smooth;
};

Figures meanFigures(const Input& input, const Method& method, unsigned seeds) {
  Figures sum;
  for (unsigned seed = 1; seed <= seeds; ++seed) sum += measure(method.smooth(withNoise(input, seed)), input);
  return sum * (1.0 / seeds);
}

Method own(const std::string& name, const pdc::SmoothOptions& options) {
  return {name, [options](const Mesh& mesh) { return pdc::smooth(mesh, options); }};
}

std::vector<Method> ownMethods() {
  return {{"as given", [](const Mesh& mesh) { return mesh; }},
          own("averaged plainly, sigma 0.05", {.sigma = kLow, .plain = true}),
          own("averaged plainly, sigma 0.3", {.sigma = kMost, .plain = true}),
          own("averaged plainly, adaptive", {.plain = true}),
          own("sigma 0.05", {.sigma = kLow}),
          own("sigma 0.3", {.sigma = kMost}),
          own("adaptive", {}),
          {"adaptive, K 5, twice", [](const Mesh& mesh) {
             const pdc::SmoothOptions half{.iterations = 5};
             return pdc::smooth(pdc::smooth(mesh, half), half);
           }}};
}

/// A smoother of another kind, from weak to strong.
struct Family {
  std::string name;
  std::vector<Method> strengths;
};

std::vector<Family> families() {
  std::vector<Family> all{{"OpenMesh Laplacian", {}}, {"CGAL curvature flow", {}}};
  const Method given{"", [](const Mesh& mesh) { return mesh; }};
  for (Family& family : all) family.strengths.push_back(given);
  for (const int n : {1, 2, 3, 4, 6, 8, 12, 16})
    all[0].strengths.push_back({"", [n](const Mesh& mesh) { return pdc::eval::openMeshLaplacian(mesh, n); }});
  for (const double t : {0.01, 0.02, 0.04, 0.08, 0.16, 0.32, 0.64})
    all[1].strengths.push_back({"", [t](const Mesh& mesh) { return pdc::eval::cgalCurvatureFlow(mesh, t, 1); }});
  for (const double sigma : {0.25, 0.35, 0.5, 0.7}) {
    all.push_back({fmt::format("bilateral normals, {}", sigma), {given}});
    for (const int n : {1, 2, 3, 4, 6, 8, 12, 20})
      all.back().strengths.push_back(
          {"", [=](const Mesh& mesh) { return pdc::eval::bilateralNormals(mesh, sigma, n, 10); }});
  }
  return all;
}

/// What a family's angle is where it has taken away as much noise: between two of its strengths. NaN if none has.
double angleAt(const std::vector<Figures>& strengths, double noisy) {
  for (std::size_t i = 1; i < strengths.size(); ++i) {
    const Figures &a = strengths[i - 1], &b = strengths[i];
    if (a.noisy >= noisy && b.noisy < noisy)
      return a.angle + (b.angle - a.angle) * (a.noisy - noisy) / (a.noisy - b.noisy);
  }
  return std::nan("");
}

void printOwn(const Input& input, unsigned seeds) {
  for (const Method& method : ownMethods()) {
    const Figures f = meanFigures(input, method, seeds);
    fmt::print("| {} | {} | {:.4f} | {:.4f} | {:.4f} | {:.2f} |\n", input.name, method.name, f.clean, f.noisy, f.whole,
               f.angle);
  }
}

void printPeers(const Input& input, unsigned seeds) {
  if (input.creaseFaces.empty()) return;
  std::vector<Figures> targets;
  for (const int k : {3, 5, 10}) targets.push_back(meanFigures(input, own("", {.iterations = k}), seeds));
  fmt::print("| {} | adaptive, K 3, 5, 10 |", input.name);
  for (const Figures& f : targets) fmt::print(" {:.4f}: {:.2f} |", f.noisy, f.angle);
  fmt::print("\n");
  for (const Family& family : families()) {
    std::vector<Figures> strengths;
    for (const Method& method : family.strengths) strengths.push_back(meanFigures(input, method, seeds));
    const Figures& best = *std::min_element(strengths.begin(), strengths.end(),
                                            [](const Figures& a, const Figures& b) { return a.noisy < b.noisy; });
    fmt::print("| | {} |", family.name);
    for (const Figures& target : targets) {
      const double angle = angleAt(strengths, target.noisy);
      fmt::print("{}", std::isnan(angle) ? std::string(" not reached |") : fmt::format(" {:.2f} |", angle));
    }
    fmt::print(" {:.4f}, {:.4f}, {:.2f} |\n", best.noisy, best.clean, best.angle);
  }
}

void writeMeshes(const Input& input, const std::filesystem::path& folder) {
  const Mesh mesh = withNoise(input, 1);
  const auto write = [&](const std::string& what, const Mesh& result) {
    writeMesh(result, folder / fmt::format("{}_{}.ply", input.name, what));
  };
  write("given", mesh);
  write("low", pdc::smooth(mesh, {.sigma = kLow, .plain = true}));
  write("high", pdc::smooth(mesh, {.sigma = kMost, .plain = true}));
  write("adaptive", pdc::smooth(mesh, {}));
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Smoothing of meshes with noise on one half");
  std::vector<std::filesystem::path> files;
  std::filesystem::path folder;
  unsigned seeds = 10;
  bool noPeers = false;
  app.add_option("FILES", files, "Meshes of triangles besides the cube and the rounded part");
  app.add_option("--seeds", seeds, "How many noises figures are the means of (10)");
  app.add_option("--meshes", folder, "Writes the meshes of the pictures here, and measures nothing");
  app.add_flag("--no-peers", noPeers, "Leaves out other smoothers");
  CLI11_PARSE(app, argc, argv);
  std::vector<Input> inputs{makeInput("cube", pdc::test::cube(24)), makeInput("rounded", roundedPart())};
  for (const auto& file : files) inputs.push_back(makeInput(file.stem().string(), pdc::readMesh(file)));
  if (!folder.empty()) {
    for (const Input& input : inputs) writeMeshes(input, folder);
    return 0;
  }
  fmt::print("| input | | clean half | noisy half | whole | crease angle |\n|---|---|---|---|---|---|\n");
  for (const Input& input : inputs) printOwn(input, seeds);
  if (noPeers) return 0;
  fmt::print(
      "\n| input | | K 3 | K 5 | K 10 | at its least noise: noisy half, clean half, angle "
      "|\n|---|---|---|---|---|---|\n");
  for (const Input& input : inputs) printPeers(input, seeds);
}
