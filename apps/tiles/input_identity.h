#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

namespace pdc {

/// What tells an input from another one, or from what it was: of a file its size, when it was changed, and the hash of
/// its bytes; of a folder the names, sizes and times of the files in it. Files that it names, as scenes do, do not
/// count. \throws Error if it cannot be read.
[[nodiscard]] nlohmann::ordered_json inputIdentity(const std::filesystem::path& input);

/// \throws Error if an input is not what it was. A file of the same size and time is taken for the same.
void checkIdentity(const std::filesystem::path& input, const nlohmann::ordered_json& identity);

}  // namespace pdc
