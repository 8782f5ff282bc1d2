#include "render/tile.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/shading.h"

namespace pdc::detail {
namespace {

constexpr int kSamplesPerAxis = 2;  ///< Samples per pixel along each axis.

/// Each pixel casts kSkyRays rays at the sky, and kPatternSide² neighbouring pixels cast different ones, so that
/// blurring over as many pixels gives each kSkyRays · kPatterns rays.
constexpr int kRaysPerAxis = 4, kSkyRays = kRaysPerAxis * kRaysPerAxis;
constexpr int kPatternsPerAxis = 4, kPatterns = kPatternsPerAxis * kPatternsPerAxis;
constexpr int kBlurReach = 2;

/// A line begins to show at the first turn of the normal between neighbouring samples, and is full from the second.
constexpr double kLineFromDegrees = 25, kLineFullDegrees = 40;
constexpr float kLineDarkness = 0.9F;
/// A neighbour that is this much farther than the tangent plane says is behind an outline; as a share of the picture's
/// smaller extent.
constexpr float kOutlineDepth = 0.006F;

constexpr float kEdgeHalfWidth = 0.55F;  ///< In pixels.
constexpr float kEdgeDarkness = 0.55F;
/// The edges of triangles lower than this many pixels fade, or these would be nothing but edges.
constexpr float kEdgeFadeHeight = 5;

float cosine(double degrees) { return static_cast<float>(std::cos(degrees * std::numbers::pi / 180)); }

/// Rises from 0 at `from` to 1 at `to`.
float ramp(float x, float from, float to) { return std::clamp((x - from) / (to - from), 0.0F, 1.0F); }

/// Directions [pattern][ray] above the plane z = 0, distributed as the cosine of their angle to z.
using SkyDirections = std::array<std::array<Vec3f, kSkyRays>, kPatterns>;

SkyDirections makeSkyDirections() {
  SkyDirections directions;
  for (int pattern = 0; pattern < kPatterns; ++pattern) {
    // One point of a Hammersley set per pattern shifts the rays within their strata.
    const double shiftU = (pattern + 0.5) / kPatterns;
    double shiftV = 0;
    for (int bit = 0; bit < 4; ++bit) shiftV += (pattern >> bit & 1) / double(2 << bit);
    for (int ray = 0; ray < kSkyRays; ++ray) {
      const double u = (ray % kRaysPerAxis + shiftU) / kRaysPerAxis, v = (ray / kRaysPerAxis + shiftV) / kRaysPerAxis;
      const double radius = std::sqrt(u), turn = 2 * std::numbers::pi * v;
      directions[pattern][ray] =
          vecCast<float>(Vec3d{radius * std::cos(turn), radius * std::sin(turn), std::sqrt(1 - u)});
    }
  }
  return directions;
}

/// A vector at right angles to the unit vector n; it is not zero, but need not be a unit vector.
Vec3f across(const Vec3f& n) { return std::abs(n.z) < 0.9F ? Vec3f{-n.y, n.x, 0} : Vec3f{0, -n.z, n.y}; }

}  // namespace

TileRenderer::TileRenderer(const Picture& picture) : mPicture(picture) {
  const int extent = std::min(picture.options.width, picture.options.height);
  constexpr int kExtentPerReach = 512;  // This makes lines two pixels wide in a picture of 1024.
  mLineReach = std::max(1, extent / kExtentPerReach);
  mMargin = std::max(kBlurReach, (mLineReach + kSamplesPerAxis - 1) / kSamplesPerAxis);
  mPixelsAcross = kTilePixels + 2 * mMargin;
  mSamplesAcross = kSamplesPerAxis * mPixelsAcross;
  constexpr float kReachShare = 0.2F;
  mSkyReach = kReachShare * static_cast<float>(extent);
  mSamples.resize(mSamplesAcross * mSamplesAcross);
  mSky.resize(mPixelsAcross * mPixelsAcross);
}

void TileRenderer::run(int x0, int y0, Image& image) {
  mX0 = static_cast<float>(x0 - mMargin);
  mY0 = static_cast<float>(y0 - mMargin);
  castSamples();
  castSky();
  for (int y = y0; y < std::min(y0 + kTilePixels, image.height); ++y)
    for (int x = x0; x < std::min(x0 + kTilePixels, image.width); ++x) {
      const int column = x - x0 + mMargin, row = y - y0 + mMargin;
      Vec3f sum{};
      for (int s = 0; s < kSamplesPerAxis * kSamplesPerAxis; ++s)
        sum += color(kSamplesPerAxis * column + s % kSamplesPerAxis, kSamplesPerAxis * row + s / kSamplesPerAxis);
      sum *= 1.0F / (kSamplesPerAxis * kSamplesPerAxis);
      image.pixels[static_cast<std::size_t>(y) * image.width + x] = {toByte(sum.x), toByte(sum.y), toByte(sum.z)};
    }
}

void TileRenderer::castSamples() {
  for (int row = 0; row < mSamplesAcross; ++row)
    for (int column = 0; column < mSamplesAcross; ++column)
      mSamples[column + row * mSamplesAcross] = cast(mX0 + (static_cast<float>(column) + 0.5F) / kSamplesPerAxis,
                                                     mY0 + (static_cast<float>(row) + 0.5F) / kSamplesPerAxis);
  for (const std::uint32_t sliver : mPicture.divided.slivers) drawSliver(sliver);
}

TileRenderer::Sample TileRenderer::cast(float x, float y) const {
  const float up = static_cast<float>(mPicture.options.height) - y;
  const RayHit hit = mPicture.rays.hit({x, up, mPicture.eyeHeight}, {0, 0, -1});
  if (!hit.found) return {};
  const Buffer<std::uint32_t>& numbers = mPicture.divided.otherNumbers;
  return sampleOf(numbers.empty() ? hit.triangle : numbers[hit.triangle], {1 - hit.u - hit.v, hit.u, hit.v},
                  mPicture.eyeHeight - hit.distance);
}

TileRenderer::Sample TileRenderer::sampleOf(std::uint32_t triangle, const std::array<float, 3>& weights,
                                            float z) const {
  const ViewMesh& mesh = mPicture.mesh;
  const RenderOptions& options = mPicture.options;
  const Triangle& t = mesh.triangles[triangle];
  Sample sample{.z = z, .hit = true};
  for (int k = 0; k < 3; ++k) sample.normal += mesh.cornerNormals[triangle][k] * weights[k];
  const float l = length(sample.normal);
  sample.normal = l > 0 ? sample.normal * (1 / l) : mesh.faceNormals[triangle];
  sample.backFace = mesh.faceNormals[triangle].z < 0;
  if (sample.backFace) sample.normal = -sample.normal;
  if (options.shading == Shading::kValues) {
    float value = 0;
    for (int k = 0; k < 3; ++k) value += options.values[t[k]] * weights[k];
    const float range = options.valueHi - options.valueLo;
    sample.value = range > 0 ? (value - options.valueLo) / range : 0;
  }
  if (options.edges) sample.edge = edgeDarkness(triangle, weights);
  return sample;
}

void TileRenderer::drawSliver(std::uint32_t triangle) {
  const Triangle& t = mPicture.mesh.triangles[triangle];
  const std::array<Vec3f, 3> corners{mPicture.mesh.positions[t[0]], mPicture.mesh.positions[t[1]],
                                     mPicture.mesh.positions[t[2]]};
  const auto up = static_cast<double>(mPicture.options.height);
  const auto [low, high] = std::minmax({corners[0].y, corners[1].y, corners[2].y});
  // Sample i of a row or column lies at (i + 1/2) / kSamplesPerAxis from the tile's border; x runs to the right, rows
  // run down.
  const auto toSample = [](double pixels) { return pixels * kSamplesPerAxis - 0.5; };
  const auto clamped = [&](double sample) { return static_cast<int>(std::clamp(sample, 0.0, double(mSamplesAcross))); };
  const int firstRow = clamped(std::floor(toSample(up - double(high) - double(mY0))));
  const int lastRow = clamped(std::ceil(toSample(up - double(low) - double(mY0))) + 1);
  for (int row = firstRow; row < lastRow; ++row) {
    const double y = up - double(mY0) - (row + 0.5) / kSamplesPerAxis;
    const Span span = rowSpan(corners, y);
    if (!(span.begin < span.end)) continue;
    const int end = clamped(std::ceil(toSample(span.end - double(mX0))));
    for (int column = clamped(std::ceil(toSample(span.begin - double(mX0)))); column < end; ++column) {
      const std::array<float, 3> w = planeWeights(corners, double(mX0) + (column + 0.5) / kSamplesPerAxis, y);
      const float z = corners[0].z * w[0] + corners[1].z * w[1] + corners[2].z * w[2];
      Sample& sample = mSamples[column + row * mSamplesAcross];
      if (!sample.hit || z > sample.z) sample = sampleOf(triangle, w, z);
    }
  }
}

float TileRenderer::edgeDarkness(std::uint32_t triangle, const std::array<float, 3>& weights) const {
  const ViewMesh& mesh = mPicture.mesh;
  const auto flat = [&](int k) {
    const Vec3f& p = mesh.positions[mesh.triangles[triangle][k]];
    return Vec3f{p.x, p.y, 0};
  };
  const std::array<Vec3f, 3> p{flat(0), flat(1), flat(2)};
  const float doubleArea = std::abs(cross(p[1] - p[0], p[2] - p[0]).z);
  float nearest = kEdgeHalfWidth, lowest = kEdgeFadeHeight;
  for (int k = 0; k < 3; ++k) {
    const float height = doubleArea / length(p[(k + 2) % 3] - p[(k + 1) % 3]);
    lowest = std::min(lowest, height);
    if ((mesh.drawnEdges[triangle] >> k & 1) != 0) nearest = std::min(nearest, weights[k] * height);
  }
  return nearest < kEdgeHalfWidth ? kEdgeDarkness * lowest / kEdgeFadeHeight : 0;
}

void TileRenderer::castSky() {
  for (int row = 0; row < mPixelsAcross; ++row)
    for (int column = 0; column < mPixelsAcross; ++column) {
      Sky& sky = mSky[column + row * mPixelsAcross];
      sky = {};
      Vec3f p{};
      for (int s = 0; s < kSamplesPerAxis * kSamplesPerAxis; ++s) {
        const int c = kSamplesPerAxis * column + s % kSamplesPerAxis, r = kSamplesPerAxis * row + s / kSamplesPerAxis;
        const Sample& sample = sampleAt(c, r);
        if (!sample.hit || (sky.hit && sample.z <= sky.z)) continue;
        sky = {sample.normal, sample.z, 1, true};
        p = {mX0 + (static_cast<float>(c) + 0.5F) / kSamplesPerAxis,
             static_cast<float>(mPicture.options.height) - mY0 - (static_cast<float>(r) + 0.5F) / kSamplesPerAxis,
             sample.z};
      }
      if (!sky.hit) continue;
      const int x = static_cast<int>(mX0) + column, y = static_cast<int>(mY0) + row;
      sky.open = openSky(p, sky.normal, (x & (kPatternsPerAxis - 1)) + kPatternsPerAxis * (y & (kPatternsPerAxis - 1)));
    }
}

float TileRenderer::openSky(const Vec3f& p, const Vec3f& n, int pattern) const {
  static const SkyDirections kDirections = makeSkyDirections();
  // Smoothed normals may point a little into the surface; from this many pixels above it rays do not graze their own
  // triangle.
  constexpr float kLift = 0.75F;
  const Vec3f origin = p + n * kLift;
  const Vec3f aside = across(n) * (1 / length(across(n))), other = cross(n, aside);
  int open = 0;
  for (const Vec3f& d : kDirections[pattern])
    open += !mPicture.occluders.blocked(origin, aside * d.x + other * d.y + n * d.z, mSkyReach);
  return static_cast<float>(open) / kSkyRays;
}

/// The mean over the pixels around that lie on the same surface.
float TileRenderer::skyAt(const Sample& sample, int column, int row) const {
  constexpr float kSameNormal = 0.9F;  // cosine
  constexpr float kSameDepth = 3;      // pixels off the tangent plane
  const int middleColumn = column / kSamplesPerAxis, middleRow = row / kSamplesPerAxis;
  float sum = 0, weight = 0;
  // The range is four pixels across, so that each pattern comes once.
  for (int dy = -kBlurReach; dy < kBlurReach; ++dy)
    for (int dx = -kBlurReach; dx < kBlurReach; ++dx) {
      const Sky& sky = mSky[middleColumn + dx + (middleRow + dy) * mPixelsAcross];
      if (!sky.hit || dot(sky.normal, sample.normal) < kSameNormal) continue;
      const Vec3f step{static_cast<float>(dx), static_cast<float>(-dy), sky.z - sample.z};
      if (std::abs(dot(step, sample.normal)) > kSameDepth) continue;
      sum += sky.open;
      weight += 1;
    }
  return weight > 0 ? sum / weight : mSky[middleColumn + middleRow * mPixelsAcross].open;
}

float TileRenderer::lineDarkness(const Sample& sample, int column, int row) const {
  static const float kFrom = cosine(kLineFromDegrees), kFull = cosine(kLineFullDegrees);
  const auto extent = static_cast<float>(std::min(mPicture.options.width, mPicture.options.height));
  float darkness = 0;
  constexpr std::array<std::array<int, 2>, 8> kAround{
      {{-1, -1}, {0, -1}, {1, -1}, {-1, 0}, {1, 0}, {-1, 1}, {0, 1}, {1, 1}}};
  for (const auto& [x, y] : kAround) {
    const int dx = x * mLineReach, dy = y * mLineReach;
    const Sample& other = sampleAt(column + dx, row + dy);
    if (!other.hit) return 1;
    const Vec3f& n = sample.normal;
    // How far the tangent plane falls on the way there; n.z is kept off 0, since a plane seen edge-on says nothing.
    const float slope =
        (n.x * static_cast<float>(dx) - n.y * static_cast<float>(dy)) / (kSamplesPerAxis * std::max(n.z, 0.1F));
    const float gap = sample.z - slope - other.z;
    darkness = std::max(darkness, ramp(gap, kOutlineDepth * extent, 1.5F * kOutlineDepth * extent));
    // What lies beyond an outline makes no crease with it.
    if (std::abs(gap) < kOutlineDepth * extent) darkness = std::max(darkness, ramp(dot(n, other.normal), kFrom, kFull));
  }
  return darkness;
}

Vec3f TileRenderer::color(int column, int row) const {
  const Sample& sample = sampleAt(column, row);
  if (!sample.hit) return backgroundColor();
  const Vec3f surface =
      surfaceColor(mPicture.options.shading, sample.normal, sample.value, sample.backFace, skyAt(sample, column, row));
  const float lit = (1 - kLineDarkness * lineDarkness(sample, column, row)) * (1 - sample.edge);
  return surface * lit;
}

}  // namespace pdc::detail
