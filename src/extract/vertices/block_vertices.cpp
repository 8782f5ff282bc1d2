#include "extract/vertices/block_vertices.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "extract/topology/patch_list.h"
#include "extract/vertices/cell_rounding.h"
#include "extract/vertices/crossing_planes.h"
#include "extract/vertices/patch_sums.h"
#include "math/float_lanes.h"
#include "math/lane_loops.h"
#include "pdc/math/quadric_batch.h"
#include "sample/creases/sheet_cosine.h"
#include "sample/patch_edges.h"

namespace pdc::detail {
namespace {

/// Blocks between asking for a block's data and using it: half a microsecond or more.
constexpr std::size_t kAhead = 4;

/// Half the size of the part of a block's cells whose points stay well within the cell when their world coordinates are
/// rounded to single precision.
double cellHalfSize(const LatticeMap& map, const Coord& block) {
  return 0.5 - std::clamp(4 * cellRounding(map, block), kCellMargin, 0.25);
}

/// A vertex no farther than this, in lattice units, beyond that part of its cell is put back into it: surfaces that lie
/// on lattice planes have all their vertices there, give or take rounding.
constexpr double kSnap = 1e-4;
/// Nor does a vertex leave its cell if its planes stay nearer than this, in voxels, or nearer than `kFit` times what
/// they are from its free place: where noise keeps them from meeting, vertices outside their cells fold faces and are
/// no more exact. Beside creases the free place is many times nearer. With kFit 1 instead of 2, noise of 0.1 voxel and
/// plain gradients, eight times as many vertices are drawn back, and the dragon takes twice as long.
constexpr double kFlatness = 1e-3, kFit = 2;

/// Exact normals tell of a crease if a vertex misses their planes by no more, in voxels.
constexpr double kExact = 0.01;

float reach(const Vec3f& x) { return std::max({std::abs(x.x), std::abs(x.y), std::abs(x.z)}); }

template <typename T>
void clampToCube(Vec3<T>& x, double halfSize) {
  for (int i = 0; i < 3; ++i) x[i] = std::clamp(x[i], static_cast<T>(-halfSize), static_cast<T>(halfSize));
}

/// One block while its vertices are being solved.
struct BlockState {
  std::int32_t index;
  std::uint64_t firstVertex;
  const EdgeIndex& edges;
  const CellMetric& metric;
  Vec3d origin;
  double cellHalfSize;  ///< Of the part of a cell whose points stay in the cell when they are rounded; if promised.
  const VertexOutput& out;
  VertexCounts& counts;
};

/// Sixteen patches, one per lane; those beyond the block's last repeat it.
struct PatchLanes {
  alignas(64) std::uint32_t cell[kLanes];
  NormalEquationsLanes<float> system;  ///< About the mass points.
  SolutionLanes<float> step;
  Vec3Lanes<float> mass;  ///< From the low corner of the cell.
  alignas(64) float reach[kLanes];
  alignas(64) float error[12][kLanes];  ///< Of VertexError.
  alignas(64) float position[4][kLanes];
};

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
        exactNormals(source.exactNormals()),
        noise(source.knowsNoise() ? std::make_unique<PlaneNoise>() : nullptr) {
    samples.noisy = noise != nullptr;
  }

  /// \param sigmaOf see solve().
  template <typename SigmaOf>
  void run(const BlockState& block, const SigmaOf& sigmaOf) {
    const std::size_t count = patches.size();
    if (!solver.batched()) {
      for (std::size_t i = 0; i < count; ++i) solveAlone(block, i);
    } else {
      if (noise != nullptr) {
        sums.add<true>(patches, crossings, block.edges, matrixCast(block.metric.G));
      } else {
        sums.add<false>(patches, crossings, block.edges, {});
      }
      for (std::size_t first = 0; first < count; first += kLanes) {
        const int used = static_cast<int>(std::min<std::size_t>(kLanes, count - first));
        setUp(first, sigmaOf);
        solveLdlt(std::span<const NormalEquationsLanes<float>>(&lanes.system, 1),
                  std::span<SolutionLanes<float>>(&lanes.step, 1), level);
        place(block);
        write(block, first, used);
        solveSomeAlone(block, first, used);
      }
    }
    if (block.out.normals != nullptr)
      for (std::size_t i = 0; i < count; ++i) block.out.normals[block.firstVertex + i] = meanNormal(block, patches[i]);
  }

