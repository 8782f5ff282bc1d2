#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "io/volume/volume_files.h"

namespace pdc {

/// What a NIfTI header of a test says, and how it is written.
struct NiftiFile {
  bool second = false, bigEndian = false, pair = false;
  std::vector<std::int64_t> dim{kRampSize[0], kRampSize[1], kRampSize[2]};
  std::int16_t datatype = 4;  // signed, 16 bits
  std::array<double, 4> pixdim{1, 2, 3, 4};
  double slope = 1, intercept = 0, offset = -1;  ///< -1: right behind the header.
  int qformCode = 0, sformCode = 0, units = 2;
  std::array<double, 3> quaternion{0, 0, 0}, shift{0, 0, 0};
  std::array<double, 12> sform{};

  [[nodiscard]] std::string header() const { return second ? header2() : header1(); }

 private:
  template <typename Number>
  void put(std::string& to, std::size_t at, Number number) const {
    const std::string bytes = bytesOf(number, bigEndian);
    std::copy(bytes.begin(), bytes.end(), to.begin() + static_cast<std::ptrdiff_t>(at));
  }
  [[nodiscard]] std::string header1() const {
    std::string h(pair ? 348 : 352, '\0');
    put(h, 0, std::int32_t{348});
    put(h, 40, static_cast<std::int16_t>(dim.size()));
    for (std::size_t i = 0; i < dim.size(); ++i) put(h, 42 + 2 * i, static_cast<std::int16_t>(dim[i]));
    put(h, 70, datatype);
    for (std::size_t i = 0; i < 4; ++i) put(h, 76 + 4 * i, static_cast<float>(pixdim[i]));
    put(h, 108, static_cast<float>(offset >= 0 ? offset : (pair ? 0 : 352)));
    put(h, 112, static_cast<float>(slope));
    put(h, 116, static_cast<float>(intercept));
    h[123] = static_cast<char>(units);
    put(h, 252, static_cast<std::int16_t>(qformCode));
    put(h, 254, static_cast<std::int16_t>(sformCode));
    for (std::size_t i = 0; i < 3; ++i) put(h, 256 + 4 * i, static_cast<float>(quaternion[i]));
    for (std::size_t i = 0; i < 3; ++i) put(h, 268 + 4 * i, static_cast<float>(shift[i]));
    for (std::size_t i = 0; i < 12; ++i) put(h, 280 + 4 * i, static_cast<float>(sform[i]));
    h.replace(344, 4, std::string(pair ? "ni1" : "n+1") + '\0');
    return h;
  }
  [[nodiscard]] std::string header2() const {
    std::string h(pair ? 540 : 544, '\0');
    put(h, 0, std::int32_t{540});
    h.replace(4, 8, std::string(pair ? "ni2" : "n+2") + std::string("\0\r\n\032\n", 5));
    put(h, 12, datatype);
    put(h, 16, static_cast<std::int64_t>(dim.size()));
    for (std::size_t i = 0; i < dim.size(); ++i) put(h, 24 + 8 * i, dim[i]);
    for (std::size_t i = 0; i < 4; ++i) put(h, 104 + 8 * i, pixdim[i]);
    put(h, 168, static_cast<std::int64_t>(offset >= 0 ? offset : (pair ? 0 : 544)));
    put(h, 176, slope);
    put(h, 184, intercept);
    put(h, 344, std::int32_t{qformCode});
    put(h, 348, std::int32_t{sformCode});
    for (std::size_t i = 0; i < 3; ++i) put(h, 352 + 8 * i, quaternion[i]);
    for (std::size_t i = 0; i < 3; ++i) put(h, 376 + 8 * i, shift[i]);
    for (std::size_t i = 0; i < 12; ++i) put(h, 400 + 8 * i, sform[i]);
    put(h, 500, std::int32_t{units});
    return h;
  }
};

}  // namespace pdc
