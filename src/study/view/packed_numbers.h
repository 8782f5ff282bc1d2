#pragma once

#include <cstdint>
#include <span>

#include "pdc/mesh/buffer.h"

namespace pdc::detail {

/// Numbers as a page holds them, which unpack.js undoes: what each adds to the one before, the sign in the lowest bit;
/// of these all lowest bytes, then all second ones, and so on to the fourth; that as a gzip file. Numbers
/// that change little are small. The bytes do not depend on the number of threads.
[[nodiscard]] Buffer<std::uint8_t> packNumbers(std::span<const std::uint32_t> numbers);

}  // namespace pdc::detail
