#pragma once

#include <cstdint>
#include <random>
#include <string>

namespace pdc {

/// A damaged copy: cut off somewhere, or with one to four bytes changed by a bit or altogether. Half of the changes hit
/// the first kilobyte, where headers are. The same for the same seed.
inline std::string mutate(std::string bytes, std::uint32_t seed) {
  std::mt19937 random(seed);
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random()) % n; };
  if (below(4) == 0) {
    bytes.resize(below(bytes.size()));
    return bytes;
  }
  constexpr std::size_t kHead = 1024;
  for (std::size_t n = 1 + below(4); n > 0; --n) {
    const bool head = below(2) == 0 && bytes.size() > kHead;
    char& c = bytes[below(head ? kHead : bytes.size())];
    c = static_cast<char>(below(2) == 0 ? static_cast<std::size_t>(c) ^ (std::size_t{1} << below(8)) : below(256));
  }
  return bytes;
}

}  // namespace pdc
