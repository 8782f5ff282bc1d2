#include "io/vdb/grid_warnings.h"

#include <gtest/gtest.h>

#include <map>

namespace pdc::detail {
namespace {

std::string lineOf(GridDoubt doubt, OptionStyle style = OptionStyle::kProgram) {
  const GridMeaning meaning{.iso = 2.9, .halfWidth = 1.5, .lowest = -1, .highest = 7, .doubts = {doubt}};
  const std::vector<std::string> lines = gridWarnings(meaning, style);
  EXPECT_EQ(lines.size(), 1u);
  return lines.empty() ? "" : lines[0];
}

bool mentions(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(GridWarnings, ALineForEachDoubtNamesItsRemedy) {
  const std::map<GridDoubt, std::string> remedies{{GridDoubt::kPositiveInside, "--inside high"},
                                                  {GridDoubt::kOutermostInside, "--inside high"},
                                                  {GridDoubt::kSideUnclear, "--inside low|high"},
                                                  {GridDoubt::kClassUnclear, "--class level-set|fog"},
                                                  {GridDoubt::kIsoGuessed, "--iso V"},
                                                  {GridDoubt::kUnsigned, "--iso V"},
                                                  {GridDoubt::kLooksLikeFog, "--class fog"},
                                                  {GridDoubt::kLooksLikeLevelSet, "--class level-set"},
                                                  {GridDoubt::kNotFloodFilled, "--flood-fill"},
                                                  {GridDoubt::kCutAtEnd, "--open"},
                                                  {GridDoubt::kIsoNearBandEnd, "--iso V"},
                                                  {GridDoubt::kNarrowBand, "half width of 3"}};
  for (const auto& [doubt, remedy] : remedies) {
    const std::string line = lineOf(doubt);
    EXPECT_TRUE(mentions(line, remedy)) << line;
    EXPECT_FALSE(mentions(line, "\n")) << line;
  }
  EXPECT_TRUE(mentions(lineOf(GridDoubt::kIsoNearBandEnd), "iso 2.9 is less than a voxel"));
  EXPECT_TRUE(mentions(lineOf(GridDoubt::kNarrowBand), "end 1.5 voxels from the surface"));
  EXPECT_TRUE(mentions(lineOf(GridDoubt::kIsoGuessed), "-1 to 7"));
  EXPECT_TRUE(gridWarnings({}, OptionStyle::kProgram).empty());
}

TEST(GridWarnings, ScenesHaveKeysInsteadOfOptions) {
  EXPECT_TRUE(mentions(lineOf(GridDoubt::kPositiveInside, OptionStyle::kScene), "inside: high"));
  for (const GridDoubt doubt :
       {GridDoubt::kPositiveInside, GridDoubt::kNotFloodFilled, GridDoubt::kCutAtEnd, GridDoubt::kUnsigned})
    EXPECT_FALSE(mentions(lineOf(doubt, OptionStyle::kScene), "--"));
}

}  // namespace
}  // namespace pdc::detail
