#pragma once

#include <cstdint>
#include <string>

namespace pdc::detail {

class ByteReader;

/// How the values of a tree are stored.
struct VdbTreeFormat {
  std::string type;               ///< The type of the tree, such as "Tree_float_5_4_3".
  std::uint32_t compression = 0;  ///< Bits of openvdb::io::COMPRESS_*.
  bool half = false;              ///< Whether real values are stored with 16 bits.
};

/// True for the trees that can be checked and contoured: those of ContourableGrids.
[[nodiscard]] bool isContourableVdbTree(const std::string& type);

/// True for the trees that can be checked: those of SampledGrids.
[[nodiscard]] bool isSampledVdbTree(const std::string& type);

/// Walks through the tree at the reader's position as OpenVDB's reader would, and leaves the position after it.
///
/// Passing means that OpenVDB's reader will find every byte it asks for, will not write past a buffer (it reads as many
/// bytes as the file says into buffers of the size it expects, and only then compares), and will meet no error inside
/// the topology (from where it would free children that were not made yet). Values themselves are not judged. Memory
/// does not grow with what the file announces. \throws Error "damaged at byte N: what", or that the file ends early.
void checkVdbTree(ByteReader& bytes, const VdbTreeFormat& format);

}  // namespace pdc::detail
