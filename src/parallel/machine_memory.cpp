#include "parallel/machine_memory.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <optional>
#include <string>

namespace pdc::detail {
namespace {

/// A line "key: 123 kB" of a file of /proc, in bytes.
std::size_t kibibytesOf(const char* path, const std::string& wanted) {
  std::ifstream file(path);
  for (std::string key; file >> key; file.ignore(std::numeric_limits<std::streamsize>::max(), '\n')) {
    std::size_t kibibytes = 0;
    if (key == wanted && file >> kibibytes) return kibibytes * 1024;
  }
  return 0;
}

/// The number that a file holds; nothing if it holds a word, such as "max".
std::optional<std::size_t> numberIn(const std::string& path) {
  std::ifstream file(path);
  std::size_t number = 0;
  if (file >> number) return number;
  return std::nullopt;
}

/// What the control groups above this program leave of their limits, of version 2.
std::size_t leftInGroups() {
  std::size_t left = std::numeric_limits<std::size_t>::max();
  std::ifstream groups("/proc/self/cgroup");
  std::string line;
  while (std::getline(groups, line)) {
    if (!line.starts_with("0::/")) continue;
    for (std::string group = line.substr(3); !group.empty(); group.resize(group.rfind('/'))) {
      const std::string folder = "/sys/fs/cgroup" + (group == "/" ? "" : group);
      const auto limit = numberIn(folder + "/memory.max"), used = numberIn(folder + "/memory.current");
      if (limit && used) left = std::min(left, *limit - std::min(*limit, *used));
    }
  }
  return left;
}

}  // namespace

std::size_t memoryInUse() { return kibibytesOf("/proc/self/status", "VmRSS:"); }

std::size_t peakMemory() { return kibibytesOf("/proc/self/status", "VmHWM:"); }

std::size_t availableMemory() { return std::min(kibibytesOf("/proc/meminfo", "MemAvailable:"), leftInGroups()); }

std::string memoryFigures() {
  constexpr std::size_t kMega = 1'000'000;
  return fmt::format("{} MB were in use, {} MB are left", peakMemory() / kMega, availableMemory() / kMega);
}

}  // namespace pdc::detail
