#include "extract/vertex_confidence.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "extract/vertices/block_sampler.h"
#include "extract/vertices/cell_metric.h"
#include "extract/vertices/patch_samples.h"
#include "extract/vertices/sigma_normal.h"
#include "mesh/faces.h"
#include "parallel/block_progress.h"
#include "parallel/isolated.h"
#include "pdc/math/solvers.h"
#include "sample/cell_edges.h"

namespace pdc::detail {
namespace {

/// Eigenvalues of Σnnᵀ above this share of the trace count: two planes at 26°. Noise of 0.1 voxels in distances leaves
/// flat parts at some 0.02.
constexpr double kRankShare = 0.05;

/// Error of a plane from distances over its σn: at noises of 0.02 and 0.1 voxel vertices on flat parts are off by 0.4
/// of that.
constexpr double kPlaneError = 0.4;

constexpr double square(double x) { return x * x; }

/// What the planes of a vertex tell of it.
struct VertexEstimate {
  Vec3f normal{};      ///< The direction that they determine best, outwards; zero where there are none.
  float variance = 0;  ///< That of the solution where they determine it, in voxels squared.
  float sigma = 0;     ///< The standard deviation of its part along the normal, in world units.
  std::uint8_t rank = 1;
  /// Several planes from distances meet there: how far it is from its neighbours' mean says how the crease lies.
  bool onCrease = false;
};

/// The planes of one vertex: unit normals in world space times the roots of their weights, and its distances from them
/// in voxels.
struct Planes {
  static constexpr int kMax = PatchSamples::kMax;
  std::array<Vec3d, kMax> normal;
  std::array<double, kMax> distance;
  int size = 0;
  double known = 0;  ///< Variance of the distances as far as the source tells it, in voxels squared.

  void add(const Vec3d& n, double d) {
    if (n == Vec3d{} || size == kMax) return;
    normal[size] = n;
    distance[size++] = d;
  }
};

VertexEstimate estimate(const Planes& planes, double voxelSize) {
  VertexEstimate result;
  if (planes.size == 0) return result;
  SymMat3<double> A{};
  Vec3d mean{};
  double squares = 0;
  for (int i = 0; i < planes.size; ++i) {
    A += outer(planes.normal[i]);
    mean += planes.normal[i];
    squares += planes.distance[i] * planes.distance[i];
  }
  const Eigen3 e = eigenSymmetric(A);
  int rank = 0;
  double inverses = 0;
  for (const double value : e.value) {
    if (!(value > kRankShare * A.trace())) continue;
    ++rank;
    inverses += 1 / value;
  }
  const double seen = planes.size > rank ? squares / (planes.size - rank) : 0;
  const double perPlane = seen + planes.known;
  result.variance = static_cast<float>(perPlane * inverses);
  if (e.value[0] > 0) result.sigma = static_cast<float>(std::sqrt(perPlane / e.value[0]) * voxelSize);
  result.rank = static_cast<std::uint8_t>(std::max(rank, 1));
  result.normal = vecCast<float>(dot(e.vector[0], mean) < 0 ? e.vector[0] * -1.0 : e.vector[0]);
  return result;
}

/// Estimates the vertices of one block after another. For one thread; large: keep it off the stack.
class BlockEstimator {
 public:
  explicit BlockEstimator(const HermiteSource& source)
      : mMap(source.map()),
        mSampler(source, SigmaNormal::fromData(source).needsNoise()),
        mKnowsSigma(source.knowledge().noise == SourceKnowledge::Noise::kSigma) {}

  void run(const SurfaceBlock& block, const BlockTopology& topology, const Mesh& mesh,
           Buffer<VertexEstimate>& estimates) {
    const Vec3d origin = blockOrigin(block.coord);
    const CellMetric metric = blockMetric(mMap, origin);
    mSampler.run(block, topology, metric);
    const PatchList& patches = mSampler.patches();
    const FeaturePlanes& features = mSampler.features();
    const Mat3d toWorld = inverse(metric.M).transposed();
    for (std::size_t i = 0; i < patches.size(); ++i) {
      const std::uint64_t vertex = topology.firstVertex + i;
      const Vec3d at = vecCast<double>(mesh.positions[vertex]);
      Planes planes;
      const auto add = [&](const Vec3d& n, const Vec3d& point) {
        planes.add(n, dot(n, at - mMap.position(origin + point)) / metric.voxelSize);
      };
      const FeaturePlanes::Patch* feature = features.find(i);
      if (feature != nullptr) {
        planes.known = square(kPlaneError * static_cast<double>(feature->sigmaNormal));
        for (const FeaturePlanes::Plane& p : features.of(*feature))
          add(toWorld * vecCast<double>(p.row), vecCast<double>(p.point));
      } else {
        planes.known = mKnowsSigma ? meanVariance(patches[i], block.edges) : square(mSampler.normalNoise());
        addCrossings(patches[i], block.edges, add);
      }
      estimates[vertex] = estimate(planes, metric.voxelSize);
      estimates[vertex].onCrease = feature != nullptr && feature->count > 1;
    }
  }

 private:
  /// The mean variance of the patch's normals. That of the distances is nearly the same: either is the noise of the
  /// values over the gradient.
  [[nodiscard]] double meanVariance(const SurfacePatch& patch, const EdgeIndex& edges) const {
    double sum = 0;
    forEachEdge(patch, edges, [&](int /*e*/, int i) { sum += square(mSampler.noise()->sigma[i]); });
    return sum / std::popcount(patch.edges);
  }

