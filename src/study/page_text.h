#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace pdc::detail {

/// Escapes text so that it may stand in HTML, in attributes too.
[[nodiscard]] std::string htmlText(std::string_view text);
/// Makes text a JSON string, quotes included. Bytes that are not ASCII stay, so UTF-8 in gives UTF-8 out.
[[nodiscard]] std::string jsonText(std::string_view text);
/// Encodes bytes in base 64 with padding (RFC 4648), as addresses that begin with "data:" want it.
[[nodiscard]] std::string base64(std::span<const std::uint8_t> bytes);

}  // namespace pdc::detail
