#include "extract/block_vertices.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "extract/cell_rounding.h"
#include "extract/float4.h"
#include "math/lane_loops.h"
#include "pdc/math/quadric_batch.h"

namespace pdc::detail {
namespace {

Vec3d toVec3d(const Coord& c) { return {double(c[0]), double(c[1]), double(c[2])}; }

/// EdgeIndex slots of a cell's edges, from the slot of its low corner along x.
constexpr auto kEdgeSlot = [] {
  std::array<int, kEdges> slot{};
  for (int e = 0; e < kEdges; ++e) {
    const int low = edgeLowCorner(e);
    slot[e] = EdgeIndex::slot(edgeAxis(e), low & 1, low >> 1 & 1, low >> 2);
  }
  return slot;
}();

/// A crossing in lattice units: its plane's row (see PatchSamples) and its place from the block's origin.
struct Crossing {
  Float4 row, place;
};

/// Only a map that is not affine has a metric that changes from block to block; within one it is taken as constant.
CellMetric blockMetric(const LatticeMap& map, const Vec3d& origin) {
  if (map.affine()) return CellMetric(map.jacobian({}), map.voxelSize());
  constexpr double kMiddle = kBlockSize / 2.0;
  const Mat3d J = map.jacobian(origin + Vec3d{kMiddle, kMiddle, kMiddle});
  return CellMetric(J, std::cbrt(std::abs(J.determinant())));
}

/// Half the size of the part of a block's cells whose points stay well within the cell when their world coordinates are
/// rounded to single precision.
double cellHalfSize(const LatticeMap& map, const Coord& block) {
  return 0.5 - std::clamp(4 * cellRounding(map, block), kCellMargin, 0.25);
}

/// A vertex no farther than this, in lattice units, beyond that part of its cell is put back into it: surfaces that lie
/// on lattice planes have all their vertices there, give or take rounding.
constexpr double kSnap = 1e-4;

/// Nor does a vertex leave its cell to come nearer to its planes by less than this, in voxels.
constexpr double kFlatness = 1e-3;

float reach(const Vec3f& x) { return std::max({std::abs(x.x), std::abs(x.y), std::abs(x.z)}); }

template <typename T>
void clampToCube(Vec3<T>& x, double halfSize) {
  for (int i = 0; i < 3; ++i) x[i] = std::clamp(x[i], static_cast<T>(-halfSize), static_cast<T>(halfSize));
}

/// One block while its vertices are being solved.
struct BlockState {
  std::int32_t index;
  const BlockTopology& topology;
  const BlockSigns& signs;
  const EdgeIndex& edges;
  const CellMetric& metric;
  Vec3d origin;
  double cellHalfSize;  ///< Of the part of a cell whose points stay in the cell when they are rounded.
  const VertexOutput& out;
  VertexCounts& counts;
};

/// A vertex to solve: the cell in its block, the edges of its patch, its number in the mesh.
struct Waiting {
  Coord cell;
  unsigned edges;
  std::uint64_t vertex;
  bool strict;                                    ///< See CellEntry.
  const FeaturePlanes::Patch* feature = nullptr;  ///< Null: its crossings are all there is.
};

/// The sign-changing edges of the patch that vertex v of a special cell belongs to.
unsigned patchEdges(const SpecialCell& special, unsigned present, int v) {
  int patch = kNone;
  for (int e = 0; e < kEdges; ++e)
    if (special.vertex[e] == v) patch = special.patch[e];
  unsigned edges = 0;
  for (unsigned bits = present; bits != 0; bits &= bits - 1) {
    const int e = std::countr_zero(bits);
    if (special.patch[e] == patch) edges |= 1u << e;
  }
  return edges;
}

}  // namespace

/// Vertices wait in lanes until a register's worth of them can be solved at once, in single precision about their mass
/// points. Those that leave their bounds, and all where σn is too small for single precision, are solved in double.
struct BlockVertexSolver::Scratch {
  Scratch(const LatticeMap& m, double sigmaNormal, double halfSize, SimdLevel l)
      : map(m), solver(sigmaNormal, halfSize), level(l) {}

