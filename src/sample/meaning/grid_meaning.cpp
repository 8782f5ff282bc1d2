#include "sample/meaning/grid_meaning.h"

#include <algorithm>
#include <cmath>

namespace pdc::detail {
namespace {

/// Isovalue of fog volumes where none is asked for, as in Houdini's converter.
constexpr double kDensityIso = 0.5;
/// Median deviation of slopes from their median, relative to it, up to which values are distances in some unit: exact
/// ones have at most 0.01, with noise of a tenth of a voxel 0.07; smooth random functions have 0.3.
constexpr double kEvenSlopes = 0.2;
/// Deviation of the slope at zero from that elsewhere up to which they are the same. Quadrics, whose slopes vary little
/// over most of a box, have 0.5 and more.
constexpr double kSameSlope = 0.3;
/// Relative deviation up to which a slope counts as that of a distance in voxels or in world units.
constexpr double kUnitSlope = 0.15;
/// Negative values of less than this, relative to the largest value, are the noise or the ringing of a density.
constexpr double kNoiseOfDensity = 0.05;
/// Where the smaller of the two signs reaches at least this far, relative to the other, zero is the surface.
constexpr double kBalanced = 0.2;
/// Densities beyond this are in units in which 0.5 means nothing.
constexpr double kLargestDensity = 10;
/// Share of values beyond the background from which it is no end of a band.
constexpr double kNoBand = 0.05;
/// Fewest ends of activity that say something.
constexpr std::size_t kLeastEnds = 16;
/// A band that ends less than this far from the surface, in voxels, has no central differences beside it.
constexpr double kLeastHalfWidth = 1.99;

double medianOf(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

class Decision {
 public:
  Decision(const GridEvidence& evidence, const std::optional<GridClass>& fileClass, const GridMeaningOptions& options)
      : mEvidence(evidence), mFileClass(fileClass), mOptions(options) {}

  Reading make() {
    mMeaning.lowest = mEvidence.low;
    mMeaning.highest = mEvidence.high;
    mMeaning.slope = mEvidence.slope;
    chooseClass();
    mMeaning.iso = mOptions.iso.value_or(isLevelSet() ? 0.0 : kDensityIso);
    chooseInside();
    Reading reading;
    reading.background = outsideBackground();
    reading.array = isArray();
    reading.clamp = clamp(reading.background);
    lookAtBand(reading.clamp);
    lookAtEnds(reading.background);
    std::sort(mMeaning.doubts.begin(), mMeaning.doubts.end());
    reading.meaning = mMeaning;
    return reading;
  }

 private:
  [[nodiscard]] bool isLevelSet() const { return mMeaning.gridClass == GridClass::kLevelSet; }
  void doubt(GridDoubt what) { mMeaning.doubts.push_back(what); }
  void choose(GridClass gridClass, DecidedBy by) {
    mMeaning.gridClass = gridClass;
    mMeaning.classBy = by;
  }

  /// Distances in whatever unit, with a sign or without.
  [[nodiscard]] bool hasEvenSlopes() const { return mEvidence.slopeSpread <= kEvenSlopes; }
  [[nodiscard]] bool areDistances() const {
    const double atZero = mEvidence.slopeAtZero;
    return hasEvenSlopes() && (atZero == 0 || std::abs(atZero / mEvidence.slope - 1) <= kSameSlope);
  }
  [[nodiscard]] double slopePerVoxel() const { return mEvidence.slope * mEvidence.voxelSize; }
  [[nodiscard]] bool hasUnitSlopes() const {
    const auto unit = [](double slope) { return std::abs(slope - 1) <= kUnitSlope; };
    return hasEvenSlopes() && (unit(mEvidence.slope) || unit(slopePerVoxel()));
  }
  [[nodiscard]] bool hasBothSigns() const { return mEvidence.low < 0 && mEvidence.high > 0; }
  /// Distances whose sign was lost: they come down to zero away from the outermost values.
  [[nodiscard]] bool isUnsigned() const {
    return mEvidence.low >= 0 && hasUnitSlopes() && mEvidence.low < slopePerVoxel() && !mEvidence.outermost.empty() &&
           medianOf(mEvidence.outermost) > 1.5 * slopePerVoxel();
  }

  void chooseClass() {
    if (mOptions.gridClass) return choose(*mOptions.gridClass, DecidedBy::kCaller);
    if (mFileClass) {
      choose(*mFileClass, DecidedBy::kFile);
      return doubtFileClass();
    }
    if (mEvidence.mask) return choose(GridClass::kFogVolume, DecidedBy::kType);
    chooseClassByValues();
  }

  void doubtFileClass() {
    if (mEvidence.mask || mEvidence.low == mEvidence.high) return;
    const double reach = std::min(-mEvidence.low, mEvidence.high);
    if (isLevelSet() && mEvidence.low >= 0 && !isUnsigned()) doubt(GridDoubt::kLooksLikeFog);
    if (isLevelSet() && isUnsigned()) doubtUnsigned();
    if (!isLevelSet() && areDistances() && reach > slopePerVoxel()) doubt(GridDoubt::kLooksLikeLevelSet);
  }

  /// Around a surface without inside and outside there is one at any distance.
  void doubtUnsigned() {
    if (!(mOptions.iso > 0)) doubt(GridDoubt::kUnsigned);
  }

  void chooseClassByValues() {
    const double low = mEvidence.low, high = mEvidence.high;
    // Nothing but background.
    if (low == high) return choose(low > 0 ? GridClass::kLevelSet : GridClass::kFogVolume, DecidedBy::kValues);
    const bool distances = areDistances() && (hasBothSigns() || high <= 0);
    if (distances || isUnsigned()) {
      choose(GridClass::kLevelSet, DecidedBy::kValues);
      if (high <= 0) doubt(GridDoubt::kClassUnclear);
      if (!distances) doubtUnsigned();
    } else if (hasBothSigns()) {
      chooseClassOfSigned();
    } else {
      choose(GridClass::kFogVolume, DecidedBy::kValues);
      if (!mOptions.iso && (high > kLargestDensity || low > kDensityIso || high <= 0)) doubt(GridDoubt::kIsoGuessed);
    }
  }

  /// The class of values of both signs that are no distances.
  void chooseClassOfSigned() {
    const double low = mEvidence.low, high = mEvidence.high;
    const double outer = mEvidence.outermost.empty() ? mEvidence.background : medianOf(mEvidence.outermost);
    const bool balanced = std::min(-low, high) >= kBalanced * std::max(-low, high);
    const bool density = -low <= kNoiseOfDensity * high && std::abs(outer) <= kNoiseOfDensity * high;
    choose(balanced || outer > kBalanced * high ? GridClass::kLevelSet : GridClass::kFogVolume, DecidedBy::kValues);
    if (!density) return doubt(GridDoubt::kClassUnclear);
    if (!mOptions.iso && high > kLargestDensity) doubt(GridDoubt::kIsoGuessed);
  }

  /// True for values that are inside as long as nothing speaks against the usual side.
  [[nodiscard]] bool isUsuallyInside(double value) const { return isLevelSet() ? value < 0 : value > mMeaning.iso; }

  void chooseInside() {
    const InsideValues usual = isLevelSet() ? InsideValues::kLow : InsideValues::kHigh;
    const InsideValues other = isLevelSet() ? InsideValues::kHigh : InsideValues::kLow;
    mMeaning.inside = mOptions.inside.value_or(usual);
    mMeaning.insideBy = mOptions.inside ? DecidedBy::kCaller : mMeaning.classBy;
    const bool fog = mFileClass == GridClass::kFogVolume || mOptions.gridClass == GridClass::kFogVolume;
    if (mOptions.inside || mEvidence.mask || fog) return;

    const double background = mEvidence.background;
    const bool backgroundInside = isUsuallyInside(background);
    const bool backgroundOutside = !backgroundInside && !(isLevelSet() && background == 0);
    const std::vector<double>& outermost = mEvidence.outermost;
    const auto outside =
        std::count_if(outermost.begin(), outermost.end(), [&](double v) { return !isUsuallyInside(v); });
    const auto inside = static_cast<std::ptrdiff_t>(outermost.size()) - outside;
    const bool allInside = outside == 0 && (inside > 0 || backgroundInside);
    const bool anyOther = isLevelSet() || mEvidence.low < mMeaning.iso;
    if (!backgroundOutside && allInside && anyOther) {
      mMeaning.inside = other;
      mMeaning.insideBy = DecidedBy::kValues;
      if (isLevelSet() && mMeaning.classBy != DecidedBy::kValues) doubt(GridDoubt::kPositiveInside);
    } else if (backgroundOutside && allInside && isLevelSet()) {
      doubt(GridDoubt::kOutermostInside);
    } else if (!backgroundOutside && anyOther && inside > outside) {
      doubt(GridDoubt::kSideUnclear);
    }
  }

  [[nodiscard]] bool isInside(double value) const {
    return mMeaning.inside == InsideValues::kLow ? value < mMeaning.iso : value > mMeaning.iso;
  }

  [[nodiscard]] std::optional<double> outsideBackground() const {
    const double background = mEvidence.background;
    if (mEvidence.mask || !isInside(background)) return std::nullopt;
    const std::vector<double>& outermost = mEvidence.outermost;
    const auto inside = std::count_if(outermost.begin(), outermost.end(), [&](double v) { return isInside(v); });
    const bool mostOutside = 2 * inside < static_cast<std::ptrdiff_t>(outermost.size());
    if (!mostOutside && !(isLevelSet() && background == 0)) return std::nullopt;
    const double side = mMeaning.inside == InsideValues::kLow ? 1 : -1;
    if (!isLevelSet()) return side > 0 ? mEvidence.high : mEvidence.low;
    // Farther from zero than all values, as it is taken for the end of a band.
    return side * 2 * std::max({std::abs(mEvidence.low), std::abs(mEvidence.high), std::abs(mMeaning.iso)});
  }

  [[nodiscard]] double clamp(const std::optional<double>& newBackground) const {
    constexpr double kNone = std::numeric_limits<double>::infinity();
    if (!isLevelSet()) return kNone;
    if (newBackground) return std::abs(*newBackground);
    return mEvidence.background != 0 && !isArray() ? std::abs(mEvidence.background) : kNone;
  }

  [[nodiscard]] bool isArray() const { return mEvidence.beyondBackground > kNoBand; }

  void lookAtBand(double clamp) {
    const bool ends = clamp == std::abs(mEvidence.background);
    if (!isLevelSet() || !ends || !areDistances() || !hasBothSigns()) return;
    mMeaning.halfWidth = clamp / slopePerVoxel();
    const double left = (clamp - std::abs(mMeaning.iso)) / slopePerVoxel();
    if (mMeaning.halfWidth < kLeastHalfWidth) {
      doubt(GridDoubt::kNarrowBand);
    } else if (left > 0 && left < 1) {
      doubt(GridDoubt::kIsoNearBandEnd);
    }
  }

  /// Inside, the values beyond the band must be inside too.
  void lookAtEnds(const std::optional<double>& newBackground) {
    if (!isLevelSet() || mOptions.floodFill) return;
    const bool high = mMeaning.inside == InsideValues::kHigh;
    // With the background all inactive values change their sign.
    const bool turned = newBackground && !isArray() && *newBackground * mEvidence.background < 0;
    const std::size_t right = mEvidence.ends[high][high != turned], wrong = mEvidence.ends[high][high == turned];
    const bool told = std::any_of(mMeaning.doubts.begin(), mMeaning.doubts.end(), [](GridDoubt d) {
      return d == GridDoubt::kOutermostInside || d == GridDoubt::kSideUnclear;
    });
    if (told) return;
    if (wrong > right && wrong >= kLeastEnds) return doubt(GridDoubt::kNotFloodFilled);
    const std::vector<double>& outermost = mEvidence.outermost;
    const bool closed = newBackground || !isInside(mEvidence.background);
    if (closed && std::any_of(outermost.begin(), outermost.end(), [&](double v) {
          // Beyond zero the isovalue may lie where the band ends.
          return isInside(v) && (high ? v > 0 : v < 0);
        }))
      doubt(GridDoubt::kCutAtEnd);
  }

  const GridEvidence& mEvidence;
  const std::optional<GridClass>& mFileClass;
  const GridMeaningOptions& mOptions;
  GridMeaning mMeaning;
};

}  // namespace

Reading decideMeaning(const GridEvidence& evidence, const std::optional<GridClass>& fileClass,
                      const GridMeaningOptions& options) {
  return Decision(evidence, fileClass, options).make();
}

}  // namespace pdc::detail
