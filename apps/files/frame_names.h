#pragma once

#include <string>
#include <vector>

namespace pdc {

/// The numbers of a sequence's frames, ascending.
struct FrameRange {
  int first = 0, last = 0, step = 1;

  [[nodiscard]] std::vector<int> numbers() const;
};

/// Reads "A-B" or "A-B:STEP", or "A" alone. \throws CLI::ValidationError for anything else, and for more than a million
/// frames.
[[nodiscard]] FrameRange parseFrames(const std::string& text);

/// A file's name with a place for the frame's number: "%d", or "%0Nd" for N digits at least; "%%" is a percent sign.
class FrameNames {
 public:
  /// \param argument what errors call it. \throws CLI::ValidationError for a pattern without just one such place.
  FrameNames(const std::string& pattern, const char* argument);

  [[nodiscard]] std::string of(int frame) const;

 private:
  std::string mBefore, mAfter;
  int mDigits = 1;
};

}  // namespace pdc