  void run(const BlockState& block) {
    fillCrossings(block);
    block.counts.crossings += block.topology.quadCount;
    const FeaturePlanes::Patch* feature = planes.patches.data();
    const FeaturePlanes::Patch* const end = feature + planes.patches.size();
    std::uint64_t vertex = block.topology.firstVertex;
    for (std::uint32_t i = 0; i < patches.size(); ++i) {
      const int cell = patches[i].cell;
      const bool here = feature != end && feature->patch == i;
      add(block, {{cell >> 6, cell >> 3 & 7, cell & 7},
                  patches[i].edges,
                  vertex++,
                  strict[i] != 0,
                  here ? feature++ : nullptr});
    }
    flush(block);
  }

  /// Lists the block's patches in the order of their vertices.
  void listPatches(const BlockTopology& topology, const BlockSigns& signs) {
    patches.clear();
    strict.clear();
    for (int x = 0; x < kBlockSize; ++x)
      for (std::uint64_t w = topology.cells.word[x]; w != 0; w &= w - 1) {
        const int bit = std::countr_zero(w), y = bit >> 3, z = bit & 7;
        const CellEntry& entry = kCellTable[cellCode(signs, x, y, z)];
        const SpecialCell* special = topology.special.empty() ? nullptr : topology.findSpecial(64 * x + bit);
        const auto list = [&](unsigned edges, bool isStrict) {
          patches.push_back({static_cast<std::uint16_t>(64 * x + bit), static_cast<std::uint16_t>(edges)});
          strict.push_back(isStrict);
        };
        if (special == nullptr) {
          list(entry.edges, entry.strict);
        } else {
          for (int v = 0; v < special->vertexCount; ++v) list(patchEdges(*special, entry.edges, v), true);
        }
      }
  }

  void fillCrossings(const BlockState& block) {
    const Mat3d Mt = block.metric.M.transposed();
    block.edges.forEach([&](int i, int axis, int x, int y, int z) {
      const Vec3f n{hermite.nx[i], hermite.ny[i], hermite.nz[i]};
      const bool owned = x < kBlockSize && y < kBlockSize && z < kBlockSize;
      block.counts.withoutNormal += owned && n == Vec3f{};
      Float4 place{static_cast<float>(x), static_cast<float>(y), static_cast<float>(z), 0.0F};
      place[axis] += hermite.t[i];
      crossing[i].place = place;
      if (block.metric.identity) {
        crossing[i].row = float4(n);
      } else if (map.affine()) {
        crossing[i].row = float4(vecCast<float>(Mt * vecCast<double>(n)));
      } else {
        const Vec3d p = block.origin + vecCast<double>(vec3(place));
        crossing[i].row =
            float4(vecCast<float>(map.jacobian(p).transposed() * vecCast<double>(n) * (1 / block.metric.voxelSize)));
      }
    });
  }

  void add(const BlockState& block, const Waiting& w) {
    if (w.feature != nullptr) {
      solveAlone(block, w);
      return;
    }
    waiting[lanes] = w;
    if (solver.batched()) sumPlanes(block, waiting[lanes], lanes);
    if (++lanes == kLanes) flush(block);
  }

  /// The normal equations of a patch about its mass point: there the right-hand side is small where the surface is
  /// flat, and so is what rounding does to it.
  void sumPlanes(const BlockState& block, const Waiting& w, int lane) {
    const auto [x, y, z] = w.cell;
    const Float4 center{static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F, static_cast<float>(z) + 0.5F, 0.0F};
    const std::uint16_t* number = block.edges.numbers() + EdgeIndex::slot(0, x, y, z);
    const Crossing* at[kEdges];
    int n = 0;
    Float4 places{};
    for (unsigned bits = w.edges; bits != 0; bits &= bits - 1) {
      at[n] = &crossing[number[kEdgeSlot[std::countr_zero(bits)]]];
      places += at[n++]->place - center;
    }
    const Float4 massPoint = places * (1.0F / static_cast<float>(n));
    const Float4 origin = massPoint + center;
    Float4 x0{}, x1{}, x2{}, b{};
    for (int i = 0; i < n; ++i) {
      const Float4 row = at[i]->row;
      x0 += row * row[0];
      x1 += row * row[1];
      x2 += row * row[2];
      b += row * dot3(row, at[i]->place - origin);
    }
    const SymMat3<float>& S = Sigma_n;
    const auto count = static_cast<float>(n);
    system.A.set(lane, {x0[0] + count * S.xx, x0[1] + count * S.xy, x0[2] + count * S.xz, x1[1] + count * S.yy,
                        x1[2] + count * S.yz, x2[2] + count * S.zz});
    system.b.set(lane, vec3(b));
    mass[lane] = vec3(massPoint);
  }

