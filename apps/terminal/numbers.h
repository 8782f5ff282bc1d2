#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace pdc {

/// An option that takes a real number, read strictly: all of the text, decimal, no NaN; `inf` only where `accepts`
/// takes infinity. What is refused is a usage error that names the option, the text and `limit`.
CLI::Option* addReal(CLI::App& command, const std::string& name, std::optional<double>& target,
                     std::function<bool(double)> accepts, const std::string& limit, const std::string& help);

/// Adds an option that takes a whole number in [lo, hi], read and refused as addReal() does.
CLI::Option* addInteger(CLI::App& command, const std::string& name, std::optional<int>& target, int lo, int hi,
                        const std::string& help);

/// The numbers of a list like "0,0.1,inf", read as strictly as by addReal(); empty if any part is no number.
[[nodiscard]] std::vector<double> parseReals(const std::string& text, char separator);

/// The option --threads, the same for all commands.
CLI::Option* addThreads(CLI::App& command, std::optional<int>& target);

}  // namespace pdc
