// Times contouring from grid in memory to mesh in memory, beside OpenVDB's own mesher in the same process.

#include <benchmark/benchmark.h>
#include <openvdb/io/File.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Composite.h>
#include <openvdb/tools/LevelSetSphere.h>
#include <openvdb/tools/LevelSetUtil.h>
#include <openvdb/tools/VolumeToMesh.h>
#include <sys/resource.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <cstdio>
#include <cstring>
#include <functional>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "pdc/extract/contour.h"
#include "pdc/sample/vdb/grid_source.h"

namespace {

using openvdb::FloatGrid;

FloatGrid::Ptr sphere(float radius) {
  return openvdb::tools::createLevelSetSphere<FloatGrid>(radius, openvdb::Vec3f(0), 1.0F, 3.0F);
}

FloatGrid::Ptr fogSphere(float radius) {
  const FloatGrid::Ptr grid = sphere(radius);
  openvdb::tools::sdfToFogVolume(*grid);
  return grid;
}

/// n³ voxels of a level set about +1, each drawn by itself: data as rough as can be.
template <typename Value>
FloatGrid::Ptr rough(int n, Value&& value) {
  const FloatGrid::Ptr grid = FloatGrid::create(1);
  grid->setGridClass(openvdb::GRID_LEVEL_SET);
  for (int x = 0; x < n; ++x)
    for (int y = 0; y < n; ++y)
      for (int z = 0; z < n; ++z) grid->tree().setValueOn({x, y, z}, value(x, y, z));
  return grid;
}

FloatGrid::Ptr checkerboard(int n) {
  return rough(n, [](int x, int y, int z) { return (x + y + z) % 2 == 0 ? -1.0F : 1.0F; });
}

FloatGrid::Ptr noise(int n) {
  std::mt19937 random(1);
  std::normal_distribution<float> normal;
  return rough(n, [&](int, int, int) { return normal(random); });
}

/// A level set of so many droplets, some of which overlap, in a cube of n³ voxels.
FloatGrid::Ptr droplets(int count, int n) {
  std::mt19937 random(2);
  std::uniform_real_distribution<float> place(0, static_cast<float>(n)), radius(2, 8);
  FloatGrid::Ptr all = openvdb::createLevelSet<FloatGrid>(1.0F, 3.0F);
  for (int i = 0; i < count; ++i) {
    const openvdb::Vec3f center(place(random), place(random), place(random));
    openvdb::tools::csgUnion(*all,
                             *openvdb::tools::createLevelSetSphere<FloatGrid>(radius(random), center, 1.0F, 3.0F));
  }
  return all;
}

/// The first float grid of a file; null where there is none.
FloatGrid::Ptr read(const std::string& path) {
  openvdb::io::File file(path);
  file.open(false);
  const openvdb::GridPtrVecPtr grids = file.getGrids();
  for (const openvdb::GridBase::Ptr& grid : *grids)
    if (const auto typed = openvdb::gridPtrCast<FloatGrid>(grid)) return typed;
  return nullptr;
}

/// A grid that is made when it is first asked for, so that what a filter leaves out costs nothing.
class LazyGrid {
 public:
  explicit LazyGrid(std::function<FloatGrid::Ptr()> make) : mMake(std::move(make)) {}

  const FloatGrid::Ptr& get() const {
    if (!mGrid) mGrid = mMake();
    return mGrid;
  }

 private:
  std::function<FloatGrid::Ptr()> mMake;
  mutable FloatGrid::Ptr mGrid;
};

struct Input {
  std::string name;
  std::shared_ptr<const LazyGrid> grid;

