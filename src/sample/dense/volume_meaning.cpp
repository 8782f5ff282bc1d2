#include "sample/dense/volume_meaning.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "pdc/sample/dense/value_histogram.h"
#include "sample/dense/volume_scan.h"
#include "sample/meaning/grid_meaning.h"
#include "sample/meaning/slope_sample.h"

namespace pdc::detail {
namespace {

constexpr std::size_t kSampledBlocks = 64;
/// Points of a face of the volume that are looked at, along each of its sides.
constexpr std::int64_t kFacePoints = 64;
/// From this share of values on that equal the largest one, they stand for all beyond the end of a band.
constexpr double kBandEnd = 0.02;

bool isInteger(ScalarType type) {
  return type != ScalarType::kFloat16 && type != ScalarType::kFloat32 && type != ScalarType::kFloat64;
}

double medianOf(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

class MeaningReader {
 public:
  MeaningReader(const VolumeReader& values, const VolumeSigns* mask, const LatticeMap& map,
                const DenseSourceOptions& options)
      : mValues(values),
        mMask(mask),
        mMap(map),
        mView(values.sampler().view()),
        mOptions(options),
        mAsked{.iso = options.iso, .gridClass = options.gridClass, .inside = options.inside} {}

  VolumeMeaning read() {
    mEvidence.voxelSize = mMap.voxelSize();
    mEvidence.mask = mView.type == ScalarType::kBool;
    if (mEvidence.mask) return readBooleans();
    lookAtSome();
    lookAtFaces();
    const bool mayBeSigned = !(isUnsigned() && mView.slope > 0 && mView.intercept >= 0);
    if (!mOptions.gridClass && !mayBeSigned) mAsked.gridClass = GridClass::kFogVolume;
    Reading reading = decide();
    if (!mOptions.gridClass && mayBeSigned && !isClear(reading.meaning)) {
      lookAtAll();
      // Where all values are equal they are no background.
      if (mEvidence.low == mEvidence.high) mAsked.gridClass = GridClass::kFogVolume;
      reading = decide();
    }
    if (isSignedFog(reading.meaning)) {
      mAsked.gridClass = GridClass::kFogVolume;
      mExtra.push_back(GridDoubt::kClassUnclear);
      reading = decide();
    }
    if (reading.meaning.gridClass == GridClass::kFogVolume) {
      mEvidence.background = mEvidence.low;  // Beyond the volume is outside.
      if (!mOptions.iso) chooseIso();
      reading = decide();
    }
    return finish(reading);
  }

 private:
  [[nodiscard]] bool isUnsigned() const {
    return mView.type == ScalarType::kUint8 || mView.type == ScalarType::kUint16 || mView.type == ScalarType::kUint32 ||
           mView.type == ScalarType::kUint64;
  }
  [[nodiscard]] Reading decide() const { return decideMeaning(mEvidence, std::nullopt, mAsked); }

  VolumeMeaning readBooleans() {
    if (!mAsked.iso) mAsked.iso = mView.intercept + 0.5 * mView.slope;
    // True is inside, whichever number stands for it.
    if (!mAsked.inside && mView.slope < 0) mAsked.inside = InsideValues::kLow;
    return finish(decide());
  }

  VolumeMeaning finish(const Reading& reading) const {
    VolumeMeaning result{reading.meaning, reading.clamp};
    GridMeaning& meaning = result.meaning;
    if (!mOptions.gridClass && meaning.classBy == DecidedBy::kCaller) meaning.classBy = DecidedBy::kValues;
    if (!mOptions.inside) meaning.insideBy = mEvidence.mask ? DecidedBy::kType : meaning.classBy;
    meaning.doubts.insert(meaning.doubts.end(), mExtra.begin(), mExtra.end());
    std::sort(meaning.doubts.begin(), meaning.doubts.end());
    meaning.doubts.erase(std::unique(meaning.doubts.begin(), meaning.doubts.end()), meaning.doubts.end());
    return result;
  }

  /// Distances of both signs are a level set whatever the range of all values is.
  [[nodiscard]] bool isClear(const GridMeaning& meaning) const {
    return meaning.gridClass == GridClass::kLevelSet && mEvidence.low < 0 && mEvidence.high > 0 &&
           std::ranges::find(meaning.doubts, GridDoubt::kClassUnclear) == meaning.doubts.end();
  }

  /// Values of both signs that are no distances, but measurements.
  [[nodiscard]] bool isSignedFog(const GridMeaning& meaning) const {
    const bool unclear =
        std::ranges::find(meaning.doubts, GridDoubt::kClassUnclear) != meaning.doubts.end() && mEvidence.low < 0;
    if (mOptions.gridClass || meaning.gridClass != GridClass::kLevelSet || !unclear) return false;
    constexpr double kNearLowest = 0.5;
    const bool lowAround = !mEvidence.outermost.empty() && medianOf(mEvidence.outermost) < kNearLowest * mEvidence.low;
    return isInteger(mView.type) || lowAround;
  }

  void chooseIso() {
    const VolumeView mask = mOptions.mask.value_or(VolumeView{});
    const ValueHistogram histogram = valueHistogram(mView, kBins, {}, mOptions.mask ? &mask : nullptr);
    mEvidence.low = histogram.lowest;
    mEvidence.high = histogram.highest;
    mEvidence.background = mEvidence.low;
    const std::optional<OtsuThreshold> threshold = otsuThreshold(histogram);
    if (!threshold) return;
    mAsked.iso = threshold->value;
    if (histogram.between > 0) mExtra.push_back(GridDoubt::kIsoGuessed);
  }

  void lookAtAll() {
    const VolumeView mask = mOptions.mask.value_or(VolumeView{});
    const ValueRange range = valueRange(mView, mOptions.mask ? &mask : nullptr);
    mEvidence.low = range.low <= range.high ? range.low : 0;
    mEvidence.high = range.low <= range.high ? range.high : 0;
    lookAtBandEnds();
  }

  /// Slopes and the range of the values of some blocks.
  void lookAtSome() {
    const auto stencil = std::make_unique<DistanceStencil>();
    const std::vector<Coord> blocks = mValues.someBlocks(kSampledBlocks);
    ValueRange range;
    for (const Coord& block : blocks) {
      mValues.readDistances(block, 1, *stencil);
      forEachValue(*stencil, [&](const float* v) {
        mSample.push_back(*v);
        range.add(double{*v});
      });
    }
    if (range.low > range.high) range = {0, 0};
    mEvidence.low = range.low;
    mEvidence.high = range.high;
    SlopeSample slopes(range);
    const Mat3d toWorld = inverse(mMap.jacobian({})).transposed();
    for (const Coord& block : blocks) {
      mValues.readDistances(block, 1, *stencil);
      forEachValue(*stencil, [&](const float* v) { addSlope(v, toWorld, slopes); });
    }
    slopes.finish(mEvidence);
    lookAtBandEnds();
  }

  /// Calls visit(value) for the block's own values in a stencil that are known.
  template <typename Visit>
  static void forEachValue(const DistanceStencil& stencil, const Visit& visit) {
    for (int i = 0; i < kBlockCells; ++i) {
      const float* v = &stencil.value[DistanceStencil::index(i >> 6, i >> 3 & 7, i & 7)];
      if (std::isfinite(*v)) visit(v);
    }
  }

  static void addSlope(const float* v, const Mat3d& toWorld, SlopeSample& slopes) {
    if (!slopes.isInBand(double{*v})) return;
    Vec3d gradient;
    for (int axis = 0; axis < 3; ++axis) {
      const double below = double{v[-DistanceStencil::kStep[axis]]}, above = double{v[DistanceStencil::kStep[axis]]};
      if (!slopes.isInBand(below) || !slopes.isInBand(above)) return;
      gradient[axis] = 0.5 * (above - below);
    }
    slopes.add(length(toWorld * gradient), double{*v});
  }

  /// Values of a band that many points have stand for all beyond, as a grid's background does.
  void lookAtBandEnds() {
    mEvidence.background = 0;
    const auto share = [&](double end) {
      const auto equal = std::ranges::count(mSample, static_cast<float>(end));
      return mSample.empty() ? 0 : static_cast<double>(equal) / static_cast<double>(mSample.size());
    };
    const bool high = mEvidence.high > 0 && share(mEvidence.high) >= kBandEnd;
    const bool low = mEvidence.low < 0 && share(mEvidence.low) >= kBandEnd;
    if (!high && !low) return;
    const bool outsideLow = !mEvidence.outermost.empty() && medianOf(mEvidence.outermost) < 0;
    mEvidence.background = high && (!low || !outsideLow) ? mEvidence.high : mEvidence.low;
  }

  /// Some of the values of each face.
  void lookAtFaces() {
    for (const Axis axis : kAxes)
      for (const std::int64_t at : {std::int64_t{0}, mView.size[axis] - 1}) addFace(axis, at);
    lookAtBandEnds();
  }
  void addFace(Axis axis, std::int64_t at) {
    const Axis u = nextAxis(axis), v = previousAxis(axis);
    const std::int64_t countU = std::min(kFacePoints, mView.size[u]), countV = std::min(kFacePoints, mView.size[v]);
    Coord p{};
    p[axis] = static_cast<std::int32_t>(at);
    for (std::int64_t i = 0; i < countU; ++i)
      for (std::int64_t j = 0; j < countV; ++j) {
        p[u] = static_cast<std::int32_t>(i * mView.size[u] / countU);
        p[v] = static_cast<std::int32_t>(j * mView.size[v] / countV);
        const double value = mValues.sampler().meaning(p);
        if (std::isfinite(value) && (mMask == nullptr || mMask->inside(p))) mEvidence.outermost.push_back(value);
      }
  }

  static constexpr int kBins = 1024;

  const VolumeReader& mValues;
  const VolumeSigns* mMask;
  const LatticeMap& mMap;
  const VolumeView& mView;
  const DenseSourceOptions& mOptions;
  GridMeaningOptions mAsked;
  GridEvidence mEvidence;
  std::vector<float> mSample;
  std::vector<GridDoubt> mExtra;
};

}  // namespace

VolumeMeaning readVolumeMeaning(const VolumeReader& values, const VolumeSigns* mask, const LatticeMap& map,
                                const DenseSourceOptions& options) {
  return MeaningReader(values, mask, map, options).read();
}

}  // namespace pdc::detail
