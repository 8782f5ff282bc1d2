#pragma once

#include <string_view>

namespace pdc::detail {

// The files of this folder that a page is made of, as they are.

extern const std::string_view kViewerBody, kViewerStyle;
/// All scripts, in the order in which they need each other.
extern const std::string_view kViewerScript;

}  // namespace pdc::detail
