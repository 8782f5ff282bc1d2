#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pdc/render/image.h"
#include "pdc/study/sweep.h"

namespace pdc {

/// What a sweep's files say beside its figures.
struct SweepDescription {
  std::string title;            ///< Of what was swept, in a few words.
  std::string command;          ///< The command line that repeats it.
  std::vector<Image> pictures;  ///< One per step, or none.
};

/// A table: a line of names, then one per step. Lengths in voxels, angles in degrees; what is not known is empty.
[[nodiscard]] std::string sweepCsv(const Sweep& sweep);

/// The same with the recommendation and the command; infinity is "inf", what is not known null.
[[nodiscard]] std::string sweepJson(const Sweep& sweep, const SweepDescription& description);

/// A page that needs nothing but itself, for a browser: the pictures with a slider, curves, the table. For light and
/// dark displays, from the width of a phone.
[[nodiscard]] std::string sweepPage(const Sweep& sweep, const SweepDescription& description);

/// Throws Error unless `folder` can take the files; makes the folder (and no other) if it is not there.
void makeSweepFolder(const std::filesystem::path& folder);

/// Writes sweep.csv, sweep.json and index.html, each of which appears only when it is complete. \throws Error;
/// std::invalid_argument if there are pictures, but not one per step.
void writeSweep(const Sweep& sweep, const SweepDescription& description, const std::filesystem::path& folder);

}  // namespace pdc
