// Contouring a level-set sphere, grid in memory to mesh in memory, beside OpenVDB's own mesher in the same process.

#include <benchmark/benchmark.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/LevelSetSphere.h>
#include <openvdb/tools/VolumeToMesh.h>
#include <tbb/global_control.h>

#include <map>

#include "pdc/extract/contour.h"
#include "pdc/sample/grid_source.h"

namespace {

openvdb::FloatGrid::Ptr sphere(int radius) {
  static std::map<int, openvdb::FloatGrid::Ptr> made;
  auto& grid = made[radius];
  if (!grid)
    grid = openvdb::tools::createLevelSetSphere<openvdb::FloatGrid>(static_cast<float>(radius), openvdb::Vec3f(0), 1.0F,
                                                                    3.0F);
  return grid;
}

void report(benchmark::State& state, std::size_t vertices) {
  state.counters["time_per_vertex"] = benchmark::Counter(
      static_cast<double>(vertices), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

/// Arguments: radius in voxels, threads.
void pdcContour(benchmark::State& state, pdc::Placement placement) {
  const auto grid = sphere(static_cast<int>(state.range(0)));
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(state.range(1)));
  std::size_t vertices = 0;
  for (auto _ : state) {
    const pdc::Mesh mesh = pdc::contour(pdc::GridSource(grid), {.placement = placement});
    vertices = mesh.positions.size();
    benchmark::DoNotOptimize(mesh.quads.data());
  }
  report(state, vertices);
}

void volumeToMesh(benchmark::State& state) {
  const auto grid = sphere(static_cast<int>(state.range(0)));
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(state.range(1)));
  std::size_t vertices = 0;
  for (auto _ : state) {
    openvdb::tools::VolumeToMesh mesher(0, 0);
    mesher(*grid);
    vertices = mesher.pointListSize();
  }
  report(state, vertices);
}

void sizes(benchmark::internal::Benchmark* b) {
  b->ArgNames({"radius", "threads"})->ArgsProduct({{100, 300}, {1, 2}});
  b->Unit(benchmark::kMillisecond)->UseRealTime()->MinTime(0.1)->Repetitions(7)->ReportAggregatesOnly();
}

BENCHMARK_CAPTURE(pdcContour, cell, pdc::Placement::kCell)->Apply(sizes);
BENCHMARK_CAPTURE(pdcContour, free, pdc::Placement::kFree)->Apply(sizes);
BENCHMARK(volumeToMesh)->Apply(sizes);

}  // namespace

int main(int argc, char** argv) {
  openvdb::initialize();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
}
