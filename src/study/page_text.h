#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace pdc::detail {

/// Text as it may stand in HTML, in attributes too.
[[nodiscard]] std::string htmlText(std::string_view text);
/// Text as a JSON string, quotes included. Bytes that are not ASCII are taken as they are.
[[nodiscard]] std::string jsonText(std::string_view text);
/// Base 64, as data: addresses want it (RFC 4648).
[[nodiscard]] std::string base64(std::span<const std::uint8_t> bytes);

}  // namespace pdc::detail
