#include "extract/mesh_slab.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <stdexcept>
#include <variant>

#include "extract/contour_memory.h"
#include "extract/fill_and_certify.h"
#include "extract/topology/continuation.h"
#include "parallel/with_threads.h"
#include "sample/relocated_source.h"

namespace pdc::detail {
namespace {

/// Where layers begin in the arrays of a contoured part.
class LayerStarts {
 public:
  struct At {
    std::uint64_t solved, added, quads, triangles;
    std::size_t block;
  };

  LayerStarts(const SurfaceBlocks& blocks, const Topology& topology, const std::vector<FanPart>& fans)
      : mBlocks(blocks), mTopology(topology), mFans(fans) {}

  /// Of the first layer at x or beyond.
  [[nodiscard]] At operator()(int x) const {
    const auto block = static_cast<std::size_t>(
        std::partition_point(mBlocks.coords.begin(), mBlocks.coords.end(), [x](const Coord& b) { return b[0] < x; }) -
        mBlocks.coords.begin());
    const bool isEnd = block == mBlocks.coords.size();
    At at{.solved = isEnd ? mTopology.vertexCount : mTopology.blocks[block].firstVertex,
          .added = 0,
          .quads = isEnd ? mTopology.quadCount : mTopology.blocks[block].firstQuad,
          .triangles = 0,
          .block = block};
    for (const FanPart& fan : mFans) {
      if (static_cast<std::size_t>(fan.block) >= block) break;
      at.added += fan.vertices;
      at.triangles += fan.triangles;
      --at.quads;  // The one that the fan replaces.
    }
    return at;
  }

 private:
  const SurfaceBlocks& mBlocks;
  const Topology& mTopology;
  const std::vector<FanPart>& mFans;
};

/// Joins the items of two stretches of an array.
template <typename T>
Buffer<T> stretches(const Buffer<T>& from, std::uint64_t begin0, std::uint64_t end0, std::uint64_t begin1,
                    std::uint64_t end1) {
  Buffer<T> to(end0 - begin0 + (end1 - begin1));
  const auto at = [&](std::uint64_t i) { return from.begin() + static_cast<std::ptrdiff_t>(i); };
  std::copy(at(begin1), at(end1), std::copy(at(begin0), at(end0), to.begin()));
  return to;
}

/// Takes a slab out of a contoured part.
class SlabCutter {
 public:
  SlabCutter(const Mesh& part, std::uint64_t solved, const LayerStarts& starts, LayerRange layers)
      : mPart(part),
        mSolved(solved),
        mBefore(starts(layers.begin - 1)),
        mBegin(starts(layers.begin)),
        mEnd(starts(layers.end)) {}

  [[nodiscard]] Mesh cut() const {
    Mesh mesh;
    mesh.origin = mPart.origin;
    mesh.positions = vertices(mPart.positions, 1);
    if (!mPart.normals.empty()) mesh.normals = vertices(mPart.normals, 1);
    for (const VertexProperty& p : mPart.properties)
      mesh.properties.push_back({.name = p.name,
                                 .components = p.components,
                                 .values = std::visit(
                                     [&](const auto& values) -> PropertyValues {
                                       return vertices(values, static_cast<std::uint64_t>(p.components));
                                     },
                                     p.values)});
    mesh.quads = faces(mPart.quads, mBegin.quads, mEnd.quads);
    mesh.triangles = faces(mPart.triangles, mBegin.triangles, mEnd.triangles);
    return mesh;
  }

 private:
  template <typename T>
  [[nodiscard]] Buffer<T> vertices(const Buffer<T>& from, std::uint64_t each) const {
    return stretches(from, each * mBegin.solved, each * mEnd.solved, each * (mSolved + mBegin.added),
                     each * (mSolved + mEnd.added));
  }

  template <typename Face>
  [[nodiscard]] Buffer<Face> faces(const Buffer<Face>& from, std::uint64_t begin, std::uint64_t end) const {
    Buffer<Face> to(end - begin);
    tbb::parallel_for(std::size_t{0}, to.size(), [&](std::size_t i) {
      to[i] = from[begin + i];
      for (std::uint32_t& corner : to[i]) corner = number(corner);
    });
    return to;
  }

  [[nodiscard]] std::uint32_t number(std::uint32_t corner) const {
    const bool isSolved = corner < mSolved;
    const std::uint64_t at = isSolved ? corner : corner - mSolved, begin = isSolved ? mBefore.solved : mBefore.added,
                        end = isSolved ? mEnd.solved : mEnd.added;
    if (at < begin || at >= end) throw std::logic_error("contourSlab: a face reaches beyond the layer before its own");
    return static_cast<std::uint32_t>(at - begin + (isSolved ? 0 : mEnd.solved - mBefore.solved));
  }