  template <typename Add>
  void addCrossings(const SurfacePatch& patch, const EdgeIndex& edges, const Add& add) const {
    const HermiteBlock& hermite = mSampler.hermite();
    const Coord cell = patch.cell.low();
    forEachEdge(patch, edges, [&](int e, int i) {
      Vec3d point = Vec3d{double(cell[0]), double(cell[1]), double(cell[2])} + cornerPlace(kCellEdge[e].low);
      point[kCellEdge[e].axis] += hermite.t[i];
      add(Vec3d{hermite.nx[i], hermite.ny[i], hermite.nz[i]}, point);
    });
  }

  const LatticeMap& mMap;
  BlockSampler mSampler;
  const bool mKnowsSigma;  ///< The source knows the noise of each normal.
};

/// Calls visit(a, b) for all ordered pairs of vertices of each face. \throws Cancelled.
template <typename Visit>
void forEachPair(const Mesh& mesh, const Monitor& monitor, Visit&& visit) {
  constexpr std::size_t kFacesPerLook = 4096;
  for (std::size_t f = 0; f < faceCount(mesh); ++f) {
    if (f % kFacesPerLook == 0) monitor.throwIfStopped();
    for (const std::uint32_t a : face(mesh, f))
      for (const std::uint32_t b : face(mesh, f))
        if (a != b) visit(a, b);
  }
}

/// Vertices that certifying added have no planes of their own: each gets its neighbours' mean normal and their largest
/// variances.
void estimateAdded(const Mesh& mesh, std::size_t solved, const Monitor& monitor, Buffer<VertexEstimate>& estimates) {
  std::fill(estimates.begin() + static_cast<std::ptrdiff_t>(solved), estimates.end(), VertexEstimate{});
  if (solved == estimates.size()) return;
  forEachPair(mesh, monitor, [&](std::uint32_t a, std::uint32_t b) {
    if (a < solved || b >= solved) return;
    estimates[a].normal += estimates[b].normal;
    estimates[a].variance = std::max(estimates[a].variance, estimates[b].variance);
    estimates[a].sigma = std::max(estimates[a].sigma, estimates[b].sigma);
  });
  for (std::size_t i = solved; i < estimates.size(); ++i) {
    const float l = length(estimates[i].normal);
    if (l > 0) estimates[i].normal *= 1 / l;
  }
}

/// The distance of each vertex from its neighbours' mean along its normal, in world units; neighbours count by how well
/// their normals agree.
std::vector<double> distancesFromNeighbours(const Mesh& mesh, const Buffer<VertexEstimate>& estimates,
                                            const Monitor& monitor) {
  std::vector<double> sum(estimates.size(), 0), weight(estimates.size(), 0);
  forEachPair(mesh, monitor, [&](std::uint32_t a, std::uint32_t b) {
    const Vec3d n = vecCast<double>(estimates[a].normal);
    const double c = std::max(dot(n, vecCast<double>(estimates[b].normal)), 0.0), c2 = c * c, c4 = c2 * c2;
    sum[a] += c4 * c4 * dot(n, vecCast<double>(mesh.positions[a]) - vecCast<double>(mesh.positions[b]));
    weight[a] += c4 * c4;
  });
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] = weight[i] > 0 ? sum[i] / weight[i] : 0;
  return sum;
}

Buffer<float> confidenceOf(const Mesh& mesh, const Buffer<VertexEstimate>& estimates, double voxelSize,
                           const Monitor& monitor) {
  const std::vector<double> fromNeighbours = distancesFromNeighbours(mesh, estimates, monitor);
  Buffer<float> confidence(estimates.size());
  for (std::size_t i = 0; i < estimates.size(); ++i) {
    const double seen = estimates[i].onCrease ? 0 : fromNeighbours[i] / voxelSize;
    const double deviation = std::hypot(seen, std::sqrt(double{estimates[i].variance}));
    confidence[i] = static_cast<float>(1 / (1 + deviation / kHalfConfidence));
  }
  return confidence;
}

Buffer<float> sigmasOf(const Buffer<VertexEstimate>& estimates) {
  Buffer<float> sigmas(estimates.size());
  for (std::size_t i = 0; i < estimates.size(); ++i) sigmas[i] = estimates[i].sigma;
  return sigmas;
}

Buffer<std::uint8_t> ranksOf(const Buffer<VertexEstimate>& estimates) {
  Buffer<std::uint8_t> ranks(estimates.size());
  for (std::size_t i = 0; i < estimates.size(); ++i) ranks[i] = estimates[i].rank;
  return ranks;
}

}  // namespace

void addVertexConfidence(const Surface& surface, const ContourOptions& options, Mesh& mesh, const Monitor& monitor) {
  const HermiteSource& source = surface.source;
  const SurfaceBlocks& blocks = surface.blocks;
  const Topology& topology = surface.topology;
  Buffer<VertexEstimate> estimates(mesh.positions.size());
  tbb::enumerable_thread_specific<std::unique_ptr<BlockEstimator>> estimators(
      [&] { return std::make_unique<BlockEstimator>(source); });
  BlockProgress progress(monitor, "confidence", blocks.coords.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, blocks.coords.size(), 16), [&](const auto& range) {
    isolated([&] {
      BlockEstimator& estimator = *estimators.local();
      for (std::size_t i = range.begin(); i != range.end(); ++i) {
        const EdgeIndex edges(blocks.signs[i]);
        estimator.run({blocks.coords[i], blocks.signs[i], edges}, topology.blocks[i], mesh, estimates);
      }
    });
    progress.advance(range.size());
  });
  estimateAdded(mesh, topology.vertexCount, monitor, estimates);
  if (options.confidence) {
    mesh.properties.push_back({"confidence", 1, confidenceOf(mesh, estimates, source.map().voxelSize(), monitor)});
    mesh.properties.push_back({"sigma", 1, sigmasOf(estimates)});
  }
  if (options.ranks) mesh.properties.push_back({"rank", 1, ranksOf(estimates)});
}

}  // namespace pdc::detail