  /// About its mass point a patch's right-hand side is small where the surface is flat, and so is what rounding does to
  /// the solution.
  /// \param sigmaOf the patch's σn² over that in Sigma_n, from its Σrrᵀ.
  template <typename SigmaOf>
  void setUp(std::size_t first, const SigmaOf& sigmaOf) {
    const SymMat3<float> S = Sigma_n;
    const PatchSumLanes& sum = sums.lanes(first);
    PatchLanes& l = lanes;
    const auto some = patches.patches().subspan(first);
    for (std::size_t lane = 0; lane < kLanes; ++lane) l.cell[lane] = some[std::min(lane, some.size() - 1)].cell;
    forEachLane([&](int i) {
      const float n = sum.weight(i);
      const Vec3f mass = sum.place(i) * (1.0F / n);
      const SymMat3<float> A = sum.A(i);
      l.mass.set(i, mass);
      l.system.b.set(i, sum.b(i) - A * mass);
      l.system.A.set(i, A + S * (n * sigmaOf(A, n)));
    });
  }

  void place(const BlockState& block) {
    PatchLanes& l = lanes;
    const bool promised = block.out.suspects != nullptr;
    const auto inCell = static_cast<float>(block.cellHalfSize);
    const float snapped = promised ? static_cast<float>(block.cellHalfSize + kSnap) : 0.0F;
    forEachLane([&](int i) {
      const Vec3f v = l.mass.get(i) - Vec3f{0.5F, 0.5F, 0.5F} + l.step.x.get(i);
      const SymMat3<float> A = l.system.A.get(i);
      const Vec3f b = A * v;
      const float ax = std::abs(v.x), ay = std::abs(v.y), az = std::abs(v.z), xy = ax > ay ? ax : ay;
      const float reach = xy > az ? xy : az;
      const float bound = reach <= snapped ? inCell : std::numeric_limits<float>::max();
      const auto clamped = [bound](float c) { return c > bound ? bound : c < -bound ? -bound : c; };
      l.reach[i] = reach;
      const float e[12] = {clamped(v.x), clamped(v.y), clamped(v.z), A.xx, A.xy, A.xz, A.yy, A.yz, A.zz, b.x, b.y, b.z};
      for (int k = 0; k < 12; ++k) l.error[k][i] = e[k];
    });
    if (!map.affine()) return;
    const Vec3d base = map.position(block.origin);
    forEachLane([&](int i) {
      const auto from = [](std::uint32_t low, float x) { return double(static_cast<float>(low) + 0.5F) + double(x); };
      const std::uint32_t cell = l.cell[i];
      const Vec3d inBlock{from(cell >> 6, l.error[0][i]), from(cell >> 3 & 7, l.error[1][i]),
                          from(cell & 7, l.error[2][i])};
      const Vec3d p = linear * inBlock + base;
      l.position[0][i] = static_cast<float>(p.x);
      l.position[1][i] = static_cast<float>(p.y);
      l.position[2][i] = static_cast<float>(p.z);
    });
  }