  void flush(const BlockState& block) {
    if (solver.batched() && lanes > 0) {
      for (int lane = lanes; lane < kLanes; ++lane)
        system.set(lane, NormalEquations<float>{SymMat3<float>::identity(), {}});
      solveLdlt(std::span<const NormalEquationsLanes<float>>(&system, 1), std::span<SolutionLanes<float>>(&solution, 1),
                level);
    }
    for (int lane = 0; lane < lanes; ++lane) {
      const Waiting& w = waiting[lane];
      if (!solver.batched() || solution.solved[lane] == 0) {
        solveAlone(block, w);
        continue;
      }
      Vec3f v = mass[lane] + solution.x.get(lane);
      const bool promised = block.out.doubts != nullptr;
      const double limit = promised ? block.cellHalfSize + kSnap : solver.halfSize();
      if ((promised && w.strict) || !(reach(v) <= limit)) {
        solveAlone(block, w);
        continue;
      }
      block.counts.outOfCell += reach(v) > 0.5F;
      const SymMat3<float> A = system.A.get(lane);
      const Vec3f b = A * v;
      if (promised) clampToCube(v, block.cellHalfSize);
      write(block, w, {v, A, b});
    }
    lanes = 0;
  }

  void solveAlone(const BlockState& block, const Waiting& w) {
    const auto [x, y, z] = w.cell;
    const Vec3d center{x + 0.5, y + 0.5, z + 0.5};
    const std::uint16_t* number = block.edges.numbers() + EdgeIndex::slot(0, x, y, z);
    samples.size = 0;
    for (unsigned bits = w.edges; bits != 0; bits &= bits - 1) {
      const Crossing& c = crossing[number[kEdgeSlot[std::countr_zero(bits)]]];
      sampleAxis[samples.size] = edgeAxis(std::countr_zero(bits));
      samples.position[samples.size] = vecCast<double>(vec3(c.place)) - center;
      samples.row[samples.size++] = vecCast<double>(vec3(c.row));
    }
    samples.features = {};
    if (w.feature != nullptr) {
      // About the centre of the cell.
      features.assign(planes.of(*w.feature).begin(), planes.of(*w.feature).end());
      for (FeaturePlanes::Plane& p : features) p.point -= vecCast<float>(center);
      samples.features = features;
      samples.featureSigma = w.feature->sigmaNormal;
    }
    const SolvedVertex v = solver.solve(samples, block.metric);
    block.counts.outOfCell += v.outOfCell;
    block.counts.moved += v.moved;
    Vec3f at = vecCast<float>(v.x);
    if (block.out.doubts != nullptr) at = keepOrNote(block, w, v.x);
    write(block, w, {at, matrixCast(v.A), vecCast<float>(v.A * v.x - v.halfGradient)});
  }

