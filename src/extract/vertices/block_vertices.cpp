#include "extract/vertices/block_vertices.h"

#include <algorithm>

#include "extract/vertices/block_sampler.h"
#include "extract/vertices/cell_rounding.h"
#include "extract/vertices/chord_lanes.h"
#include "extract/vertices/crossing_planes.h"
#include "extract/vertices/patch_lanes.h"
#include "extract/vertices/patch_solver.h"
#include "extract/vertices/patch_sums.h"
#include "math/float_lanes.h"
#include "math/lane_loops.h"
#include "pdc/math/quadric_batch.h"

namespace pdc::detail {
namespace {

/// Blocks between asking for a block's data and using it: half a microsecond or more.
constexpr std::size_t kAhead = 4;

/// One block while its vertices are being solved.
struct BlockState {
  std::int32_t index;
  std::uint64_t firstVertex;
  const EdgeIndex& edges;
  const CellMetric& metric;
  Vec3d origin;
  double cellHalfSize;  ///< See roundedCellHalfSize(); where vertices are promised to stay apart.
  const VertexOutput& out;
  VertexCounts& counts;

  /// Whether vertices outside their cells are to be noted.
  [[nodiscard]] bool notesSuspects() const { return out.suspects != nullptr; }
};

SymMat3<float> matrixCast(const SymMat3<double>& A) {
  const auto f = [](double v) { return static_cast<float>(v); };
  return {f(A.xx), f(A.xy), f(A.xz), f(A.yy), f(A.yz), f(A.zz)};
}

}  // namespace

/// Vertices are solved a register's worth at once, in single precision about their mass points. Those that leave their
/// bounds, and all where σn is too small for single precision, are solved in double.
struct BlockVertexSolver::Scratch {
  Scratch(const HermiteSource& source, const SigmaNormal& sigma, double halfSize, SimdLevel l)
      : map(source.map()),
        solver(sigma, halfSize),
        level(l),
        linear(map.affine() ? map.jacobian({}) : Mat3d{}),
        commonMetric(blockMetric(map, {})),
        sampler(source, sigma.needsNoise()),
        patchSolver(sampler, crossings, solver) {}

  /// Samples a block.
  void sample(const SurfaceBlock& block, const BlockTopology& topology, const CellMetric& metric, const Vec3d& origin,
              VertexCounts& counts) {
    sampler.run(block, topology, metric);
    counts.creases += static_cast<std::size_t>(
        std::ranges::count_if(sampler.features().patches, [](const FeaturePlanes::Patch& p) { return p.count > 1; }));
    const SigmaNormal& sigma = solver.sigma();
    if (sigma.needsNoise()) {
      counts.agreement += sampler.agreement();
      solver.setNoise(sampler.normalNoise());
    }
    counts.crossings += topology.quadCount;
    counts.withoutNormal += crossings.fill(sampler.hermite(), block.edges, metric, map, origin, level);
    Sigma_n = matrixCast(sigma.ofPatches() ? metric.G : metric.G * sigma.variance());
    if (sampler.noise() == nullptr) return;
    // A σn from the data has to wait until the sums are known.
    crossings.setNoise(*sampler.noise(), block.edges, sigma.ofPatches() ? 0 : sigma.variance());
    if (!sigma.ofPatches()) Sigma_n = {};
  }

  /// \param spreadOf see PatchLanes::measure(); only where σn is of patches.
  template <bool kOfPatches, typename SpreadOf>
  void run(const BlockState& block, const SpreadOf& spreadOf) {
    const PatchList& patches = sampler.patches();
    const std::size_t count = patches.size();
    if (!solver.batched()) {
      for (std::size_t i = 0; i < count; ++i) solveAlone(block, i);
    } else {
      if (sampler.noise() != nullptr) {
        sums.add<true>(patches, crossings, block.edges, matrixCast(block.metric.G));
      } else {
        sums.add<false>(patches, crossings, block.edges, {});
      }
      if constexpr (!kOfPatches) std::ranges::fill(lanes.variance, 1.0F);  // Sigma_n has it.
      const auto inCell = static_cast<float>(block.cellHalfSize);
      const float snapped = block.notesSuspects() ? static_cast<float>(block.cellHalfSize + kSnap) : 0.0F;
      for (std::size_t first = 0; first < count; first += kLanes) {
        const int used = static_cast<int>(std::min<std::size_t>(kLanes, count - first));
        if constexpr (kOfPatches) {
          lanes.measure(sums.lanes(first), spreadOf);
          findResiduals(block, first, used);
          lanes.chooseSigma(solver.sigma());
          for (int lane = 0; lane < used; ++lane) block.counts.sigmas.count(RootHistogram::bin(lanes.variance[lane]));
        }
        lanes.setUp(patches.patches().subspan(first), sums.lanes(first), Sigma_n);
        solveLdlt(std::span<const NormalEquationsLanes<float>>(&lanes.system, 1),
                  std::span<SolutionLanes<float>>(&lanes.step, 1), level);
        lanes.place(inCell, snapped);
        if (map.affine()) lanes.toWorld(linear, map.position(block.origin));
        write(block, first, used);
        solveLeftovers(block, first, used);
      }
    }
    if (block.out.normals != nullptr)
      for (std::size_t i = 0; i < count; ++i) block.out.normals[block.firstVertex + i] = meanNormal(block, patches[i]);
  }

