#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <functional>
#include <type_traits>
#include <variant>

#include "extract/topology/block_topology.h"
#include "io/file/atomic_file.h"
#include "io/file/file_error.h"
#include "io/mesh/ply_writer.h"
#include "mesh/faces.h"
#include "mesh/polygons/split_quads.h"
#include "pdc/tile/slab_folder.h"
#include "tile/slab_agreement.h"
#include "tile/slab_file.h"

namespace pdc {
namespace {

namespace fs = std::filesystem;
using detail::SlabFile;
using detail::SlabHeader;

/// How many solved and added vertices the slabs before one have.
struct Before {
  std::uint64_t solved = 0, added = 0;
};

/// Corners as the whole mesh numbers them. \param solved vertices of the whole mesh.
template <typename Face>
void renumber(Buffer<Face>& faces, const SlabHeader& header, const Before& before, std::uint64_t solved) {
  const std::uint64_t listed = header.layerBefore.solved + header.own.solved,
                      toSolved = before.solved - header.layerBefore.solved,
                      toAdded = solved + before.added - header.layerBefore.added - listed;
  tbb::parallel_for(std::size_t{0}, faces.size(), [&](std::size_t i) {
    for (std::uint32_t& corner : faces[i])
      corner = static_cast<std::uint32_t>(corner + (corner < listed ? toSolved : toAdded));
  });
}

/// Nothing, of the same type.
PropertyValues withoutValues(const PropertyValues& values) {
  return std::visit([](const auto& v) -> PropertyValues { return std::decay_t<decltype(v)>(); }, values);
}

/// Joins the slabs of a folder.
class SlabMerger {
 public:
  SlabMerger(const SlabFolder& folder, bool triangles, const MeshWriteOptions& options, const Monitor& monitor)
      : mFolder(folder), mTriangles(triangles), mOptions(options), mMonitor(monitor) {
    openAll();
    for (std::size_t i = 0; i < mFiles.size(); ++i) {
      mMonitor.throwIfStopped();
      report(i, mFiles.size(), kChecking);
      mFiles[i].check();
      mFiles[i].forget();
    }
    for (const SlabFile& file : mFiles) {
      const SlabHeader& h = file.header();
      mTotal.vertices += h.own.solved + h.own.added;
      mTotal.added += h.own.added;
      mTotal.quads += h.quads;
      mTotal.triangles += h.triangles;
      mTotal.boundaryEdges += h.boundaryEdges;
      mTotal.multiVertexCells += h.multiVertexCells;
      mTotal.blocks += h.blocks;
      mTotal.uncertified += h.uncertified;
    }
    if (mTriangles) {
      mTotal.triangles += 2 * mTotal.quads;
      mTotal.quads = 0;
    }
    detail::checkVertexCount(mTotal.vertices);
  }

  SlabMergeReport write(const fs::path& output) {
    detail::AtomicFile file(output);
    const Mesh like = oneWithVertices();
    for (const VertexProperty& p : like.properties)
      mTotal.properties.push_back({.name = p.name, .components = p.components, .values = withoutValues(p.values)});
    detail::writePlyHeader(like, {mTotal.vertices, mTotal.quads + mTotal.triangles}, file, mOptions);
    forEach(
        [&](const SlabFile& slab, const Before&) { detail::writePlyVertices(slab.solvedVertices(), file, mOptions); });
    forEach(
        [&](const SlabFile& slab, const Before&) { detail::writePlyVertices(slab.addedVertices(), file, mOptions); });
    const std::uint64_t solved = mTotal.vertices - mTotal.added;
    forEach([&](const SlabFile& slab, const Before& before) {
      Mesh mesh = slab.quads();
      renumber(mesh.quads, slab.header(), before, solved);
      if (mTriangles) detail::splitQuads(mesh);
      detail::writePlyFaces(mesh, file, mOptions);
    });
    forEach([&](const SlabFile& slab, const Before& before) {
      Mesh mesh = slab.triangles();
      renumber(mesh.triangles, slab.header(), before, solved);
      detail::writePlyFaces(mesh, file, mOptions);
    });
    file.commit();
    mTotal.bytesWritten = file.bytesWritten();
    return mTotal;
  }

 private:
  /// Passes over all slabs: the first checks them, the others write.
  static constexpr int kChecking = 0, kPasses = 5;

  void openAll() {
    for (std::size_t i = 0; i < mFolder.plan().slabs.size(); ++i) {
      auto file = detail::openSlab(mFolder, i);
      if (!file) throw Error(fmt::format("{}: slab {} is missing", mFolder.path().string(), i));
      if (i > 0 && !detail::agree(mFiles.back().header(), file->header()))
        throw Error(fmt::format("{}: slabs {} and {} do not agree on what lies between them; they have to be run again",
                                mFolder.path().string(), i - 1, i));
      mFiles.push_back(std::move(*file));
    }
  }

  /// A slab's vertices, if any slab has some: what all have normals and properties as.
  [[nodiscard]] Mesh oneWithVertices() const {
    for (const SlabFile& file : mFiles)
      if (file.header().own.solved > 0) return file.solvedVertices();
    return {};
  }

  void forEach(const std::function<void(const SlabFile&, const Before&)>& visit) {
    ++mPass;
    Before before;
    for (std::size_t i = 0; i < mFiles.size(); ++i) {
      mMonitor.throwIfStopped();
      report(i, mFiles.size(), mPass);
      visit(mFiles[i], before);
      mFiles[i].forget();
      before.solved += mFiles[i].header().own.solved;
      before.added += mFiles[i].header().own.added;
    }
  }

  void report(std::size_t done, std::size_t of, int pass) const {
    if (mMonitor.progress)
      mMonitor.progress("merge", (pass + static_cast<double>(done) / static_cast<double>(of)) / double{kPasses});
  }

  const SlabFolder& mFolder;
  const bool mTriangles;
  const MeshWriteOptions& mOptions;
  const Monitor& mMonitor;
  std::vector<SlabFile> mFiles;
  SlabMergeReport mTotal;
  int mPass = 0;
};

}  // namespace

SlabMergeReport mergeSlabs(const SlabFolder& folder, const fs::path& output, bool triangles,
                           const MeshWriteOptions& options, const Monitor& monitor) {
  SlabMerger merger(folder, triangles, options, monitor);
  return merger.write(output);
}

}  // namespace pdc
