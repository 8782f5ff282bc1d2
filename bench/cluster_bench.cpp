// Writes a sphere of many triangles into a temporary file and clusters it from there, in pieces, with every kind of
// quadrics; then from memory. Prints million triangles per second, and the peak of the process's memory before any mesh
// was in it.

#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "parallel/machine_memory.h"
#include "parallel/with_threads.h"
#include "pdc/io/mesh/cluster_file.h"
#include "pdc/io/mesh/mesh_reader.h"

namespace {

using pdc::QuadricKind, pdc::Vec3f;

struct Request {
  double millions = 2, cell = 0.01;
  int threads = 1;
};

class TemporaryFile {
 public:
  TemporaryFile() {
    std::string folder = (std::filesystem::temp_directory_path() / "cluster_bench_XXXXXX").string();
    if (::mkdtemp(folder.data()) == nullptr) throw std::runtime_error("no temporary folder");
    mFolder = folder;
  }
  ~TemporaryFile() {
    std::error_code ignored;
    std::filesystem::remove_all(mFolder, ignored);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  [[nodiscard]] std::filesystem::path path() const { return mFolder / "sphere.ply"; }

 private:
  std::filesystem::path mFolder;
};

/// The unit sphere as the six sides of a cube, n × n squares each. Nothing of it is held in memory.
void writeSphere(const std::filesystem::path& path, std::uint32_t n) {
  std::ofstream file(path, std::ios::binary);
  file << fmt::format(
      "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n"
      "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
      6 * (n + 1) * (n + 1), 12 * n * n);
  const auto put = [&](const auto& value) { file.write(reinterpret_cast<const char*>(&value), sizeof(value)); };
  for (int side = 0; side < 6; ++side)
    for (std::uint32_t u = 0; u <= n; ++u)
      for (std::uint32_t v = 0; v <= n; ++v) {
        Vec3f p{};
        p[side % 3] = side < 3 ? 1.0F : -1.0F;
        p[(side + 1) % 3] = 2 * static_cast<float>(u) / static_cast<float>(n) - 1;
        p[(side + 2) % 3] = 2 * static_cast<float>(v) / static_cast<float>(n) - 1;
        put(p * (1 / length(p)));
      }
  struct [[gnu::packed]] Face {
    std::uint8_t count;
    std::uint32_t a, b, c;
  };
  for (std::uint32_t side = 0; side < 6; ++side)
    for (std::uint32_t u = 0; u < n; ++u)
      for (std::uint32_t v = 0; v < n; ++v) {
        const std::uint32_t a = (side * (n + 1) + u) * (n + 1) + v, b = a + n + 1, c = b + 1, d = a + 1;
        put(side < 3 ? Face{3, a, b, c} : Face{3, a, c, b});
        put(side < 3 ? Face{3, a, c, d} : Face{3, a, d, c});
      }
  if (!file.flush()) throw std::runtime_error("the sphere cannot be written: " + path.string());
}

template <typename Work>
double secondsOf(const Work& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void run(const Request& request) {
  const TemporaryFile file;
  writeSphere(file.path(), static_cast<std::uint32_t>(std::lround(std::sqrt(request.millions * 1e6 / 12))));
  const auto megabytes = [] { return static_cast<double>(pdc::detail::peakMemory()) / 1e6; };
  const double before = megabytes();
  std::vector<std::pair<std::string, pdc::ClusterOptions>> rows;
  for (const auto& [name, kind] : {std::pair{"probabilistic plane", QuadricKind::kProbabilisticPlane},
                                   {"plane", QuadricKind::kPlane},
                                   {"triangle", QuadricKind::kTriangle},
                                   {"probabilistic triangle", QuadricKind::kProbabilisticTriangle},
                                   {"point", QuadricKind::kPoint}})
    rows.push_back({name, {.cell = request.cell, .quadric = kind}});

  pdc::ClusterReport report;
  std::vector<double> fromFile;
  double peak = 0;
  for (const auto& [name, options] : rows) {
    fromFile.push_back(secondsOf([&] { static_cast<void>(pdc::clusterFile(file.path(), options, &report)); }));
    if (fromFile.size() == 1) peak = megabytes();
  }
  fmt::print("{:.2f} M triangles, a file of {:.0f} MB, into {} triangles and {} vertices\n",
             static_cast<double>(report.trianglesBefore) / 1e6,
             static_cast<double>(std::filesystem::file_size(file.path())) / 1e6, report.trianglesAfter,
             report.vertices);
  fmt::print("peak memory after the first row: {:.0f} MB, before it: {:.0f} MB\n\n", peak, before);
  const pdc::Mesh mesh = pdc::readMesh(file.path());
  fmt::print(
      "| quadrics | from the file, s | M triangles/s | from memory, s | M triangles/s |\n|---|---|---|---|---|\n");
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double fromMemory = secondsOf([&] { static_cast<void>(pdc::cluster(mesh, rows[i].second)); });
    const auto rate = [&](double seconds) { return static_cast<double>(report.trianglesBefore) / 1e6 / seconds; };
    fmt::print("| {} | {:.2f} | {:.1f} | {:.2f} | {:.1f} |\n", rows[i].first, fromFile[i], rate(fromFile[i]),
               fromMemory, rate(fromMemory));
  }
}

}  // namespace

int main(int argc, char** argv) {
  Request request;
  CLI::App app("Clusters a sphere of many triangles.", "cluster_bench");
  app.add_option("--millions", request.millions, "Triangles, in millions (2)")->check(CLI::Range(0.001, 300.0));
  app.add_option("--cell", request.cell, "Edge of the cells; the sphere's radius is 1 (0.01)")
      ->check(CLI::Range(1e-4, 1.0));
  app.add_option("--threads", request.threads, "(1); only minimising is parallel")->check(CLI::Range(1, 1024));
  CLI11_PARSE(app, argc, argv);
  try {
    pdc::detail::withThreads(request.threads, [&] { run(request); });
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
  return 0;
}
