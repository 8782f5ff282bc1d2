#include "tiles/contour_in_slabs.h"

#include <fmt/format.h>
#include <unistd.h>

#include "extract/contour_memory.h"
#include "files/mesh_attributes.h"
#include "io/file/suffix.h"
#include "parallel/machine_memory.h"
#include "pdc/error.h"
#include "terminal/shown_path.h"

namespace pdc {
namespace {

namespace fs = std::filesystem;

/// A folder that is removed with all that is in it.
class TemporaryFolder {
 public:
  explicit TemporaryFolder(fs::path path) : mPath(std::move(path)) {}
  ~TemporaryFolder() {
    std::error_code error;
    fs::remove_all(mPath, error);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  [[nodiscard]] const fs::path& path() const { return mPath; }

 private:
  fs::path mPath;
};

}  // namespace

bool canBeInSlabs(const fs::path& output, const ContourOptions& options,
                  const std::optional<ContourForecast>& forecast) {
  if (detail::suffixOf(output) != ".ply" || options.adaptive) return false;
  if (!forecast) return true;
  constexpr double kMostVertices = 4294967296, kSignsPerVertex = 3, kDiskPerVertex = 2 * 29;
  const double limit =
      options.maxMemory > 0 ? static_cast<double>(options.maxMemory) : static_cast<double>(detail::availableMemory());
  if (forecast->vertices > kMostVertices || kSignsPerVertex * forecast->vertices > limit) return false;
  std::error_code error;
  const fs::space_info disk = fs::space(fs::absolute(output).parent_path(), error);
  const double needed = kDiskPerVertex * forecast->vertices;
  if (!error && needed > static_cast<double>(disk.available))
    throw Error(fmt::format("{}: its slabs and itself take about {}, more than the {} that are free there",
                            shownPath(output), detail::bytesText(needed),
                            detail::bytesText(static_cast<double>(disk.available))));
  return true;
}

void checkSlabs(const fs::path& output, const ContourOptions& options) {
  if (detail::suffixOf(output) != ".ply")
    throw Error(fmt::format("{}: only a .ply can be written slab by slab", shownPath(output)));
  if (options.adaptive) throw Error("--adaptive needs the whole mesh, which cannot be made slab by slab");
}

SlabbedMesh contourInSlabs(const Input& input, const ContourOptions& options, const fs::path& output,
                           const MeshWriteOptions& write, const Monitor& monitor) {
  checkSlabs(output, options);
  const SlabPlan plan = planSlabs(*input.source, options, {.maxMemory = options.maxMemory}, monitor);
  const TemporaryFolder folder(output.string() + fmt::format(".slabs-{}", ::getpid()));
  const SlabFolder slabs = SlabFolder::create(folder.path(), plan, "");
  const auto finish = [&](Mesh& mesh) { addAttributes(input, mesh, {.progress = {}, .stop = monitor.stop}); };
  SlabbedMesh result;
  result.slabs = plan.slabs.size();
  result.origin = plan.origin;
  result.run = runSlabs(slabs, *input.source, {.contour = options, .finish = finish}, monitor);
  result.merged = mergeSlabs(slabs, output, options.triangles, write, monitor);
  return result;
}

}  // namespace pdc