  /// Vertices of a block are neighbours in memory.
  void write(const BlockState& block, std::size_t first, int used) {
    const PatchLanes& l = lanes;
    const std::uint64_t vertex = block.firstVertex + first;
    alignas(64) float positions[kLanes][4];
    alignas(64) VertexError copy[kLanes];
    VertexError* const whole = used == kLanes ? block.out.errors->run(vertex, kLanes) : nullptr;
    VertexError* const errors = whole != nullptr ? whole : copy;
    for (int lane = 0; lane < kLanes; lane += 4) {
      for (int part = 0; part < 3; ++part)
        transpose4(&l.error[4 * part][lane], kLanes, reinterpret_cast<float*>(errors + lane) + 4 * part, 12);
      transpose4(&l.position[0][lane], kLanes, positions[lane], 4);
    }
    if (whole == nullptr)
      for (int lane = 0; lane < used; ++lane) (*block.out.errors)[vertex + lane] = copy[lane];
    Vec3f* position = block.out.positions + vertex;
    if (map.affine()) {
      for (int lane = 0; lane < used; ++lane)
        position[lane] = {positions[lane][0], positions[lane][1], positions[lane][2]};
    } else {
      for (int lane = 0; lane < used; ++lane)
        position[lane] = worldPosition(block, patches[first + lane], vecCast<double>(errors[lane].x));
    }
  }

  /// Solves those of a batch in double that need it.
  void solveSomeAlone(const BlockState& block, std::size_t first, int used) {
    const bool promised = block.out.suspects != nullptr;
    const auto limit = static_cast<float>(promised ? block.cellHalfSize + kSnap : solver.halfSize());
    // In the lower half those beyond the limit or unsolved, in the upper one those outside their cells.
    constexpr std::uint32_t kOutside = 1u << 16;
    alignas(64) std::uint32_t count[kLanes];
    forEachLane([&, reach = lanes.reach, solved = lanes.step.solved](int i) {
      const std::uint32_t alone = unsigned(solved[i] == 0) | unsigned(!(reach[i] <= limit));
      const std::uint32_t outside = reach[i] > 0.5F ? kOutside : 0;
      count[i] = i < used ? (alone != 0 ? 1 : outside) : 0;
    });
    const std::uint32_t total = foldLanes(count, [](auto& a, const auto& b) { a += b; });
    if (total % kOutside == 0 && planes.patches.empty() && !(promised && patches.anyAmbiguous())) {
      block.counts.outOfCell += total / kOutside;
      return;
    }
    for (int lane = 0; lane < used; ++lane)
      if (count[lane] == 1 || (promised && patches.ambiguous(first + lane)) || planes.find(first + lane) != nullptr) {
        solveAlone(block, first + lane);
      } else {
        block.counts.outOfCell += count[lane] / kOutside;
      }
  }

  void solveAlone(const BlockState& block, std::size_t i) {
    const SurfacePatch& patch = patches[i];
    const Vec3d center = centerOf(patch);
    samples.size = 0;
    forEachEdge(patch, block.edges, [&](int e, int edge) {
      const int k = samples.size++;
      sampleAxis[k] = kCellEdge[e].axis;
      samples.position[k] = cornerPlace(kCellEdge[e].low) - Vec3d{0.5, 0.5, 0.5};
      samples.position[k][sampleAxis[k]] += double(crossings.t(edge));
      samples.row[k] = vecCast<double>(crossings.plane(edge));
      if (noise == nullptr) return;
      const double own = noise->sigma[edge];
      samples.variance[k] = own * own;
      samples.weight[k] = std::max(noise->weight[edge], CrossingPlanes::kLeastWeight);
    });
    samples.features = {};
    if (const FeaturePlanes::Patch* feature = planes.find(i)) {
      // About the centre of the cell.
      features.assign(planes.of(*feature).begin(), planes.of(*feature).end());
      for (FeaturePlanes::Plane& p : features) p.point -= vecCast<float>(center);
      samples.features = features;
      samples.featureSigma = feature->sigmaNormal;
    }
    const SolvedVertex v = solver.solve(samples, block.metric);
    block.counts.outOfCell += v.outOfCell;
    block.counts.moved += v.moved;
    const std::uint64_t vertex = block.firstVertex + i;
    Vec3f x = vecCast<float>(v.x);
    if (block.out.suspects != nullptr) x = keepOrNote(block, i, vertex, v.x);
    block.out.positions[vertex] = worldPosition(block, patch, vecCast<double>(x));
    (*block.out.errors)[vertex] = {x, matrixCast(v.A), vecCast<float>(v.A * v.x - v.halfGradient)};
  }

