#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>

#include "extract/mesh_slab.h"

namespace pdc::detail {

class MappedFile;

/// What a slab's file says of it beside its mesh.
struct SlabHeader {
  std::string plan;  ///< The plan's hash.
  std::size_t slab = 0;
  int halo = 0;
  MeshSlab::Counts own, layerBefore, lastLayer;
  MeshSlab::Seam low, high;
  std::uint64_t blocks = 0, multiVertexCells = 0, boundaryEdges = 0, uncertified = 0, quads = 0, triangles = 0;
};

/// Writes a slab's file, which appears when it is complete. \throws Error if that fails.
void writeSlabFile(const std::filesystem::path& path, const MeshSlab& slab, const SlabHeader& header);

/// The file of a slab, of which only what is asked for is read.
class SlabFile {
 public:
  /// \throws Error, naming the file, if it is none of this version, of another plan or slab, or not whole.
  SlabFile(const std::filesystem::path& path, const std::string& plan, std::size_t slab);
  ~SlabFile();
  SlabFile(SlabFile&&) noexcept;
  SlabFile& operator=(SlabFile&&) = delete;

  [[nodiscard]] const SlabHeader& header() const { return mHeader; }
  /// Reads all of it. \throws Error, naming the file, if its bytes are not those that were written.
  void check() const;
  /// Lets go of the memory that what was read has taken.
  void forget() const;
  /// A mesh of its solved vertices, or of those that certifying added, with their normals and properties.
  [[nodiscard]] Mesh solvedVertices() const;
  [[nodiscard]] Mesh addedVertices() const;
  /// A mesh of its quads, or its triangles; corners are numbers as MeshSlab has them.
  [[nodiscard]] Mesh quads() const;
  [[nodiscard]] Mesh triangles() const;

 private:
  struct Layout;

  [[nodiscard]] Mesh vertices(std::size_t begin, std::size_t end) const;

  std::filesystem::path mPath;
  std::unique_ptr<const MappedFile> mBytes;
  std::unique_ptr<const Layout> mLayout;
  SlabHeader mHeader;
};

}  // namespace pdc::detail
