#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "pdc/mesh/mesh.h"
#include "pdc/monitor.h"

namespace pdc {

/// What a page with one mesh says and shows beside it.
struct ViewPageOptions {
  std::string title{};              ///< UTF-8 without markup, which is escaped. Empty: the page's file name.
  Vec3d towardsViewer{1, -1, 1};    ///< From where it is seen first, as viewNamed() gives it.
  const Mesh* reference = nullptr;  ///< A mesh to lay over it and to measure distances to; null for none.
};

/// What became of the mesh in its page.
struct ViewPageReport {
  std::size_t bytes = 0;      ///< The page's size.
  std::size_t triangles = 0;  ///< Those shown of the mesh; a quad counts as two.
  std::size_t lostFaces = 0;  ///< Faces of both meshes that were left out: a corner is NaN or infinite.
};

/// More triangles in one mesh, quads as two, are refused: browsers would run out of memory.
inline constexpr std::size_t kMaxViewTriangles = 10'000'000;

/// Checks that writeViewPage() could write there, and makes no file. \throws Error unless `path` ends in .html or .htm,
/// in any case, and lies in a folder that exists and can be written to.
void checkViewPagePath(const std::filesystem::path& path);

/// Writes an HTML page that needs nothing but itself and a browser with WebGL 2: the mesh to turn, its edges, lines
/// along creases, a section plane, colours by each property of its vertices (of vectors the length), by their colours
/// where it has any, and, if there is a reference, that mesh over it and colours by the distance to it. It adapts to
/// light and dark displays, to widths from that of a phone, and is used by mouse, touch or keyboard. It appears under
/// its name only when it is complete.
///
/// The page is for looking, not for keeping: coordinates are rounded to 2^-20 of the longest side of the mesh's box,
/// properties to 1/65000 of their range, and what is not finite in those is unknown, which is grey.
///
/// Runs in parallel; the same bytes for any number of threads. \throws Error for a mesh or reference without a face
/// with finite corners, with a face that names a vertex that does not exist, or with too many triangles, and what
/// checkViewPagePath() throws; std::invalid_argument for arrays that do not fit together (see Mesh) and a direction
/// towardsViewer without length; Cancelled. No file is made then.
ViewPageReport writeViewPage(const Mesh& mesh, const std::filesystem::path& path, const ViewPageOptions& options = {},
                             const Monitor& monitor = {});

}  // namespace pdc
