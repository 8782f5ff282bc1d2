#include "pdc/io/mesh/cluster_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string_view>
#include <vector>

#include "io/file/file_error.h"
#include "io/file/mapped_file.h"
#include "io/mesh/mesh_format.h"
#include "io/mesh/ply_stream.h"
#include "io/parse/origin_text.h"
#include "io/parse/stl_reader.h"
#include "pdc/io/mesh/mesh_reader.h"

namespace pdc {
namespace {

using detail::MappedFile;

/// How many bytes of the file stay in memory behind what was read.
constexpr std::size_t kForgetAfter = std::size_t{1} << 24;

class Streaming {
 public:
  Streaming(const MappedFile& file, const ClusterOptions& options, const Monitor& monitor)
      : mFile(file), mClustering(options), mMonitor(monitor) {}

  Mesh ply(detail::PlyStream& stream, ClusterReport* report) {
    const std::size_t size = mFile.bytes().size();
    mForgotten = size - stream.left();
    while (stream.next(mTriangles)) add(stream.facesRead(), stream.faces(), size - stream.left());
    return finish(stream.origin(), report);
  }

  Mesh stl(ClusterReport* report) {
    const std::string_view bytes(mFile.bytes().data(), mFile.bytes().size());
    const std::size_t count = (bytes.size() - detail::kStlHeaderBytes) / detail::kStlFacetBytes;
    for (std::size_t begin = 0; begin < count; begin += kBlock) {
      const std::size_t end = std::min(begin + kBlock, count);
      mTriangles.resize(end - begin);
      for (std::size_t i = begin; i < end; ++i)
        std::memcpy(&mTriangles[i - begin], bytes.data() + facetAt(i) + sizeof(Vec3f), sizeof(mTriangles[0]));
      add(end, count, facetAt(end));
    }
    return finish(detail::originInHeader(bytes.substr(0, detail::kStlTitleBytes)).value_or(Vec3d{0, 0, 0}), report);
  }

 private:
  static constexpr std::size_t kBlock = 4096;

  static std::size_t facetAt(std::size_t i) { return detail::kStlHeaderBytes + i * detail::kStlFacetBytes; }

  void add(std::size_t done, std::size_t all, std::size_t bytesRead) {
    mClustering.add(mTriangles);
    mMonitor.throwIfStopped();
    if (mMonitor.progress) mMonitor.progress("cluster", static_cast<double>(done) / static_cast<double>(all));
    if (bytesRead < mForgotten + kForgetAfter) return;
    mFile.forget(mForgotten, bytesRead);
    mForgotten = bytesRead;
  }

  Mesh finish(const Vec3d& origin, ClusterReport* report) {
    Mesh mesh = mClustering.finish(report);
    mesh.origin = origin;
    return mesh;
  }

  const MappedFile& mFile;
  Clustering mClustering;
  const Monitor& mMonitor;
  std::vector<std::array<Vec3f, 3>> mTriangles;
  std::size_t mForgotten = 0;
};

/// Nothing where the file has to be read whole.
std::optional<Mesh> stream(const std::filesystem::path& path, const ClusterOptions& options, ClusterReport* report,
                           const std::function<void(const std::string&)>& warn, const Monitor& monitor) {
  const detail::MeshFormat named = detail::meshFormat(path);
  const MappedFile file(path);
  const std::string_view bytes(file.bytes().data(), file.bytes().size());
  // What is wrong about other files is for readMesh() to say.
  if (detail::certainFormat(bytes) != named) return std::nullopt;
  if (named == detail::MeshFormat::kStl && detail::isExactBinaryStl(bytes))
    return Streaming(file, options, monitor).stl(report);
  if (named != detail::MeshFormat::kPly) return std::nullopt;
  const detail::PlyHeader header = detail::parsePlyHeader(file.bytes());
  auto faces = detail::PlyStream::open(header);
  if (!faces) return std::nullopt;
  Mesh mesh = Streaming(file, options, monitor).ply(*faces, report);
  if (const std::size_t unread = faces->unread(); unread > 0 && warn)
    warn(detail::fileError(path, fmt::format("{} bytes after the last element are not read", unread)).what());
  return mesh;
}

}  // namespace

Mesh clusterFile(const std::filesystem::path& path, const ClusterOptions& options, ClusterReport* report,
                 const std::function<void(const std::string&)>& warn, const Monitor& monitor) {
  // What is wrong in the request is said before the file is looked at.
  static_cast<void>(cluster({}, options));
  static_cast<void>(detail::meshFormat(path));
  try {
    if (!options.weld)
      if (auto mesh = stream(path, options, report, warn, monitor)) return std::move(*mesh);
  } catch (const Error& error) {
    throw detail::fileError(path, error.what());
  }
  const Mesh whole = readMesh(path, {.warn = warn});
  try {
    return cluster(whole, options, report, monitor);
  } catch (const Error& error) {
    throw detail::fileError(path, error.what());
  }
}

}  // namespace pdc
