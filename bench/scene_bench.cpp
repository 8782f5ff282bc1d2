// Measures contouring scenes: time and samples per vertex, and how both grow with the resolution, beside the time that
// sampling the whole box takes. Prints a table.

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "pdc/extract/contour.h"
#include "pdc/field/operators.h"
#include "pdc/field/primitives.h"
#include "pdc/io/scene/scene_reader.h"
#include "pdc/sample/implicit/field_source.h"

namespace {

constexpr int kRuns = 5;
/// Larger boxes, and fields of more parts, are not sampled whole.
constexpr int kMostSampled = 512;
constexpr std::size_t kMostPartsSampled = 100;

/// Counts the points that a field is asked for; a gradient counts as one.
class CountingField final : public pdc::Field {
 public:
  using Count = std::shared_ptr<std::atomic<std::size_t>>;

  CountingField(pdc::FieldPtr field, Count points) : mField(std::move(field)), mPoints(std::move(points)) {}

  void values(pdc::PointSpan points, double* values) const override {
    *mPoints += points.size;
    mField->values(points, values);
  }
  void gradients(pdc::PointSpan points, double* values, pdc::GradientSpan gradients) const override {
    *mPoints += points.size;
    mField->gradients(points, values, gradients);
  }
  [[nodiscard]] pdc::Interval bound(const pdc::Box& box) const override { return mField->bound(box); }
  [[nodiscard]] double lipschitz() const override { return mField->lipschitz(); }
  [[nodiscard]] std::size_t parts() const override { return mField->parts(); }
  [[nodiscard]] pdc::FieldPtr simplified(const pdc::Box& box) const override {
    pdc::FieldPtr field = mField->simplified(box);
    return field ? std::make_shared<CountingField>(std::move(field), mPoints) : nullptr;
  }
  [[nodiscard]] bool definedIn(const pdc::Box& box) const override { return mField->definedIn(box); }

 private:
  pdc::FieldPtr mField;
  Count mPoints;
};

/// Median of several runs after one that does not count, in milliseconds.
double milliseconds(const std::function<void()>& run) {
  std::vector<double> times;
  for (int i = 0; i <= kRuns; ++i) {
    const auto start = std::chrono::steady_clock::now();
    run();
    times.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
  }
  std::sort(times.begin() + 1, times.end());
  return times[1 + kRuns / 2];
}

/// Samples the lattice of n³ cells over a box and drops the values.
void sampleBox(const pdc::Field& field, const pdc::Box& box, int n, double h) {
  tbb::parallel_for(0, (n + 1) * (n + 1), [&](int row) {
    using Row = std::array<double, pdc::Field::kMaxBatch>;
    Row x, y, z, values;
    x.fill(box.lo.x + h * (row / (n + 1)));
    y.fill(box.lo.y + h * (row % (n + 1)));
    for (int k = 0; k <= n; k += static_cast<int>(z.size())) {
      const auto size = std::min(z.size(), static_cast<std::size_t>(n + 1 - k));
      for (std::size_t i = 0; i < size; ++i) z[i] = box.lo.z + h * (k + static_cast<double>(i));
      field.values({x.data(), y.data(), z.data(), size}, values.data());
    }
  });
}

pdc::Scene unionOf(const char* what, std::vector<pdc::FieldPtr> parts) {
  pdc::Scene scene;
  scene.name = fmt::format("{}_{}", parts.size(), what);
  scene.box = {{-1, -1, -1}, {1, 1, 1}};
  scene.field = pdc::unite(std::move(parts));
  return scene;
}

/// Cells of a cube from -1 to 1.
struct Cells {
  int perAxis;
  double step = 2.0 / perAxis;