  const Mesh& mPart;
  const std::uint64_t mSolved;
  const LayerStarts::At mBefore, mBegin, mEnd;
};

/// Adds what a layer became to what led there.
void addResult(const Mesh& part, std::uint64_t solved, const LayerStarts& starts, int layer, LayerHash& hash) {
  const LayerStarts::At begin = starts(layer), end = starts(layer + 1);
  const auto addVertex = [&](std::uint64_t kind, std::uint64_t i, const Vec3f& p) {
    const auto bits = [](float v) { return std::uint64_t{std::bit_cast<std::uint32_t>(v)}; };
    hash.add(std::array{kind, i, bits(p.x) << 32 | bits(p.y), bits(p.z)});
  };
  for (std::uint64_t i = begin.solved; i < end.solved; ++i) addVertex(0, i - begin.solved, part.positions[i]);
  for (std::uint64_t i = begin.added; i < end.added; ++i) addVertex(1, i - begin.added, part.positions[solved + i]);
  // Faces by the places of their corners, which are in layers that may not be compared.
  const auto addFace = [&](std::uint64_t kind, std::uint64_t i, const auto& face) {
    for (const std::uint32_t corner : face) addVertex(kind++, i, part.positions[corner]);
  };
  for (std::uint64_t i = begin.quads; i < end.quads; ++i) addFace(2, i - begin.quads, part.quads[i]);
  for (std::uint64_t i = begin.triangles; i < end.triangles; ++i) addFace(6, i - begin.triangles, part.triangles[i]);
}

class SlabContour {
 public:
  SlabContour(const HermiteSource& source, const SlabRequest& request, const ContourOptions& options)
      : mRequest(request),
        mOptions(options),
        mRelocated(source, source.map().relativeTo(request.place.origin, request.place.step)),
        mSource(request.place.origin != Vec3d{} ? static_cast<const HermiteSource&>(mRelocated) : source) {}

  [[nodiscard]] MeshSlab run(const SurfaceBlocks& all, const Monitor& monitor) const {
    const auto [begin, end] = mRequest.layers;
    const int halo = mRequest.halo;
    const SurfaceBlocks blocks = blocksOfLayers(all, {begin - halo, end + halo});
    const Topology topology = buildTopology(blocks, monitor);
    checkContinuation(blocks, topology);
    checkVertexCount(topology.vertexCount);
    const auto vertices = static_cast<double>(topology.vertexCount);
    checkMemory(contourMemory(vertices, mOptions), vertices, mOptions);
    Mesh part;
    part.origin = mRequest.place.origin;
    CertifyHistory history(begin - kSeamLayers, static_cast<std::size_t>(end - begin) + 2 * kSeamLayers);
    std::vector<FanPart> fans;
    const FilledMesh filled =
        fillAndCertify({mSource, blocks, topology}, mOptions, part, monitor, {.history = &history, .fans = &fans});
    const LayerStarts starts(blocks, topology, fans);
    const auto seam = [&](int cut) {
      MeshSlab::Seam hashes(2 * kSeamLayers);
      for (int i = 0; i < 2 * kSeamLayers; ++i) {
        hashes[i] = history.layers()[static_cast<std::size_t>(cut - begin + i)];
        addResult(part, topology.vertexCount, starts, cut - kSeamLayers + i, hashes[i]);
      }
      return hashes;
    };
    const auto counts = [&](int from, int to) {
      return MeshSlab::Counts{starts(to).solved - starts(from).solved, starts(to).added - starts(from).added};
    };
    MeshSlab slab{.mesh = SlabCutter(part, topology.vertexCount, starts, mRequest.layers).cut(),
                  .own = counts(begin, end),
                  .layerBefore = counts(begin - 1, begin),
                  .lastLayer = counts(end - 1, end),
                  .low = seam(begin),
                  .high = seam(end)};
    slab.blocks = starts(end).block - starts(begin).block;
    for (std::size_t i = starts(begin).block; i < starts(end).block; ++i) {
      slab.multiVertexCells += topology.blocks[i].multiVertex.size();
      slab.boundaryEdges += topology.blocks[i].openArcs;
    }
    slab.uncertified = filled.certified.uncertified;
    return slab;
  }

 private:
  const SlabRequest& mRequest;
  const ContourOptions& mOptions;
  RelocatedSource mRelocated;
  const HermiteSource& mSource;
};

}  // namespace

SurfaceBlocks blocksOfLayers(const SurfaceBlocks& all, LayerRange layers) {
  const auto lower = [&](int x) {
    return static_cast<std::size_t>(
        std::partition_point(all.coords.begin(), all.coords.end(), [x](const Coord& b) { return b[0] < x; }) -
        all.coords.begin());
  };
  const std::size_t begin = lower(layers.begin), end = lower(layers.end);
  SurfaceBlocks part;
  part.coords.assign(all.coords.begin() + static_cast<std::ptrdiff_t>(begin),
                     all.coords.begin() + static_cast<std::ptrdiff_t>(end));
  part.signs.resize(end - begin);
  std::copy_n(all.signs.begin() + static_cast<std::ptrdiff_t>(begin), end - begin, part.signs.begin());
  part.open = all.open || end - begin < all.coords.size();
  return part;
}

MeshSlab contourSlab(const HermiteSource& source, const SurfaceBlocks& blocks, const SlabRequest& request,
                     const ContourOptions& options, const Monitor& monitor) {
  if (options.adaptive || options.quadrics || options.triangles)
    throw std::invalid_argument("contourSlab: adaptive distances, quadrics and triangles are for whole meshes");
  return withThreads(options.threads, [&] { return SlabContour(source, request, options).run(blocks, monitor); });
}

}  // namespace pdc::detail
