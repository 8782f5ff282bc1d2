#include "io/vdb/grid_warnings.h"

#include <fmt/format.h>

#include <string_view>

namespace pdc::detail {
namespace {

class Lines {
 public:
  Lines(const GridMeaning& meaning, OptionStyle style) : mMeaning(meaning), mStyle(style) {}

  [[nodiscard]] std::string of(GridDoubt doubt) const {
    switch (doubt) {
      case GridDoubt::kPositiveInside:
        return fmt::format(
            "the level set's background and all its outermost values are negative, so it is taken as positive "
            "inside, as with {}; {} if everything around is solid",
            option("inside", "high"), option("inside", "low"));
      case GridDoubt::kOutermostInside:
        return fmt::format(
            "all outermost values are inside but what is around them is not, so there is a false sheet where the "
            "values end; {} if values are positive inside{}",
            option("inside", "high"), closing());
      case GridDoubt::kSideUnclear:
        return fmt::format(
            "neither the background nor the outermost values say which side is outside; {} values are taken as "
            "inside, {} sets it",
            nameOf(mMeaning.inside), option("inside", "low|high"));
      case GridDoubt::kClassUnclear:
        return fmt::format(
            "the grid has no class, and its values, {:.6g} to {:.6g}, are no distances with a sign; it is taken as a "
            "{} at iso {:.6g}, {} and {} set it",
            mMeaning.lowest, mMeaning.highest, nameOf(mMeaning.gridClass), mMeaning.iso,
            option("class", "level-set|fog"), option("iso", "V"));
      case GridDoubt::kIsoGuessed:
        return fmt::format(
            "the grid has no class, and its values, {:.6g} to {:.6g}, do not say where the surface is; it is taken "
            "as a fog volume at iso {:.6g}, {} sets it",
            mMeaning.lowest, mMeaning.highest, mMeaning.iso, option("iso", "V"));
      case GridDoubt::kUnsigned:
        return fmt::format(
            "the values are distances without a sign, so nothing is inside; {} takes the surface at distance V",
            option("iso", "V"));
      case GridDoubt::kLooksLikeFog:
        return fmt::format("the grid's class is level set, but no value is negative; {} if they are densities",
                           option("class", "fog"));
      case GridDoubt::kLooksLikeLevelSet:
        return fmt::format("the grid's class is fog volume, but the values are signed distances; {} takes them as such",
                           option("class", "level-set"));
      case GridDoubt::kNotFloodFilled:
        return fmt::format("the values end inside beside inactive ones that are outside, so there is a false sheet{}",
                           closing());
      case GridDoubt::kCutAtEnd:
        return fmt::format("the solid reaches where the values end and is closed there{}", opening());
      case GridDoubt::kIsoNearBandEnd:
        return fmt::format(
            "iso {:.6g} is less than a voxel from where the values end, so the surface may be half a voxel off; take "
            "an {} nearer to 0 or a wider band",
            mMeaning.iso, option("iso", "V"));
      case GridDoubt::kNarrowBand:
        return fmt::format(
            "the values end {:.2g} voxels from the surface, where normals need 2; rebuild the level set with a half "
            "width of 3",
            mMeaning.halfWidth);
    }
    return "";
  }

 private:
  [[nodiscard]] std::string option(std::string_view name, std::string_view value) const {
    return mStyle == OptionStyle::kProgram ? fmt::format("--{} {}", name, value) : fmt::format("{}: {}", name, value);
  }
  // What closes and opens surfaces goes with grids that are contoured by themselves only.
  [[nodiscard]] const char* closing() const {
    return mStyle == OptionStyle::kProgram ? "; --flood-fill closes a solid, --open ends a scan's surface there" : "";
  }
  [[nodiscard]] const char* opening() const { return mStyle == OptionStyle::kProgram ? "; --open leaves it open" : ""; }

  const GridMeaning& mMeaning;
  OptionStyle mStyle;
};

}  // namespace

std::vector<std::string> gridWarnings(const GridMeaning& meaning, OptionStyle style) {
  std::vector<std::string> lines;
  for (const GridDoubt doubt : meaning.doubts) lines.push_back(Lines(meaning, style).of(doubt));
  return lines;
}

}  // namespace pdc::detail
