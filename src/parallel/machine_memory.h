#pragma once

#include <cstddef>
#include <string>

/// What the system says of memory, in bytes. Linux's /proc and control groups; each is 0 where it is not said.
namespace pdc::detail {

/// What this program has in use.
[[nodiscard]] std::size_t memoryInUse();
/// The most that this program has had in use. getrusage is of no use here: its figure starts at that of the program
/// that started this one.
[[nodiscard]] std::size_t peakMemory();
/// What it may still take before the machine, or the control group it runs in, has no more.
[[nodiscard]] std::size_t availableMemory();

/// "4096 MB were in use, 12 MB are left", for errors.
[[nodiscard]] std::string memoryFigures();

}  // namespace pdc::detail