  explicit Cells(int atLeast) : perAxis(static_cast<int>(std::ceil(std::cbrt(atLeast) - 1e-9))) {}
  /// A point of a cell, from (0, 0, 0) to (1, 1, 1).
  [[nodiscard]] pdc::Vec3d at(int cell, const pdc::Vec3d& p) const {
    const pdc::Vec3d corner{double(cell / (perAxis * perAxis)), double(cell / perAxis % perAxis),
                            double(cell % perAxis)};
    return (corner + p) * step - pdc::Vec3d{1, 1, 1};
  }
};

constexpr pdc::Vec3d kMiddle{0.5, 0.5, 0.5};

/// A union of n spheres in rows, side by side.
pdc::Scene manySpheres(int n) {
  const Cells cells(n);
  std::vector<pdc::FieldPtr> parts;
  for (int i = 0; i < n; ++i) parts.push_back(pdc::sphere(cells.at(i, kMiddle), 0.4 * cells.step));
  return unionOf("spheres", std::move(parts));
}

/// A union of n struts from the middles of cells to their corners, eight in each.
pdc::Scene manyStruts(int n) {
  constexpr int kCorners = 8;
  const Cells cells((n + kCorners - 1) / kCorners);
  std::vector<pdc::FieldPtr> parts;
  for (int i = 0; i < n; ++i) {
    const pdc::Vec3d corner{double(i >> 2 & 1), double(i >> 1 & 1), double(i & 1)};
    parts.push_back(pdc::cylinder(cells.at(i / kCorners, kMiddle), cells.at(i / kCorners, corner), 0.08 * cells.step));
  }
  return unionOf("struts", std::move(parts));
}

void printRow(const pdc::Scene& scene, int resolution, int threads, double& previous) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
  const pdc::Vec3d size = scene.box.hi - scene.box.lo;
  const double h = std::max({size.x, size.y, size.z}) / resolution;
  const auto contour = [&](const pdc::FieldPtr& field) {
    return pdc::contour(pdc::FieldSource(field, {.box = scene.box, .voxelSize = h, .iso = scene.iso}),
                        {.sigmaNormal = scene.sigmaNormal.value_or(0.05)})
        .positions.size();
  };
  const auto points = std::make_shared<std::atomic<std::size_t>>(0);
  const auto vertices = static_cast<double>(contour(std::make_shared<CountingField>(scene.field, points)));
  const double time = milliseconds([&] { contour(scene.field); });
  const auto growth = previous > 0 ? fmt::format("{:.2f}", std::log2(time / previous)) : std::string();
  const auto box = resolution <= kMostSampled && scene.field->parts() <= kMostPartsSampled
                       ? fmt::format("{:.0f}", milliseconds([&] { sampleBox(*scene.field, scene.box, resolution, h); }))
                       : std::string();
  fmt::print("{:20} {:6} {:7} {:9.0f} {:9.1f} {:10.0f} {:9.1f} {:6} {:>10}\n", scene.name, resolution, threads,
             vertices, time, 1e6 * time / vertices, static_cast<double>(*points) / vertices, growth, box);
  std::fflush(stdout);
  previous = time;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Times the contouring of scenes");
  int threads = 2;
  std::vector<std::filesystem::path> scenes;
  for (const char* name : {"sphere", "rotated_box", "gyroid", "noise_minus_sphere"})
    scenes.push_back(std::filesystem::path(PDC_SCENES) / (std::string(name) + ".yaml"));
  app.add_option("--threads", threads, "How many")->check(CLI::Range(1, 1024))->capture_default_str();
  app.add_option("SCENES", scenes, "Four of the project's own, unless others are named")->check(CLI::ExistingFile);
  int parts = 0;
  app.add_option("--parts", parts, "Unions of so many spheres and struts, instead of scenes")
      ->check(CLI::Range(1, 100'000));
  CLI11_PARSE(app, argc, argv);
  fmt::print("{:20} {:>6} {:>7} {:>9} {:>9} {:>10} {:>9} {:>6} {:>10}\n", "scene", "cells", "threads", "vertices", "ms",
             "ns/vertex", "samples/v", "2^", "box, ms");
  const auto printRows = [&](const pdc::Scene& scene, const std::vector<int>& resolutions) {
    double previous = 0;
    for (const int resolution : resolutions) printRow(scene, resolution, threads, previous);
  };
  if (parts > 0) {
    for (const pdc::Scene& scene : {manySpheres(parts), manyStruts(parts)}) printRows(scene, {128, 256});
    return 0;
  }
  for (const auto& path : scenes) {
    pdc::Scene scene = pdc::readScene(path);
    scene.name = path.stem().string();
    printRows(scene, {256, 512, 1024});
  }
  return 0;
}
