#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "pdc/error.h"

namespace pdc::detail {

/// `text` with control characters replaced by spaces, for messages about names and texts that come from files.
[[nodiscard]] std::string oneLine(std::string_view text);

/// "what: No space left on device", from a value of errno.
[[nodiscard]] Error systemError(std::string_view what, int errorNumber);

/// "PATH: what", on one line.
[[nodiscard]] Error fileError(const std::filesystem::path& path, std::string_view what);

/// "PATH: what: No space left on device", on one line, from a value of errno.
[[nodiscard]] Error fileError(const std::filesystem::path& path, std::string_view what, int errorNumber);

}  // namespace pdc::detail
