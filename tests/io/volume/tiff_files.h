#pragma once

#include <cstdint>
#include <string>

#include "io/volume/volume_files.h"

namespace pdc {

/// A TIFF file of pages of unsigned values, one strip each.
class TiffPages {
 public:
  /// \param packed whether the values that are added are deflated.
  TiffPages(bool bigEndian, int bits, bool packed = false) : mBigEndian(bigEndian), mBits(bits), mPacked(packed) {
    mBytes = bigEndian ? "MM" : "II";
    mBytes += number(std::uint16_t{42}) + number(std::uint32_t{8});
  }
  /// \param resolution pixels per unit; 0 for none.
  void add(std::int64_t width, std::int64_t height, const std::string& values, std::string description = "",
           int resolution = 0) {
    const auto begin = static_cast<std::uint32_t>(mBytes.size());
    if (begin > 8) mBytes.replace(mNext, 4, number(begin));
    const std::uint16_t entries = static_cast<std::uint16_t>(8 + (description.empty() ? 0 : 1) + (resolution ? 2 : 0));
    const std::uint32_t after = begin + 2 + 12U * entries + 4;
    if (!description.empty()) description += std::string(4 - description.size() % 4, '\0');
    const auto text = static_cast<std::uint32_t>(description.size()), rational = resolution ? 8U : 0U;
    mBytes += number(entries);
    entry(256, 4, 1, static_cast<std::uint32_t>(width));
    entry(257, 4, 1, static_cast<std::uint32_t>(height));
    entry(258, 3, 1, static_cast<std::uint32_t>(mBits));
    entry(259, 3, 1, mPacked ? 8 : 1);
    entry(262, 3, 1, 1);
    if (!description.empty()) entry(270, 2, text, after);
    entry(273, 4, 1, after + text + rational);
    entry(278, 4, 1, static_cast<std::uint32_t>(height));
    entry(279, 4, 1, static_cast<std::uint32_t>(values.size()));
    if (resolution) entry(282, 5, 1, after + text);
    if (resolution) entry(283, 5, 1, after + text);
    mNext = mBytes.size();
    mBytes += number(std::uint32_t{0}) + description;
    if (resolution) mBytes += number(static_cast<std::uint32_t>(resolution)) + number(std::uint32_t{1});
    mBytes += values;
  }
  [[nodiscard]] const std::string& bytes() const { return mBytes; }

 private:
  template <typename Number>
  [[nodiscard]] std::string number(Number n) const {
    return bytesOf(n, mBigEndian);
  }
  void entry(int tag, int type, std::uint32_t count, std::uint32_t value) {
    mBytes += number(static_cast<std::uint16_t>(tag)) + number(static_cast<std::uint16_t>(type)) + number(count);
    mBytes += type == 3 ? number(static_cast<std::uint16_t>(value)) + std::string(2, '\0') : number(value);
  }

  bool mBigEndian;
  int mBits;
  bool mPacked;
  std::string mBytes;
  std::size_t mNext = 0;
};

}  // namespace pdc