  Input(std::string label, std::function<FloatGrid::Ptr()> make)
      : name(std::move(label)), grid(std::make_shared<LazyGrid>(std::move(make))) {}
};

void report(benchmark::State& state, std::size_t vertices) {
  state.counters["time_per_vertex"] = benchmark::Counter(
      static_cast<double>(vertices), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  state.counters["vertices"] = static_cast<double>(vertices);
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  state.counters["peak_MiB"] = static_cast<double>(usage.ru_maxrss) / 1024;  // The peak of the process up to now.
}

tbb::global_control limitThreads(const benchmark::State& state) {
  return {tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(state.range(0))};
}

void pdcContour(benchmark::State& state, const FloatGrid::Ptr& grid, pdc::Placement placement,
                pdc::HermiteMode hermite) {
  const auto threads = limitThreads(state);
  pdc::ContourOptions options{.placement = placement};
  if (hermite == pdc::HermiteMode::kGradient) options.sigmaNormal = pdc::kPapersSigmaNormal;
  std::size_t vertices = 0;
  for (auto _ : state) {
    const pdc::Mesh mesh = pdc::contour(pdc::GridSource(grid, {.hermite = hermite}), options);
    vertices = mesh.positions.size();
    benchmark::DoNotOptimize(mesh.quads.data());
  }
  report(state, vertices);
}

void volumeToMesh(benchmark::State& state, const FloatGrid::Ptr& grid) {
  const auto threads = limitThreads(state);
  // The isovalue that GridSource takes by default.
  const double iso = grid->getGridClass() == openvdb::GRID_LEVEL_SET ? 0.0 : 0.5;
  std::size_t vertices = 0;
  for (auto _ : state) {
    openvdb::tools::VolumeToMesh mesher(iso, 0);
    mesher(*grid);
    vertices = mesher.pointListSize();
  }
  report(state, vertices);
}

/// Copies what contouring has to move at least, every leaf in and every vertex and quad out.
void roofline(benchmark::State& state, const FloatGrid::Ptr& grid) {
  const auto threads = limitThreads(state);
  const std::size_t vertices =
      pdc::contour(pdc::GridSource(grid), {.placement = pdc::Placement::kFree}).positions.size();
  const std::size_t in = grid->tree().leafCount() * FloatGrid::TreeType::LeafNodeType::SIZE * sizeof(float);
  const std::size_t out = vertices * (sizeof(pdc::Vec3f) + sizeof(pdc::Quad));
  const std::vector<char> from((in + out) / 2, 1);
  std::vector<char> to(from.size());
  for (auto _ : state) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, from.size(), std::size_t{1} << 20),
                      [&](const auto& r) { std::memcpy(to.data() + r.begin(), from.data() + r.begin(), r.size()); });
    benchmark::ClobberMemory();
  }
  report(state, vertices);
}

void add(const std::string& what, const Input& input, const std::function<void(benchmark::State&)>& run) {
  benchmark::RegisterBenchmark((what + "/" + input.name).c_str(), run)
      ->ArgName("threads")
      ->Arg(1)
      ->Arg(2)
      ->Unit(benchmark::kMillisecond)
      ->UseRealTime()
      ->MinTime(0.01)
      ->Repetitions(7)
      ->ReportAggregatesOnly();
}

void addAll(const Input& input) {
  const std::shared_ptr<const LazyGrid> grid = input.grid;
  struct Variant {
    const char* name;
    pdc::Placement placement;
    pdc::HermiteMode hermite;
  };
  using pdc::HermiteMode, pdc::Placement;
  for (const Variant& v : {Variant{"pdc_free", Placement::kFree, HermiteMode::kGradient},
                           Variant{"pdc_cell", Placement::kCell, HermiteMode::kGradient},
                           Variant{"pdc_certified", Placement::kCertified, HermiteMode::kGradient},
                           Variant{"pdc_default", Placement::kCertified, HermiteMode::kAuto}})
    add(v.name, input, [grid, v](benchmark::State& s) { pdcContour(s, grid->get(), v.placement, v.hermite); });
  add("volume_to_mesh", input, [grid](benchmark::State& s) { volumeToMesh(s, grid->get()); });
  add("roofline", input, [grid](benchmark::State& s) { roofline(s, grid->get()); });
}

}  // namespace

/// Takes, beyond the arguments of Google Benchmark, .vdb files to contour too, --large for the sphere of radius 1600,
/// and --rough for grids without a smooth surface.
int main(int argc, char** argv) {
  openvdb::initialize();
  benchmark::Initialize(&argc, argv);
  addAll({"sphere_100", [] { return sphere(100); }});
  addAll({"sphere_300", [] { return sphere(300); }});
  addAll({"fog_sphere_300", [] { return fogSphere(300); }});
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument == "--large") {
      addAll({"sphere_1600", [] { return sphere(1600); }});
    } else if (argument == "--rough") {
      for (const int n : {16, 48}) {
        addAll({"checkerboard_" + std::to_string(n), [n] { return checkerboard(n); }});
        addAll({"noise_" + std::to_string(n), [n] { return noise(n); }});
      }
      addAll({"droplets_300", [] { return droplets(300, 110); }});
    } else if (const FloatGrid::Ptr grid = read(argument)) {
      addAll({argument.substr(argument.rfind('/') + 1), [grid] { return grid; }});
    } else {
      std::fprintf(stderr, "contour_bench: %s holds no float grid\n", argv[i]);
      return 1;
    }
  }
  benchmark::RunSpecifiedBenchmarks();
}
