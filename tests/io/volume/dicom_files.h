#pragma once

#include <cstdint>
#include <string>

#include "io/volume/volume_files.h"

namespace pdc {

/// A file of explicit little-endian DICOM; elements are added in the order of their tags.
class DicomFile {
 public:
  void text(int group, int element, const char* type, std::string value) {
    if (value.size() % 2 != 0) value += ' ';
    tag(group, element, type);
    mBytes += bytesOf(static_cast<std::uint16_t>(value.size())) + value;
  }
  void number(int group, int element, int value) {
    tag(group, element, "US");
    mBytes += bytesOf(std::uint16_t{2}) + bytesOf(static_cast<std::uint16_t>(value));
  }
  void pixels(const std::string& values) {
    tag(0x7fe0, 0x0010, "OW");
    mBytes += bytesOf(std::uint16_t{0}) + bytesOf(static_cast<std::uint32_t>(values.size())) + values;
  }
  [[nodiscard]] std::string bytes() const {
    DicomFile meta;
    meta.text(2, 0x10, "UI", std::string("1.2.840.10008.1.2.1\0", 20));
    DicomFile length;
    length.tag(2, 0, "UL");
    length.mBytes += bytesOf(std::uint16_t{4}) + bytesOf(static_cast<std::uint32_t>(meta.mBytes.size()));
    return std::string(128, '\0') + "DICM" + length.mBytes + meta.mBytes + mBytes;
  }

 private:
  void tag(int group, int element, const char* type) {
    mBytes += bytesOf(static_cast<std::uint16_t>(group)) + bytesOf(static_cast<std::uint16_t>(element)) + type;
  }

  std::string mBytes;
};

}  // namespace pdc
