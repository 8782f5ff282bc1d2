#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "pdc/io/mesh/mesh_writer.h"
#include "pdc/tile/slab_plan.h"

namespace pdc {

/// A folder in which the slabs of a volume are contoured, by one process or by many, on one machine or on several that
/// share it, in any order and as often as it takes.
///
/// It holds plan.json, and slab_00007.pdcslab for each slab that is done. Files appear when they are complete. Who
/// contours a slab holds a lock on slab_00007.lock (flock), which names host and process, and which the system lets go
/// of when the process ends however it does: nothing has to be cleaned up after a process that was killed.
class SlabFolder {
 public:
  /// Makes the folder, if it is not there, and writes the plan into it. \param request a text that whoever opens the
  /// folder gets back; it says what to contour and how. \throws Error if the folder holds a plan or cannot be written.
  static SlabFolder create(const std::filesystem::path& folder, const SlabPlan& plan, const std::string& request);
  /// \throws Error if there is no plan in the folder, or it is of another version or damaged.
  explicit SlabFolder(std::filesystem::path folder);

  [[nodiscard]] const std::filesystem::path& path() const { return mFolder; }
  [[nodiscard]] const SlabPlan& plan() const { return mPlan; }
  [[nodiscard]] const std::string& request() const { return mRequest; }
  /// What slabs of other plans do not have.
  [[nodiscard]] const std::string& hash() const { return mHash; }

  [[nodiscard]] std::filesystem::path slabFile(std::size_t slab) const;
  [[nodiscard]] std::filesystem::path lockFile(std::size_t slab) const;

 private:
  SlabFolder() = default;

  std::filesystem::path mFolder;
  SlabPlan mPlan;
  std::string mRequest, mHash;
};

/// How far a slab is.
struct SlabState {
  enum class Progress {
    kMissing,   ///< Nobody has contoured it.
    kRunning,   ///< Somebody does.
    kDisputed,  ///< It is done, and a neighbour made something else of layers that both contoured.
    kDone,
  };
  Progress progress = Progress::kMissing;
  std::string runner{};        ///< Host and process, where it is running.
  int halo = 0;                ///< Layers about it that were contoured with it; 0 unless it is done.
  std::uint64_t vertices = 0;  ///< Of those that are done.
  std::uint64_t faces = 0;     ///< Of those that are done.
};

/// The states of all slabs. \throws Error for a slab that is damaged or of another plan, naming its file.
[[nodiscard]] std::vector<SlabState> slabStates(const SlabFolder& folder);

struct SlabRunOptions {
  ContourOptions contour{};                    ///< As planned; `triangles`, `origin` and `exactSums` have no effect.
  std::optional<std::size_t> first{}, last{};  ///< Only these slabs, both included. Empty: all.
  bool onlyOne = false;                        ///< The next that nobody has taken.
  /// What is done to the vertices of each slab, as to give them properties.
  std::function<void(Mesh&)> finish{};
};

/// What a run did.
struct SlabRunReport {
  std::size_t contoured = 0;  ///< Slabs, those that were contoured again included.
  std::size_t widened = 0;    ///< Of them, with twice as many layers about them as before.
  std::size_t left = 0;       ///< That others are contouring.
};

/// Contours the slabs that are missing, and those on which neighbours do not agree, until none is left that nobody else
/// has taken.
///
/// A slab is contoured with six layers about it. What certifying did in four layers on either side of a cut is compared
/// with what the neighbour did there: if that is the same, the slabs are, byte for byte, parts of the mesh that
/// contour() makes of all (docs/tiles.md has the proof). If it is not, both are contoured again with twice as many.
/// \param source all of it. \throws Error, Cancelled; a slab that was begun is then as it was before.
SlabRunReport runSlabs(const SlabFolder& folder, const HermiteSource& source, const SlabRunOptions& options,
                       const Monitor& monitor = {});

struct SlabMergeReport {
  std::uint64_t vertices = 0, quads = 0, triangles = 0, boundaryEdges = 0, multiVertexCells = 0, blocks = 0;
  std::uint64_t added = 0;        ///< Vertices that certifying added.
  std::uint64_t uncertified = 0;  ///< See contour(); pairs in layers that several slabs contoured count for each.
  std::vector<VertexProperty> properties{};  ///< Those of all vertices, without values.
  std::size_t bytesWritten = 0;
};

/// Joins the slabs to a .ply file: the bytes that writeMesh() makes of the whole mesh. A slab is in memory at a time.
/// \param triangles makes two triangles of each quad, as ContourOptions::triangles.
/// \throws Error if slabs are missing, running or disputed, naming the first, if one is damaged, or the mesh has more
/// than 2^32 vertices; nothing is written then. Cancelled.
SlabMergeReport mergeSlabs(const SlabFolder& folder, const std::filesystem::path& output, bool triangles,
                           const MeshWriteOptions& options = {}, const Monitor& monitor = {});

}  // namespace pdc
