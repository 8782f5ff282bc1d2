#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace pdc {

/// Prints an object as aligned text, one fact a line; an object in it becomes a block below its label, a list of
/// objects a block per object.
void printFacts(const nlohmann::ordered_json& facts);

/// How a fact is called in text: its key, in words.
[[nodiscard]] std::string factLabel(std::string key);

}  // namespace pdc
