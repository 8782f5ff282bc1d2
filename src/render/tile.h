#pragma once

#include <array>
#include <memory>
#include <vector>

#include "pdc/render/render.h"
#include "rays/ray_scene.h"
#include "render/slivers.h"
#include "render/view_mesh.h"

namespace pdc::detail {

/// Everything tiles of one picture share.
struct Picture {
  const ViewMesh& mesh;
  const DividedTriangles& divided;
  const RayScene& rays;       ///< At the mesh's triangles, or those of `divided.others` where it has any lists.
  const RayScene& occluders;  ///< What casts shadows: the scene itself, or `divided.occluders`.
  const RenderOptions& options;
  float eyeHeight;  ///< The z from which rays start, above the whole mesh.
};

/// Renders squares of a picture one after the other. A tile looks a few pixels beyond its borders, so that what it
/// makes does not depend on how the picture is cut up. Each thread needs a renderer of its own.
class TileRenderer {
 public:
  /// With this size the margin costs an eighth, and two threads still share a small picture.
  static constexpr int kTilePixels = 128;

  explicit TileRenderer(const Picture& picture);

  /// Renders the pixels from (x0, y0) to (x0 + kTilePixels, y0 + kTilePixels), as far as the picture goes.
  void run(int x0, int y0, Image& image);

 private:
  struct Sample {
    Vec3f normal{};   ///< Faces the viewer; zero where there is no surface.
    float z = 0;      ///< In pixels, towards the viewer.
    float value = 0;  ///< The value's place in the range of kValues, from 0 to 1.
    float edge = 0;   ///< Darkness of the mesh's edge over it, 0 without one.
    bool hit = false, backFace = false;
  };
  /// The sample of a pixel that is nearest to the viewer, and the share of the sky that it sees.
  struct Sky {
    Vec3f normal{};
    float z = 0, open = 1;
    bool hit = false;
  };

  void castSamples();
  /// Adds the sample of a sliver where it is the nearest.
  void drawSliver(std::uint32_t triangle);
  [[nodiscard]] Sample cast(float x, float y) const;
  /// \param weights of the triangle's corners.
  [[nodiscard]] Sample sampleOf(std::uint32_t triangle, const std::array<float, 3>& weights, float z) const;
  [[nodiscard]] float edgeDarkness(std::uint32_t triangle, const std::array<float, 3>& weights) const;
  void castSky();
  [[nodiscard]] float openSky(const Vec3f& p, const Vec3f& n, int pattern) const;
  [[nodiscard]] float skyAt(const Sample& sample, int column, int row) const;
  [[nodiscard]] float lineDarkness(const Sample& sample, int column, int row) const;
  [[nodiscard]] Vec3f color(int column, int row) const;
  [[nodiscard]] const Sample& sampleAt(int column, int row) const { return mSamples[column + row * mSamplesAcross]; }

  const Picture& mPicture;
  int mLineReach;          ///< Half the width of lines, in samples.
  int mMargin;             ///< In pixels.
  int mPixelsAcross;       ///< Pixels per row, margins included.
  int mSamplesAcross;      ///< Samples per row, margins included.
  float mSkyReach;         ///< How far occluders count, in pixels.
  float mX0 = 0, mY0 = 0;  ///< Where the margins begin, from the left and from the top of the picture.
  std::vector<Sample> mSamples;
  std::vector<Sky> mSky;
};

}  // namespace pdc::detail
