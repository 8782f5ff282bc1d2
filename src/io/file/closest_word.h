#pragma once

#include <span>
#include <string>
#include <string_view>

namespace pdc::detail {

/// The known word that was meant by a mistyped one: that of the fewest letters put in, left out, changed or exchanged
/// with their neighbours (Damerau 1964), if they are few for its length; of several the first. Capitals count as small
/// letters. Empty if there is none.
[[nodiscard]] std::string closestWord(std::string_view word, std::span<const std::string> known);

/// " (did you mean 'closest'?)", or nothing.
[[nodiscard]] std::string didYouMean(std::string_view word, std::span<const std::string> known);

}  // namespace pdc::detail
