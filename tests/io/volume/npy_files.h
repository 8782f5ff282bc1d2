#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "io/volume/volume_files.h"

namespace pdc {

/// An array file. \param version of the format, whose header's length has two or four bytes.
inline std::string npy(const std::string& dictionary, const std::string& values, int version = 1) {
  const std::string header = dictionary + "\n";
  std::string file = "\x93NUMPY";
  file += static_cast<char>(version);
  file += '\0';
  file += version == 1 ? bytesOf(static_cast<std::uint16_t>(header.size()))
                       : bytesOf(static_cast<std::uint32_t>(header.size()));
  return file + header + values;
}

/// A zip file of these files, with the sizes of the last in 64 bits where asked.
inline std::string zip(const std::vector<std::pair<std::string, std::string>>& files, bool compress,
                       bool wide = false) {
  std::string bytes, list;
  for (const auto& [name, content] : files) {
    const std::string packed = compress ? deflated(content, -15) : content;
    const std::string sizes =
        bytesOf(static_cast<std::uint32_t>(packed.size())) + bytesOf(static_cast<std::uint32_t>(content.size()));
    const std::string extra = wide ? bytesOf(std::uint16_t{1}) + bytesOf(std::uint16_t{16}) +
                                         bytesOf(std::uint64_t{content.size()}) + bytesOf(std::uint64_t{packed.size()})
                                   : "";
    const std::string common =
        bytesOf(std::uint16_t{45}) + bytesOf(std::uint16_t{0}) + bytesOf(static_cast<std::uint16_t>(compress ? 8 : 0)) +
        bytesOf(std::uint32_t{0}) + bytesOf(std::uint32_t{0}) + (wide ? std::string(8, '\xff') : sizes) +
        bytesOf(static_cast<std::uint16_t>(name.size())) + bytesOf(static_cast<std::uint16_t>(extra.size()));
    list += "PK\x01\x02" + bytesOf(std::uint16_t{45}) + common + std::string(10, '\0') +
            bytesOf(static_cast<std::uint32_t>(bytes.size())) + name + extra;
    bytes += "PK\x03\x04" + common + name + extra + packed;
  }
  const auto count = static_cast<std::uint16_t>(files.size());
  return bytes + list + "PK\x05\x06" + std::string(4, '\0') + bytesOf(count) + bytesOf(count) +
         bytesOf(static_cast<std::uint32_t>(list.size())) + bytesOf(static_cast<std::uint32_t>(bytes.size())) +
         std::string(2, '\0');
}

}  // namespace pdc
