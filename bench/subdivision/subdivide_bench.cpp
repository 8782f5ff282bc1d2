// Times subdivision of a torus of 100,000 triangles by three levels, products of Gaussians and the linear scheme, and
// OpenMesh's linear scheme: a markdown table.

#include <fmt/format.h>

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Subdivider/Uniform/LoopT.hh>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <limits>
#include <numbers>
#include <string>

#include "parallel/machine_memory.h"
#include "parallel/stopwatch.h"
#include "parallel/with_threads.h"
#include "pdc/mesh/buffer.h"
#include "pdc/subdivide/subdivide.h"

namespace {

using pdc::Mesh;

constexpr int kLevels = 3;

/// Two triangles for each of 250 × 200 cells, with bumps so that covariances differ.
Mesh bumpyTorus() {
  constexpr int kRound = 250, kAcross = 200;
  Mesh mesh;
  const auto at = [](int i, int j) { return static_cast<std::uint32_t>(i % kRound * kAcross + j % kAcross); };
  for (int i = 0; i < kRound; ++i)
    for (int j = 0; j < kAcross; ++j) {
      const double u = 2 * std::numbers::pi * i / kRound, v = 2 * std::numbers::pi * j / kAcross;
      const double r = 0.4 + 0.03 * std::sin(20 * u) * std::sin(15 * v), s = 1 + r * std::cos(v);
      mesh.positions.push_back(pdc::vecCast<float>(pdc::Vec3d{s * std::cos(u), s * std::sin(u), r * std::sin(v)}));
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  return mesh;
}

double processSeconds() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// Runs `work`, which returns how many vertices it made, some times and prints the best. Memory is what the first run
/// of the program adds, the meshes included; so the row that counts comes first.
void printRow(const std::string& name, int rounds, const std::function<std::size_t()>& work) {
  const std::size_t before = pdc::detail::memoryInUse(), peakBefore = pdc::detail::peakMemory();
  double wall = std::numeric_limits<double>::infinity(), busy = wall;
  std::size_t vertices = 0, peak = 0;
  for (int i = 0; i < rounds; ++i) {
    pdc::detail::Stopwatch stopwatch;
    const double start = processSeconds();
    vertices = work();
    busy = std::min(busy, processSeconds() - start);
    wall = std::min(wall, stopwatch.lap());
    if (i == 0) peak = pdc::detail::peakMemory();
  }
  const auto made = static_cast<double>(vertices);
  const std::string bytes =
      peak > peakBefore ? fmt::format("{:.0f}", static_cast<double>(peak - before) / made) : std::string("less");
  fmt::print("| {} | {} | {:.2f} | {:.2f} | {:.1f} | {} |\n", name, vertices, wall, busy, made / wall / 1e6, bytes);
  std::fflush(stdout);
}

std::size_t subdivided(const Mesh& mesh, const pdc::SubdivideOptions& options, int threads) {
  return pdc::detail::withThreads(threads, [&] { return pdc::subdivide(mesh, options).positions.size(); });
}

std::size_t subdividedByOpenMesh(const Mesh& mesh) {
  OpenMesh::TriMesh_ArrayKernelT<> work;
  for (const pdc::Vec3f& p : mesh.positions) work.add_vertex({p.x, p.y, p.z});
  for (const pdc::Triangle& t : mesh.triangles)
    work.add_face(work.vertex_handle(t[0]), work.vertex_handle(t[1]), work.vertex_handle(t[2]));
  OpenMesh::Subdivider::Uniform::LoopT<OpenMesh::TriMesh_ArrayKernelT<>> scheme;
  scheme.attach(work);
  scheme(kLevels);
  scheme.detach();
  return work.n_vertices();
}

}  // namespace

int main(int argc, char** argv) {
  const int rounds = argc > 1 ? std::max(1, std::atoi(argv[1])) : 5;
  const Mesh mesh = bumpyTorus();
  fmt::print(
      "{} triangles, {} levels; the best of {} rounds\n\n| | vertices | s | s of processors | M vertices/s | bytes a "
      "vertex |\n|---|---|---|---|---|---|\n",
      mesh.triangles.size(), kLevels, rounds);
  const pdc::SubdivideOptions gaussians{.levels = kLevels};
  pdc::SubdivideOptions linear{.levels = kLevels, .covariances = {}}, limit = gaussians;
  limit.limit = limit.normals = true;
  printRow("products of Gaussians, 2 threads", rounds, [&] { return subdivided(mesh, gaussians, 2); });
  printRow("the same, 1 thread", rounds, [&] { return subdivided(mesh, gaussians, 1); });
  printRow("the same with limits and normals, 2 threads", rounds, [&] { return subdivided(mesh, limit, 2); });
  printRow("linear, 2 threads", rounds, [&] { return subdivided(mesh, linear, 2); });
  printRow("linear, 1 thread", rounds, [&] { return subdivided(mesh, linear, 1); });
  printRow("OpenMesh, linear, 1 thread", 1, [&] { return subdividedByOpenMesh(mesh); });
}
