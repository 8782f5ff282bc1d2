#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <string>

namespace pdc {

/// A line on standard error.
inline void printWarning(const std::string& message) {
  std::fputs(fmt::format("pdc: warning: {}\n", message).c_str(), stderr);
}

}  // namespace pdc
