#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <vector>

#include "terminal/shown_path.h"

namespace pdc {

/// A line on standard error.
inline void printWarning(const std::string& message) {
  std::fputs(fmt::format("pdc: warning: {}\n", shownText(message)).c_str(), stderr);
}

/// Puts warnings on standard error, unless `quiet`, and adds them to those of a report.
inline void noteWarnings(const std::vector<std::string>& warnings, bool quiet, std::vector<std::string>& reported) {
  for (const std::string& warning : warnings) {
    reported.push_back(warning);
    if (!quiet) printWarning(warning);
  }
}

}  // namespace pdc
