// Times contouring from an array in memory to a mesh in memory, beside OpenVDB's copyFromDense() and volumeToMesh() in
// the same process.

#include <fmt/format.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Dense.h>
#include <openvdb/tools/VolumeToMesh.h>
#include <sys/resource.h>
#include <tbb/parallel_for.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cmath>
#include <cstring>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "pdc/extract/contour.h"
#include "pdc/sample/dense/dense_source.h"

namespace {

using Size = std::array<std::int64_t, 3>;

double seconds(int repeats, const std::function<void()>& work) {
  double best = 1e30;
  for (int i = 0; i < repeats; ++i) {
    const auto start = std::chrono::steady_clock::now();
    work();
    best = std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  return best;
}

long peakMiB() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss / 1024;
}

/// A number that looks random, normal enough: the sum of four even ones, with deviation 1.
float noiseAt(std::uint64_t i) {
  float sum = 0;
  for (int k = 0; k < 4; ++k) {
    std::uint64_t h = (4 * i + static_cast<std::uint64_t>(k) + 1) * 0x9E3779B97F4A7C15;
    h = (h ^ h >> 30) * 0xBF58476D1CE4E5B9;
    h = (h ^ h >> 27) * 0x94D049BB133111EB;
    sum += static_cast<float>(h >> 40) * 0x1p-24F - 0.5F;
  }
  return sum * 1.732F;
}

template <typename T>
struct Volume {
  std::string name;
  std::int64_t n;
  bool fortran;
  double iso;
  std::vector<T> values;

