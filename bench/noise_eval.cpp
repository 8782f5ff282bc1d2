// The tables of docs/decimation.md on meshes whose noise is known vertex by vertex: how many vertices decimation spends
// in noise, and how far from the clean surface it lies where there is noise and where there is none.

#include <fmt/format.h>
#include <openvdb/openvdb.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "eval/inputs.h"
#include "eval/shapes.h"
#include "pdc/extract/contour.h"
#include "pdc/io/mesh/mesh_reader.h"
#include "pdc/mesh/distance.h"
#include "pdc/sample/vdb/grid_source.h"
#include "pdc/simplify/decimate.h"
#include "simplify/shapes.h"

namespace {

using pdc::Mesh;
using pdc::Vec3d;
using pdc::Vec3f;

constexpr std::size_t kSamples = 60'000;
constexpr double kShares[] = {0.05, 0.15, 0.3};

struct Method {
  const char* name;
  pdc::DecimateOptions options;
};

/// Garland & Heckbert's planes first.
std::vector<Method> methods() {
  return {{"classical planes", {.quadric = pdc::QuadricKind::kPlane, .memory = 1, .fit = false}},
          {"`pdc`", {}},
          {"`pdc`, `--sigma-property`", {.sigmaProperty = "sigma"}}};
}

Vec3d corner(const Mesh& mesh, std::uint32_t v) { return pdc::vecCast<double>(mesh.positions[v]); }

/// Points evenly spread over the area of a mesh of triangles.
std::vector<Vec3f> samples(const Mesh& mesh) {
  std::vector<double> sums;
  double sum = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    sum += length(cross(corner(mesh, b) - corner(mesh, a), corner(mesh, c) - corner(mesh, a)));
    sums.push_back(sum);
  }
  std::mt19937 engine(1);
  std::uniform_real_distribution<double> share(0, 1);
  std::vector<Vec3f> points;
  while (points.size() < kSamples) {
    const auto it = std::lower_bound(sums.begin(), sums.end(), share(engine) * sum);
    const auto& [a, b, c] = mesh.triangles[std::min<std::size_t>(it - sums.begin(), sums.size() - 1)];
    double u = share(engine), v = share(engine);
    if (u + v > 1) {
      u = 1 - u;
      v = 1 - v;
    }
    const Vec3d p = corner(mesh, a);
    points.push_back(pdc::vecCast<float>(p + (corner(mesh, b) - p) * u + (corner(mesh, c) - p) * v));
  }
  return points;
}

/// A mesh with noise on one side.
struct Input {
  std::string name;
  Mesh clean, noisy;
  double from = 0, third = 0, end = 0;  ///< Along x, where noise begins, its last third of the mesh, and the end.
  double unit = 1;                      ///< What distances are given in.
};

struct Figures {
  double share = 0, noisy = 0, clean = 0;
};

Figures measure(const Mesh& mesh, const Input& input) {
  Figures f;
  for (const Vec3f& p : mesh.positions) f.share += p.x > input.third ? 1 : 0;
  f.share /= static_cast<double>(mesh.positions.size());
  // To the clean surface and back.
  for (const auto& [from, to] : {std::pair{&mesh, &input.clean}, std::pair{&input.clean, &mesh}}) {
    const std::vector<Vec3f> points = samples(*from);
    const pdc::Buffer<double> all = distances(points, *to);
    std::array<double, 2> sum{}, count{};
    for (std::size_t i = 0; i < all.size(); ++i) {
      const std::size_t half = points[i].x > input.from ? 1 : 0;
      sum[half] += all[i];
      ++count[half];
    }
    f.clean += sum[0] / count[0] / 2 / input.unit;
    f.noisy += sum[1] / count[1] / 2 / input.unit;
  }
  return f;
}

void printRows(const Input& input) {
  const Figures given = measure(input.noisy, input);
  fmt::print("| {} | | | {:.1f} % | {:.4f} | {:.4f} |\n", input.name, 100 * given.share, given.noisy, given.clean);
  for (const double share : kShares)
    for (const Method& method : methods()) {
      pdc::DecimateOptions options = method.options;
      options.ratio = share;
      const Figures f = measure(decimate(input.noisy, options), input);
      fmt::print("| | {:.0f} % | {} | {:.1f} % | {:.4f} | {:.4f} |\n", 100 * share, method.name, 100 * f.share, f.noisy,
                 f.clean);
    }
}

double meanEdge(const Mesh& mesh) {
  double sum = 0;
  for (const pdc::Triangle& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) sum += length(corner(mesh, t[k]) - corner(mesh, t[(k + 1) % 3]));
  return sum / (3 * static_cast<double>(mesh.triangles.size()));
}

void setRange(Input& input) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Vec3f& p : input.clean.positions) {
    low = std::min(low, double{p.x});
    high = std::max(high, double{p.x});
  }
  input.from = (low + high) / 2;
  input.third = low + (high - low) * 2 / 3;
  input.end = high;
}

/// Noise in each coordinate that grows from the middle on, up to `most` mean edges.
Input noisyHalf(const std::string& name, const Mesh& clean, double most) {
  Input input{fmt::format("{}, noise up to {}", name, most), clean, clean};
  input.unit = meanEdge(clean);
  setRange(input);
  std::mt19937 engine(5);
  std::normal_distribution<double> normal;
  pdc::Buffer<float> sigma;
  for (Vec3f& p : input.noisy.positions) {
    const double s = most * input.unit * std::max(0.0, (p.x - input.from) / (input.end - input.from));
    sigma.push_back(static_cast<float>(s));
    for (int axis = 0; axis < 3; ++axis) p[axis] += static_cast<float>(s * normal(engine));
  }
  input.noisy.properties = {{"sigma", 1, sigma}};
  return input;
}

/// Contoured from distances with noise that grows from 0 at one end to `noise` voxels at the other.
Input contoured(const pdc::eval::Shape& shape, double noise, double size) {
  constexpr unsigned kPose = 910000;
  const pdc::eval::Pose pose = pdc::eval::randomPose(kPose, size);
  const auto mesh = [&](const openvdb::FloatGrid::Ptr& grid) {
    return contour(pdc::GridSource(grid), {.triangles = true, .confidence = true});
  };
  Input input{fmt::format("{}, noise up to {}", shape.name, noise),
              mesh(pdc::eval::makeGrid("exact", shape, pose, 0, 1).grid),
              mesh(pdc::eval::makeGradedGrid(shape, pose, noise, 1).grid)};
  setRange(input);
  return input;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Decimation of meshes whose noise is known vertex by vertex");
  std::vector<std::filesystem::path> files;
  double size = 24;
  app.add_option("FILES", files, "Meshes of triangles besides the cube");
  app.add_option("--size", size, "Half the size of the solids that are contoured, in voxels");
  CLI11_PARSE(app, argc, argv);
  openvdb::initialize();
  constexpr const char* kHead =
      "| input | to | | vertices in the noisy third | noisy half | clean half |\n|---|---|---|---|---|---|\n";
  fmt::print("Noise of vertices, in mean edges:\n\n{}", kHead);
  for (const double most : {0.2, 0.5}) {
    printRows(noisyHalf("cube", pdc::test::cube(40), most));
    for (const auto& file : files) printRows(noisyHalf(file.stem().string(), pdc::readMesh(file), most));
  }
  fmt::print("\nNoise of distances, in voxels:\n\n{}", kHead);
  for (const pdc::eval::Shape& shape : pdc::eval::makeShapes(size))
    for (const char* const name : {"box", "cylinder", "sphere"})
      if (shape.name == name)
        for (const double noise : {0.2, 0.5}) printRows(contoured(shape, noise, size));
}
