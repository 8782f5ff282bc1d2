// Times smoothing: a sphere with noise, on some threads, by the number of iterations and where the noise comes from.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <vector>

#include "parallel/machine_memory.h"
#include "parallel/with_threads.h"
#include "pdc/smooth/smooth.h"
#include "simplify/shapes.h"

namespace {

/// The least of some calls, in seconds.
double seconds(const pdc::Mesh& mesh, const pdc::SmoothOptions& options, int repeats) {
  double least = 1e300;
  for (int i = 0; i < repeats; ++i) {
    const auto start = std::chrono::steady_clock::now();
    const pdc::Mesh result = smooth(mesh, options);
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
    least = std::min(least, passed.count());
  }
  return least;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Rates of smoothing");
  int size = 200, threads = 2, repeats = 3;
  app.add_option("--size", size, "The sphere has 12 size² triangles (200)");
  app.add_option("--threads", threads, "(2)");
  app.add_option("--repeats", repeats, "Of how many calls the fastest counts (3)");
  CLI11_PARSE(app, argc, argv);
  pdc::Mesh mesh = pdc::test::sphere(size);
  pdc::test::addNoise(mesh, 0.2 / size);
  const auto faces = static_cast<double>(mesh.triangles.size());
  pdc::detail::withThreads(threads, [&] {
    const std::size_t before = pdc::detail::peakMemory();
    fmt::print("{} faces, {} threads\n\n| | without iterations, ms | each iteration, ms | faces/s of an iteration |\n",
               faces, threads);
    fmt::print("|---|---|---|---|\n");
    for (const auto& [name, options] : {std::pair<const char*, pdc::SmoothOptions>{"sigma 0.1", {.sigma = 0.1}},
                                        {"sigma 0.1, averaged plainly", {.sigma = 0.1, .plain = true}},
                                        {"adaptive", {}}}) {
      pdc::SmoothOptions none = options, many = options;
      none.iterations = 0;
      many.iterations = 20;
      const double fixed = seconds(mesh, none, repeats), each = (seconds(mesh, many, repeats) - fixed) / 20;
      fmt::print("| {} | {:.0f} | {:.1f} | {:.1f} M |\n", name, 1e3 * fixed, 1e3 * each, faces / each / 1e6);
    }
    fmt::print("\n{:.0f} bytes of memory per vertex besides the mesh, at most\n",
               static_cast<double>(pdc::detail::peakMemory() - before) / static_cast<double>(mesh.positions.size()));
  });
}