  [[nodiscard]] pdc::VolumeView view() const {
    const auto s = static_cast<std::int64_t>(sizeof(T));
    pdc::VolumeView view{.data = reinterpret_cast<const std::byte*>(values.data()),
                         .type = sizeof(T) == 2 ? pdc::ScalarType::kUint16 : pdc::ScalarType::kFloat32,
                         .size = {n, n, n},
                         .stride = {s * n * n, s * n, s}};
    if (fortran) std::swap(view.stride[0], view.stride[2]);
    return view;
  }
};

/// \param value is called with coordinates from the middle, in lengths of half a side, and the value's number.
template <typename T, typename Value>
Volume<T> makeVolume(const char* name, std::int64_t n, bool fortran, double iso, const Value& value) {
  Volume<T> volume{name, n, fortran, iso, std::vector<T>(static_cast<std::size_t>(n * n * n))};
  tbb::parallel_for(std::int64_t{0}, n, [&](std::int64_t i) {
    const auto place = [n](std::int64_t k) {
      return (2 * static_cast<float>(k) - static_cast<float>(n) + 1.3F) / static_cast<float>(n);
    };
    for (std::int64_t j = 0; j < n; ++j)
      for (std::int64_t k = 0; k < n; ++k) {
        const auto at = static_cast<std::size_t>((i * n + j) * n + k);
        volume.values[at] = static_cast<T>(value(place(i), place(j), place(k), at));
      }
  });
  return volume;
}

pdc::DenseSourceOptions optionsOf(double iso) {
  pdc::DenseSourceOptions options;
  options.iso = iso;
  return options;
}

/// With OpenVDB, which knows no whole numbers of 16 bits: as floats.
template <typename T>
double timeOpenVdb(const Volume<T>& volume, int repeats, std::size_t& points) {
  const auto n = static_cast<int>(volume.n);
  const openvdb::CoordBBox box({0, 0, 0}, {n - 1, n - 1, n - 1});
  const auto toMesh = [&](const auto& dense) {
    auto grid = openvdb::FloatGrid::create(0);
    openvdb::tools::copyFromDense(dense, *grid, 0.0F);
    std::vector<openvdb::Vec3s> vertices;
    std::vector<openvdb::Vec3I> triangles;
    std::vector<openvdb::Vec4I> quads;
    openvdb::tools::volumeToMesh(*grid, vertices, triangles, quads, volume.iso);
    points = vertices.size();
  };
  using openvdb::tools::Dense;
  return seconds(repeats, [&] {
    auto* values = const_cast<T*>(volume.values.data());
    if (volume.fortran) {
      toMesh(Dense<T, openvdb::tools::LayoutXYZ>(box, values));
    } else {
      toMesh(Dense<T, openvdb::tools::LayoutZYX>(box, values));
    }
  });
}

template <typename T>
void compare(const Volume<T>& volume, int repeats) {
  std::size_t vertices = 0, points = 0;
  double signs = 0;
  const auto contourOnce = [&](const pdc::ContourOptions& options) {
    const pdc::DenseSource source(volume.view(), pdc::LatticeMap(pdc::Mat3d::identity(), {}), optionsOf(volume.iso));
    vertices = pdc::contour(source, options).positions.size();
  };
  const double certified = seconds(repeats, [&] { contourOnce({}); });
  const double cell = seconds(
      repeats, [&] { contourOnce({.sigmaNormal = pdc::kPapersSigmaNormal, .placement = pdc::Placement::kFree}); });
  const pdc::DenseSource source(volume.view(), pdc::LatticeMap(pdc::Mat3d::identity(), {}), optionsOf(volume.iso));
  signs = seconds(repeats, [&] { static_cast<void>(source.surfaceBlocks({})); });
  const double openVdb = timeOpenVdb(volume, repeats, points);
  fmt::print("{:<24}{:>6}³{:>12}{:>11.1f}{:>11.1f}{:>11.1f}{:>11.1f}{:>9.2f}{:>9.2f}{:>10}\n", volume.name, volume.n,
             vertices, 1e3 * certified, 1e3 * cell, 1e3 * signs, 1e3 * openVdb, openVdb / certified, openVdb / cell,
             peakMiB());
}

void compareAll(std::int64_t n, int repeats) {
  fmt::print("{:<24}{:>7}{:>12}{:>11}{:>11}{:>11}{:>11}{:>9}{:>9}{:>10}\n", "volume", "points", "vertices", "pdc ms",
             "free ms", "signs ms", "OpenVDB ms", "times", "free", "peak MiB");
  const auto sphere = [n](float x, float y, float z, std::size_t) {
    return (std::sqrt(x * x + y * y + z * z) - 0.7F) * static_cast<float>(n) / 2;
  };
  const auto scan = [](float x, float y, float z, std::size_t i) {
    const float r = std::sqrt(x * x + y * y + z * z);
    const float body = r < 0.8F ? 1040 : 10, bone = std::abs(r - 0.5F) < 0.05F ? 800 : 0;
    return std::max(0.0F, body + bone + 40 * noiseAt(i));
  };
  const auto waves = [](float x, float y, float z, std::size_t) {
    return std::sin(12 * x) * std::cos(12 * y) + std::sin(12 * y) * std::cos(12 * z) +
           std::sin(12 * z) * std::cos(12 * x);
  };
  compare(makeVolume<float>("sphere, float", n, false, 0, sphere), repeats);
  compare(makeVolume<float>("sphere, float, Fortran", n, true, 0, sphere), repeats);
  compare(makeVolume<float>("gyroid, float", n, false, 0, waves), repeats);
  compare(makeVolume<std::uint16_t>("scan, uint16", n, false, 525.5, scan), repeats);
  compare(makeVolume<std::uint16_t>("scan, uint16, Fortran", n, true, 525.5, scan), repeats);
}

/// Contours a file of plain values, for dense_peers.py.
void contourFile(const std::string& path, const std::string& type, const Size& size, double iso, int repeats) {
  std::ifstream file(path, std::ios::binary);
  const std::vector<char> bytes((std::istreambuf_iterator<char>(file)), {});
  const std::int64_t s = type == "float32" ? 4 : type == "uint16" ? 2 : 1;
  if (static_cast<std::int64_t>(bytes.size()) != s * size[0] * size[1] * size[2])
    throw std::runtime_error(path + " does not have that many values");
  const pdc::VolumeView view{.data = reinterpret_cast<const std::byte*>(bytes.data()),
                             .type = s == 4   ? pdc::ScalarType::kFloat32
                                     : s == 2 ? pdc::ScalarType::kUint16
                                              : pdc::ScalarType::kUint8,
                             .size = size,
                             .stride = {s * size[1] * size[2], s * size[2], s}};
  std::size_t vertices = 0;
  const double best = seconds(repeats, [&] {
    const pdc::DenseSource source(view, pdc::LatticeMap(pdc::Mat3d::identity(), {}), optionsOf(iso));
    vertices = pdc::contour(source).positions.size();
  });
  fmt::print("{} {}\n", best, vertices);
}

}  // namespace

int main(int argc, char** argv) {
  openvdb::initialize();
  CLI::App app("Contouring dense arrays");
  std::vector<std::int64_t> sizes{128, 256};
  int repeats = 3;
  std::string raw, type = "float32";
  Size size{};
  double iso = 0;
  app.add_option("--sizes", sizes, "Points along an axis")->delimiter(',');
  app.add_option("--repeats", repeats);
  app.add_option("--raw", raw, "A file of values in C order, to print the seconds and vertices of");
  app.add_option("--type", type, "Of the file: float32, uint16 or uint8");
  app.add_option("--size", size, "Of the file");
  app.add_option("--iso", iso, "Of the file");
  CLI11_PARSE(app, argc, argv);
  if (!raw.empty()) {
    contourFile(raw, type, size, iso, repeats);
    return 0;
  }
  for (const std::int64_t n : sizes) compareAll(n, repeats);
}
