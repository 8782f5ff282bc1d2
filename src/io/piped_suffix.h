#pragma once

#include <string>
#include <string_view>

namespace pdc::detail {

/// The suffix of a file with these bytes, such as ".vdb" or ".nii.gz": of those that are read, told by marks that the
/// formats have. Empty where nothing tells.
[[nodiscard]] std::string suffixOfBytes(std::string_view bytes);

}  // namespace pdc::detail