  /// Puts a vertex whose free place is `x` into its cell where that costs nothing; or notes it as suspect. \returns
  /// where it is now.
  Vec3f keepOrNote(const BlockState& block, std::size_t i, std::uint64_t vertex, const Vec3d& x) {
    Vec3f free = vecCast<float>(x);
    Vec3d safe{};
    if (patches.ambiguous(i)) {
      safe = meanCrossing();
    } else if (reach(free) <= block.cellHalfSize + kSnap) {
      clampToCube(free, block.cellHalfSize);
      return free;
    } else {
      safe = VertexSolver(solver.sigma(), block.cellHalfSize).solve(samples, block.metric).x;
      const double fit = exactNormals ? 1 : kFit;  // Without noise nearer is better.
      if (planeError(samples, safe) <= fit * fit * planeError(samples, x) + kFlatness * kFlatness)
        return vecCast<float>(safe);
    }
    clampToCube(safe, block.cellHalfSize);
    block.out.suspects->vertices.push_back(
        {vertex, block.index, patches[i].cell, free, vecCast<float>(safe), creaseNormals(block, x)});
    return free;
  }

  /// The normals of the sides that meet at a vertex whose free place is `x`, where that is known.
  [[nodiscard]] std::array<Vec3f, 4> creaseNormals(const BlockState& block, const Vec3d& x) const {
    std::array<Vec3f, 4> normals{};
    std::size_t count = 0;
    const Mat3d toWorld = inverse(block.metric.M).transposed();
    const auto add = [&](const Vec3d& row) {
      const Vec3d n = toWorld * row;
      const double l = length(n);
      if (!(l > 0)) return;
      const Vec3f normal = vecCast<float>(n * (1 / l));
      const auto alike = [&](const Vec3f& other) { return dot(other, normal) > kSheetCosine; };
      if (count < normals.size() && std::none_of(normals.begin(), normals.begin() + count, alike))
        normals[count++] = normal;
    };
    if (!samples.features.empty()) {
      for (const FeaturePlanes::Plane& p : samples.features) add(vecCast<double>(p.row));
    } else if (exactNormals && planeError(samples, x) <= kExact * kExact) {
      for (int i = 0; i < samples.size; ++i) add(samples.row[i]);
    }
    return normals;
  }

  /// Of the samples, away from where two patches may touch: crossings at the very ends of their edges.
  [[nodiscard]] Vec3d meanCrossing() const {
    constexpr double kInner = 0.49;
    Vec3d mean{};
    for (int i = 0; i < samples.size; ++i) {
      Vec3d p = samples.position[i];
      p[sampleAxis[i]] = std::clamp(p[sampleAxis[i]], -kInner, kInner);
      mean += p * (1.0 / samples.size);
    }
    return mean;
  }

  static SymMat3<float> matrixCast(const SymMat3<double>& A) {
    const auto f = [](double v) { return static_cast<float>(v); };
    return {f(A.xx), f(A.xy), f(A.xz), f(A.yy), f(A.yz), f(A.zz)};
  }

  [[nodiscard]] static Vec3d centerOf(const SurfacePatch& patch) {
    const Coord low = cellOf(patch);
    return {low[0] + 0.5, low[1] + 0.5, low[2] + 0.5};
  }

  [[nodiscard]] Vec3f worldPosition(const BlockState& block, const SurfacePatch& patch, const Vec3d& x) const {
    const Vec3d inBlock = centerOf(patch) + x;
    return vecCast<float>(map.affine() ? linear * inBlock + map.position(block.origin)
                                       : map.position(block.origin + inBlock));
  }

  [[nodiscard]] Vec3f meanNormal(const BlockState& block, const SurfacePatch& patch) const {
    Vec3d sum{};
    forEachEdge(patch, block.edges, [&](int /*e*/, int i) {
      sum += Vec3d{hermite.nx[i], hermite.ny[i], hermite.nz[i]};
    });
    const double l = length(sum);
    return vecCast<float>(l > 0 ? sum * (1 / l) : Vec3d{});
  }

