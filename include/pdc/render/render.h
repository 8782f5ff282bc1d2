#pragma once

#include <optional>
#include <span>

#include "pdc/mesh/mesh.h"
#include "pdc/monitor.h"
#include "pdc/render/camera.h"
#include "pdc/render/image.h"

namespace pdc {

/// What colours a picture shows.
enum class Shading {
  kClay,    ///< One matt colour under one lamp.
  kNormal,  ///< Colours of the normal's direction: right is red, up is green, towards the viewer is blue.
  kValues,  ///< Colours of `values`, from dark blue at the low end over green to yellow at the high end.
};

/// How a mesh is rendered.
struct RenderOptions {
  int width = 1024, height = 1024;  ///< In pixels, 1 to kMaxImageSide.
  Vec3d towardsViewer{1, -1, 1};    ///< As viewNamed() gives it; ignored if there is a camera.
  std::optional<Camera> camera{};   ///< Default: fitCamera() of the mesh.
  Shading shading = Shading::kClay;
  bool edges = false;               ///< Draws the mesh's edges, but not the diagonals of quads.
  std::span<const float> values{};  ///< One per vertex, for kValues; NaN is grey.
  float valueLo = 0, valueHi = 1;   ///< The ends of the colours; values beyond them take the end's colour.
  int threads = 0;                  ///< 0 takes all. The result does not depend on it, byte for byte.
};

inline constexpr int kMaxImageSide = 8192;

/// A picture of a mesh, by ray casting: four samples a pixel, ambient occlusion, and dark lines where the normal turns
/// by some 30 degrees between neighbouring samples (creases, sharp or chamfered) and at outlines. Normals are the
/// faces', smoothed over edges whose faces meet at less than 30 degrees. Back faces are reddish, so that holes and
/// inside-out meshes show. Needs neither display nor graphics hardware; time grows with the pixels covered and the
/// number of triangles (see README). The same bytes for any number of threads on machines of one kind; others may
/// differ in the last bit of a colour.
///
/// \throws Error for a mesh without a face with finite corners, or one that names a vertex that does not exist;
/// std::invalid_argument for sizes out of range, negative threads, and kValues without a value per vertex; Cancelled.
[[nodiscard]] Image render(const Mesh& mesh, const RenderOptions& options = {}, const Monitor& monitor = {});

}  // namespace pdc
