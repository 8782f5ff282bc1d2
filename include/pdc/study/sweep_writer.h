#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pdc/render/image.h"
#include "pdc/study/sweep.h"

namespace pdc {

/// What a sweep's files say beside its figures.
struct SweepDescription {
  std::string title;            ///< What was swept, in a few words. UTF-8 without markup, which is escaped.
  std::string command;          ///< The command line that repeats the sweep; escaped too.
  std::vector<Image> pictures;  ///< One per step in the order of the steps, or none.
};

/// A table (RFC 4180, but lines end in "\n"): a line of names, then one per step, the swept value first. Lengths are in
/// voxels, angles in degrees, times in seconds; numbers read back to the same. What is not known is empty, infinity
/// inf.
[[nodiscard]] std::string sweepCsv(const Sweep& sweep);

/// The figures of the table as a JSON object, with the recommended value, the reason and the command. Infinity is the
/// string "inf", what is not known null. The description's pictures are not in it.
[[nodiscard]] std::string sweepJson(const Sweep& sweep, const SweepDescription& description);

/// An HTML page that needs nothing but itself: the pictures with a slider, curves, the table. It adapts to light and
/// dark displays, and to widths from that of a phone. Needs a step, and no or as many pictures as steps.
[[nodiscard]] std::string sweepPage(const Sweep& sweep, const SweepDescription& description);

/// Makes the folder if it is not there; its parent must be. Call it before long work. \throws Error unless it can take
/// the three files.
void makeSweepFolder(const std::filesystem::path& folder);

/// Writes sweep.csv, sweep.json and index.html, each of which appears only when it is complete; older ones are
/// replaced. \throws Error if one cannot be written, which leaves those before it; std::invalid_argument if there are
/// pictures, but not one per step.
void writeSweep(const Sweep& sweep, const SweepDescription& description, const std::filesystem::path& folder);

}  // namespace pdc