  /// Finds the residuals of those patches whose normals differ.
  void findResiduals(const BlockState& block, std::size_t first, int used) {
    constexpr auto kLeast = static_cast<float>(SigmaNormal::kLeastSpread);
    if (!(maxLanes(lanes.excess) > kLeast)) return;
    chords.clear();
    for (int lane = 0; lane < used; ++lane)
      if (lanes.excess[lane] > kLeast) chords.load(lane, sampler.patches()[first + lane], block.edges, crossings);
    chords.residuals(matrixCast(block.metric.G), lanes.residual);
  }

  /// Vertices of a block are neighbours in memory.
  void write(const BlockState& block, std::size_t first, int used) {
    const PatchLanes& l = lanes;
    const std::uint64_t vertex = block.firstVertex + first;
    alignas(64) float positions[kLanes][4];
    alignas(64) PlacedQuadric copy[kLanes];
    PlacedQuadric* const whole = used == kLanes ? block.out.quadrics->run(vertex, kLanes) : nullptr;
    PlacedQuadric* const quadrics = whole != nullptr ? whole : copy;
    for (int lane = 0; lane < kLanes; lane += 4) {
      for (int part = 0; part < 3; ++part)
        transpose4(&l.placed[4 * part][lane], kLanes, reinterpret_cast<float*>(quadrics + lane) + 4 * part, 12);
      transpose4(&l.position[0][lane], kLanes, positions[lane], 4);
    }
    if (whole == nullptr)
      for (int lane = 0; lane < used; ++lane) (*block.out.quadrics)[vertex + lane] = copy[lane];
    Vec3f* position = block.out.positions + vertex;
    if (map.affine()) {
      for (int lane = 0; lane < used; ++lane)
        position[lane] = {positions[lane][0], positions[lane][1], positions[lane][2]};
      if (map.step() > 0)
        for (int lane = 0; lane < used; ++lane) position[lane] = map.rounded(vecCast<double>(position[lane]));
    } else {
      for (int lane = 0; lane < used; ++lane)
        position[lane] = worldPosition(block, sampler.patches()[first + lane], vecCast<double>(quadrics[lane].x));
    }
  }

  /// Solves those patches of a batch in double that single precision does not serve: unsolved ones, those whose
  /// vertices leave their bounds, those with planes of their own, and, where vertices are promised to stay apart,
  /// ambiguous ones.
  void solveLeftovers(const BlockState& block, std::size_t first, int used) {
    const PatchList& patches = sampler.patches();
    const FeaturePlanes& features = sampler.features();
    const auto limit = static_cast<float>(block.notesSuspects() ? block.cellHalfSize + kSnap : solver.halfSize());
    // The lower half of a number counts the patch as an exception, the upper half as outside its cell.
    constexpr std::uint32_t kOutside = 1u << 16;
    alignas(64) std::uint32_t count[kLanes];
    forEachLane([&, reach = lanes.reach, solved = lanes.step.solved](int i) {
      const std::uint32_t alone = unsigned(solved[i] == 0) | unsigned(!(reach[i] <= limit));
      const std::uint32_t outside = reach[i] > 0.5F ? kOutside : 0;
      count[i] = i < used ? (alone != 0 ? 1 : outside) : 0;
    });
    const std::uint32_t total = foldLanes(count, [](auto& a, const auto& b) { a += b; });
    if (total % kOutside == 0 && features.patches.empty() && !(block.notesSuspects() && patches.anyAmbiguous())) {
      block.counts.outOfCell += total / kOutside;
      return;
    }
    for (int lane = 0; lane < used; ++lane) {
      const std::size_t i = first + lane;
      if (count[lane] == 1 || (block.notesSuspects() && patches.ambiguous(i)) || features.find(i) != nullptr) {
        solveAlone(block, i);
      } else {
        block.counts.outOfCell += count[lane] / kOutside;
      }
    }
  }