  /// Puts a vertex whose free place is `x` into its cell where that costs nothing; or notes it as loose. \returns where
  /// it is now.
  Vec3f keepOrNote(const BlockState& block, const Waiting& w, const Vec3d& x) {
    Vec3f free = vecCast<float>(x);
    Vec3d safe{};
    if (w.strict) {
      safe = meanCrossing();
    } else if (reach(free) <= block.cellHalfSize + kSnap) {
      clampToCube(free, block.cellHalfSize);
      return free;
    } else {
      safe = VertexSolver(solver.sigma(), block.cellHalfSize).solve(samples, block.metric).x;
      if (planeError(safe) <= planeError(x) + kFlatness * kFlatness) return vecCast<float>(safe);
    }
    clampToCube(safe, block.cellHalfSize);
    const auto cell = static_cast<std::uint16_t>(64 * w.cell[0] + 8 * w.cell[1] + w.cell[2]);
    block.out.doubts->vertices.push_back({w.vertex, block.index, cell, free, vecCast<float>(safe)});
    return free;
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

  /// Mean squared distance to the planes that place the vertex, in voxels squared.
  [[nodiscard]] double planeError(const Vec3d& x) const {
    double sum = 0;
    if (!samples.features.empty()) {
      for (const FeaturePlanes::Plane& p : samples.features) {
        const double distance = dot(vecCast<double>(p.row), x - vecCast<double>(p.point));
        sum += distance * distance;
      }
      return sum / static_cast<double>(samples.features.size());
    }
    for (int i = 0; i < samples.size; ++i) {
      const double distance = dot(samples.row[i], x - samples.position[i]);
      sum += distance * distance;
    }
    return sum / samples.size;
  }

  static SymMat3<float> matrixCast(const SymMat3<double>& A) {
    const auto f = [](double v) { return static_cast<float>(v); };
    return {f(A.xx), f(A.xy), f(A.xz), f(A.yy), f(A.yz), f(A.zz)};
  }

  void write(const BlockState& block, const Waiting& w, const VertexError& error) {
    const Vec3d inBlock = toVec3d(w.cell) + Vec3d{0.5, 0.5, 0.5} + vecCast<double>(error.x);
    block.out.positions[w.vertex] = vecCast<float>(map.position(block.origin + inBlock));
    block.out.errors[w.vertex - block.out.firstError] = error;
    if (block.out.normals != nullptr) block.out.normals[w.vertex] = meanNormal(block, w);
  }

  Vec3f meanNormal(const BlockState& block, const Waiting& w) const {
    const std::uint16_t* number = block.edges.numbers() + EdgeIndex::slot(0, w.cell[0], w.cell[1], w.cell[2]);
    Vec3d sum{};
    for (unsigned bits = w.edges; bits != 0; bits &= bits - 1) {
      const int i = number[kEdgeSlot[std::countr_zero(bits)]];
      sum += Vec3d{hermite.nx[i], hermite.ny[i], hermite.nz[i]};
    }
    const double l = length(sum);
    return vecCast<float>(l > 0 ? sum * (1 / l) : Vec3d{});
  }

  const LatticeMap& map;
  const VertexSolver solver;
  const SimdLevel level;
  SymMat3<float> Sigma_n;  ///< Of one normal, in lattice units: σn² G.
  HermiteBlock hermite;
  std::vector<SurfacePatch> patches;
  std::vector<std::uint8_t> strict;  ///< Of each patch, whether its cell is a strict one.
  FeaturePlanes planes;
  std::vector<FeaturePlanes::Plane> features;  ///< Of the vertex being solved.
  std::array<Crossing, EdgeIndex::kMaxEdges> crossing;
  std::array<Waiting, kLanes> waiting;
  std::array<Vec3f, kLanes> mass;
  NormalEquationsLanes<float> system;
  SolutionLanes<float> solution;
  int lanes = 0;
  PatchSamples samples;
  std::array<int, PatchSamples::kMax> sampleAxis;
};

BlockVertexSolver::BlockVertexSolver(const HermiteSource& source, double sigmaNormal, double halfSize, SimdLevel level)
    : mSource(source), mScratch(std::make_unique<Scratch>(source.map(), sigmaNormal, halfSize, level)) {}

BlockVertexSolver::~BlockVertexSolver() = default;

void BlockVertexSolver::run(std::size_t index, const SurfaceBlocks& blocks, const Topology& topology,
                            const VertexOutput& out, VertexCounts& counts) {
  const Coord& block = blocks.coords[index];
  const BlockSigns& signs = blocks.signs[index];
  const EdgeIndex edges(signs);
  const Vec3d origin = toVec3d({block[0] * kBlockSize, block[1] * kBlockSize, block[2] * kBlockSize});
  const CellMetric metric = blockMetric(mSource.map(), origin);
  const double sigma = mScratch->solver.sigma();
  mScratch->Sigma_n = Scratch::matrixCast(metric.G * (sigma * sigma));
  mSource.fillHermite(block, signs, edges, mScratch->hermite);
  mScratch->listPatches(topology.blocks[index], signs);
  mScratch->planes.clear();
  mSource.fillFeaturePlanes(block, signs, edges, mScratch->hermite, mScratch->patches, mScratch->planes);
  const BlockState state{static_cast<std::int32_t>(index),
                         topology.blocks[index],
                         signs,
                         edges,
                         metric,
                         origin,
                         cellHalfSize(mSource.map(), block),
                         out,
                         counts};
  forEachBlock(mScratch->level, 1, [&](std::size_t) { mScratch->run(state); });
}

}  // namespace pdc::detail
