#include "pdc/study/view_page.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>
#include <string_view>

#include "io/file/atomic_file.h"
#include "io/file/file_error.h"
#include "io/file/suffix.h"
#include "io/mesh/vertex_colours.h"
#include "mesh/faces.h"
#include "mesh/local/magnitudes.h"
#include "mesh/mesh_checks.h"
#include "pdc/mesh/distance.h"
#include "render/shading.h"
#include "study/page_text.h"
#include "study/view/packed_numbers.h"
#include "study/view/page_mesh.h"
#include "study/view/viewer_files.h"

namespace pdc {
namespace {

constexpr auto kHead = R"(<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data:">
<link rel="icon" href="data:,">
)";

/// Text that stands in a script of JSON: nothing in it may look like the script's end.
std::string scriptText(std::string_view text) {
  std::string result;
  for (const char c : detail::jsonText(text)) {
    if (c == '<')
      result += "\\u003c";
    else
      result += c;
  }
  return result;
}

std::string list(const Vec3d& v) { return fmt::format("[{}, {}, {}]", v.x, v.y, v.z); }

/// Collects the page's data: a script of JSON that says what there is, and one of packed numbers for each array.
class PageData {
 public:
  void add(const std::string& name, std::span<const std::uint32_t> numbers) {
    mArrays += fmt::format("<script type=\"text/plain\" id=\"{}\">{}</script>\n", name,
                           detail::base64(detail::packNumbers(numbers)));
  }
  void add(const std::string& name, const detail::PageMesh& mesh) {
    mFacts += fmt::format(
        R"("{}": {{"corner": {}, "size": {}, "step": {}, "vertices": {}, "quads": {}, "triangles": {}, "lostFaces": {}}}, )",
        name, list(mesh.corner), list(mesh.size), mesh.step, mesh.vertices(), mesh.quads, mesh.triangles(),
        mesh.lostFaces);
    add(name + "_positions", mesh.positions);
    add(name + "_corners", mesh.corners);
  }
  void add(const detail::PageValues& values) {
    mShadings += fmt::format(R"({}{{"name": {}, "array": "values_{}", "lo": {}, "hi": {}, "unknown": {}}})",
                             mShadings.empty() ? "" : ", ", scriptText(values.name), mCount, values.lo, values.hi,
                             values.unknown);
    add(fmt::format("values_{}", mCount++), values.places);
  }
  /// \param more further members of the JSON object.
  [[nodiscard]] std::string html(const std::string& more) const {
    return fmt::format("<script type=\"application/json\" id=\"facts\">{{{}\"shadings\": [{}], {}}}</script>\n{}",
                       mFacts, mShadings, more, mArrays);
  }

 private:
  std::string mFacts, mShadings, mArrays;
  int mCount = 0;
};

detail::PageMesh pageMesh(const Mesh& mesh) {
  if (const std::size_t triangles = detail::triangleCount(mesh); triangles > kMaxViewTriangles)
    throw Error(
        fmt::format("{} triangles, a page holds at most {}; decimate the mesh first", triangles, kMaxViewTriangles));
  return detail::pageMesh(mesh);
}

detail::PageMesh referenceMesh(const Mesh& reference) {
  try {
    return pageMesh(reference);
  } catch (const Error& error) {
    throw Error(fmt::format("the reference: {}", error.what()));
  }
}

/// The colours of values, from the lowest to the highest, as "[[red, green, blue], ...]" in linear light.
std::string ramp() {
  constexpr int kColours = 5;
  std::string text;
  for (int i = 0; i < kColours; ++i) {
    const Vec3f c = detail::valueColor(static_cast<float>(i) / (kColours - 1));
    text += (i > 0 ? ", " : "") + list(vecCast<double>(c));
  }
  return "[" + text + "]";
}

/// Tells the monitor how far it is, by the arrays packed.
class Steps {
 public:
  Steps(std::size_t count, const Monitor& monitor) : mCount(count), mMonitor(monitor) {}
  void done() {
    mMonitor.throwIfStopped();
    if (mMonitor.progress) mMonitor.progress("packing", static_cast<double>(++mDone) / static_cast<double>(mCount));
  }

 private:
  std::size_t mCount, mDone = 0;
  const Monitor& mMonitor;
};

void addShadings(const Mesh& mesh, const ViewPageOptions& options, const Monitor& monitor, PageData& data) {
  const bool coloured = detail::hasColours(mesh);
  Steps steps(mesh.properties.size() + 1, monitor);
  if (options.reference != nullptr) {
    const Buffer<double> distances = vertexDistances(mesh, *options.reference, monitor);
    Buffer<float> values;
    values.reserve(distances.size());
    for (const double d : distances) values.push_back(static_cast<float>(d));
    data.add(detail::pageValues("distance to the reference", values));
  }
  for (const VertexProperty& property : mesh.properties) {
    if (!(coloured && detail::isColour(property.name)))
      data.add(detail::pageValues(property.name, detail::magnitudes(property)));
    steps.done();
  }
  if (coloured) data.add("colours", detail::pageColours(mesh));
  steps.done();
}

void check(const Mesh& mesh, const ViewPageOptions& options) {
  detail::checkSizes(mesh, "writeViewPage");
  if (options.reference != nullptr) detail::checkSizes(*options.reference, "writeViewPage");
  const double length = pdc::length(options.towardsViewer);
  if (!(length > 0 && std::isfinite(length)))
    throw std::invalid_argument("writeViewPage: towardsViewer must have a finite length above 0");
}

}  // namespace

void checkViewPagePath(const std::filesystem::path& path) {
  if (const std::string suffix = detail::suffixOf(path); suffix != ".html" && suffix != ".htm")
    throw detail::fileError(path, "the name of a page must end in .html");
  detail::checkWritable(path);
}

ViewPageReport writeViewPage(const Mesh& mesh, const std::filesystem::path& path, const ViewPageOptions& options,
                             const Monitor& monitor) {
  check(mesh, options);
  checkViewPagePath(path);
  const detail::PageMesh shown = pageMesh(mesh);
  ViewPageReport report{.triangles = shown.triangles(), .lostFaces = shown.lostFaces};
  PageData data;
  data.add("mesh", shown);
  monitor.throwIfStopped();
  if (options.reference != nullptr) {
    const detail::PageMesh reference = referenceMesh(*options.reference);
    report.lostFaces += reference.lostFaces;
    data.add("reference", reference);
  }
  addShadings(mesh, options, monitor, data);
  const std::string name = options.title.empty() ? path.filename().string() : options.title;
  const std::string title = detail::htmlText(name);
  const std::string more = fmt::format(R"("coloured": {}, "view": {}, "ramp": {})", detail::hasColours(mesh),
                                       list(options.towardsViewer), ramp());
  detail::AtomicFile file(path);
  const auto write = [&file](std::string_view text) { file.write(text.data(), text.size()); };
  write(fmt::format("{}<title>{}</title>\n<style>\n", kHead, title));
  write(detail::kViewerStyle);
  write(fmt::format("</style>\n</head>\n<body>\n<h1>{}</h1>\n", title));
  write(detail::kViewerBody);
  write(data.html(more));
  write("<script>\n");
  write(detail::kViewerScript);
  write("</script>\n</body>\n</html>\n");
  file.commit();
  report.bytes = file.bytesWritten();
  return report;
}

}  // namespace pdc