  void solveAlone(const BlockState& block, std::size_t i) {
    const SurfacePatch& patch = sampler.patches()[i];
    patchSolver.load(i, block.edges);
    const SolvedVertex v = patchSolver.solve(block.metric);
    block.counts.outOfCell += v.outOfCell;
    block.counts.moved += v.moved;
    const std::uint64_t vertex = block.firstVertex + i;
    Vec3f x = vecCast<float>(v.x);
    if (block.notesSuspects()) {
      const CellPlacement placed =
          patchSolver.placeInCell(v.x, sampler.patches().ambiguous(i), block.cellHalfSize, block.metric);
      x = placed.place;
      if (placed.safe)
        block.out.suspects->vertices.push_back(
            {vertex, block.index, patch.cell, x, *placed.safe, patchSolver.creaseNormals(v.x, block.metric)});
    }
    block.out.positions[vertex] = worldPosition(block, patch, vecCast<double>(x));
    (*block.out.quadrics)[vertex] = {x, matrixCast(v.A), vecCast<float>(v.A * v.x - v.halfGradient)};
  }

  [[nodiscard]] Vec3f worldPosition(const BlockState& block, const SurfacePatch& patch, const Vec3d& x) const {
    const Vec3d inBlock = cellCenter(patch.cell) + x;
    return map.rounded(map.affine() ? linear * inBlock + map.position(block.origin)
                                    : map.position(block.origin + inBlock));
  }

  [[nodiscard]] Vec3f meanNormal(const BlockState& block, const SurfacePatch& patch) const {
    const HermiteBlock& hermite = sampler.hermite();
    Vec3d sum{};
    forEachEdge(patch, block.edges, [&](int /*e*/, int i) {
      sum += Vec3d{hermite.nx[i], hermite.ny[i], hermite.nz[i]};
    });
    const double l = length(sum);
    return vecCast<float>(l > 0 ? sum * (1 / l) : Vec3d{});
  }

  const LatticeMap& map;
  VertexSolver solver;
  const SimdLevel level;
  const Mat3d linear;             ///< Only where the map is affine.
  const CellMetric commonMetric;  ///< Only where the map is affine.
  BlockSampler sampler;
  CrossingPlanes crossings;
  PatchSolver patchSolver;
  PatchSums sums;
  PatchLanes lanes;
  ChordLanes chords;
  /// The noise of one normal, in lattice units: σn² G; or zero, if crossings have their own, which are in their rows.
  SymMat3<float> Sigma_n;
};

BlockVertexSolver::BlockVertexSolver(const HermiteSource& source, const SigmaNormal& sigma, double halfSize,
                                     SimdLevel level)
    : mSource(source), mScratch(std::make_unique<Scratch>(source, sigma, halfSize, level)) {}

BlockVertexSolver::~BlockVertexSolver() = default;

void BlockVertexSolver::run(std::size_t index, const Surface& surface, const VertexOutput& out, VertexCounts& counts) {
  const SurfaceBlocks& blocks = surface.blocks;
  const Coord& coord = blocks.coords[index];
  const BlockTopology& topology = surface.topology.blocks[index];
  const LatticeMap& map = mSource.map();
  Scratch& scratch = *mScratch;
  const EdgeIndex edges(blocks.signs[index]);
  const Vec3d origin = blockOrigin(coord);
  const CellMetric metric = map.affine() ? scratch.commonMetric : blockMetric(map, origin);
  if (index + kAhead < blocks.coords.size()) mSource.prefetch(blocks.coords[index + kAhead]);
  scratch.sample({coord, blocks.signs[index], edges}, topology, metric, origin, counts);
  const double cellHalfSize = out.suspects != nullptr ? roundedCellHalfSize(map, coord) : 0.5;
  const BlockState state{
      static_cast<std::int32_t>(index), topology.firstVertex, edges, metric, origin, cellHalfSize, out, counts};
  // Each way of choosing σn has a function of its own, small enough for the compiler to do its best.
  const auto solveWith = [&](const auto& spreadOf) {
    withSimd(scratch.level, [&] { scratch.run<true>(state, spreadOf); });
  };
  const SigmaNormal& sigma = scratch.solver.sigma();
  if (!sigma.ofPatches()) {
    withSimd(scratch.level, [&] { scratch.run<false>(state, nullptr); });
  } else if (metric.identity) {
    solveWith([&sigma](const SymMat3<float>& A, float n) { return sigma.spread(A, n); });
  } else {
    const SymMat3<float> H = matrixCast(metric.inverseG());
    solveWith([&sigma, H](const SymMat3<float>& A, float n) { return sigma.spread(A, n, H); });
  }
}

}  // namespace pdc::detail