  const LatticeMap& map;
  const VertexSolver solver;
  const SimdLevel level;
  const Mat3d linear;             ///< Of an affine map.
  const CellMetric commonMetric;  ///< Likewise.
  const bool exactNormals;
  /// Of one normal, in lattice units: σn² G; or zero, if crossings have their own, which are in their rows.
  SymMat3<float> Sigma_n;
  HermiteBlock hermite;
  const std::unique_ptr<PlaneNoise> noise;  ///< Null: the source knows none.
  CrossingPlanes crossings;
  PatchList patches;
  PatchSums sums;
  FeaturePlanes planes;
  std::vector<FeaturePlanes::Plane> features;  ///< Of the vertex being solved.
  PatchLanes lanes;
  PatchSamples samples;
  std::array<int, PatchSamples::kMax> sampleAxis;
};

BlockVertexSolver::BlockVertexSolver(const HermiteSource& source, const SigmaNormal& sigma, double halfSize,
                                     SimdLevel level)
    : mSource(source), mScratch(std::make_unique<Scratch>(source, sigma, halfSize, level)) {}

BlockVertexSolver::~BlockVertexSolver() = default;

void BlockVertexSolver::run(std::size_t index, const Surface& surface, const VertexOutput& out, VertexCounts& counts) {
  const SurfaceBlocks& blocks = surface.blocks;
  const Topology& topology = surface.topology;
  const Coord& block = blocks.coords[index];
  const BlockSigns& signs = blocks.signs[index];
  const EdgeIndex edges(signs);
  const Vec3d origin = blockOrigin(block);
  const CellMetric metric = mSource.map().affine() ? mScratch->commonMetric : blockMetric(mSource.map(), origin);
  const SigmaNormal& sigma = mScratch->solver.sigma();
  mScratch->Sigma_n = Scratch::matrixCast(sigma.ofPatches() ? metric.G : metric.G * sigma.variance());
  Scratch& scratch = *mScratch;
  if (index + kAhead < blocks.coords.size()) mSource.prefetch(blocks.coords[index + kAhead]);
  mSource.fillHermite(block, signs, edges, scratch.hermite);
  counts.crossings += topology.blocks[index].quadCount;
  counts.withoutNormal += scratch.crossings.fill(scratch.hermite, edges, metric, mSource.map(), origin, scratch.level);
  if (scratch.noise != nullptr) {
    mSource.fillNoise(block, edges, scratch.hermite, *scratch.noise);
    // From the data, σn takes its time: until the sums are known.
    scratch.crossings.setNoise(*scratch.noise, edges, sigma.ofPatches() ? 0 : sigma.variance());
    if (!sigma.ofPatches()) scratch.Sigma_n = {};
  }
  scratch.patches.fill(topology.blocks[index], signs);
  scratch.planes.clear();
  mSource.fillFeaturePlanes(block, signs, edges, scratch.hermite, scratch.patches.patches(), scratch.planes);
  const BlockState state{static_cast<std::int32_t>(index),
                         topology.blocks[index].firstVertex,
                         edges,
                         metric,
                         origin,
                         out.suspects != nullptr ? cellHalfSize(mSource.map(), block) : 0.5,
                         out,
                         counts};
  // Each way of choosing σn has a function of its own, small enough for the compiler to do its best.
  const auto solveWith = [&](const auto& sigmaOf) { withSimd(scratch.level, [&] { scratch.run(state, sigmaOf); }); };
  if (!sigma.ofPatches()) {
    solveWith([](const SymMat3<float>&, float) { return 1.0F; });
  } else if (metric.identity) {
    solveWith([&sigma](const SymMat3<float>& A, float n) { return sigma.variance(A, n); });
  } else {
    const SymMat3<float> H = Scratch::matrixCast(metric.inverseG());
    solveWith([&sigma, H](const SymMat3<float>& A, float n) { return sigma.variance(A, n, H); });
  }
}

}  // namespace pdc::detail
