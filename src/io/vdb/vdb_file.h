#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "io/file/byte_reader.h"

namespace pdc::detail {

/// A grid as a file's table of contents names it.
struct VdbEntry {
  std::string uniqueName;            ///< Ends in "\x1e0", "\x1e1", ... where grids share a name or have none.
  std::string type;                  ///< The type of the tree, such as "Tree_float_5_4_3".
  std::string parent;                ///< Unique name of the grid whose tree this one shares; mostly empty.
  bool half = false;                 ///< Whether real values are stored with 16 bits.
  std::uint64_t begin = 0, end = 0;  ///< The grid's bytes in the file.

  /// "name" or "name[1]"; "[0]" for a grid without a name.
  [[nodiscard]] std::string shownName() const;
};

/// A named value, as the bytes of its type.
struct VdbMetadata {
  std::string name, type, value;
};

/// What stands before a grid's tree.
struct VdbGridHead {
  std::uint32_t compression = 0;  ///< Bits of openvdb::io::COMPRESS_*.
  bool half = false;              ///< Whether real values are stored with 16 bits.
  std::vector<VdbMetadata> metadata;
  std::string transform;   ///< Bytes for openvdb::math::Transform::read.
  std::uint64_t tree = 0;  ///< The tree's position in the file.
};

/// The parts of a .vdb file around the trees, read without OpenVDB, whose reader takes lengths and counts as they come:
/// it allocates what they say before looking whether it is there, loops over them at the end of the file, writes
/// metadata and voxel data past the end of their buffers, and refuses a whole file for one grid of a type that it does
/// not know.
class VdbFile {
 public:
  /// Reads the table of contents. \throws Error, as the functions below do; its message lacks the file's name.
  explicit VdbFile(const std::filesystem::path& path);

  [[nodiscard]] std::uint32_t version() const { return mVersion; }
  [[nodiscard]] std::uint32_t libraryMajor() const { return mLibraryMajor; }
  [[nodiscard]] std::uint32_t libraryMinor() const { return mLibraryMinor; }
  [[nodiscard]] const std::vector<VdbEntry>& entries() const { return mEntries; }

  /// Reads what stands before the tree of one of entries().
  [[nodiscard]] VdbGridHead readHead(const VdbEntry& entry);
  /// Checks that OpenVDB can read the tree without harm, by checkVdbTree(). \returns the position after the tree.
  std::uint64_t checkTree(const VdbEntry& entry, const VdbGridHead& head);

 private:
  void readHeader();
  void readEntries();
  std::vector<VdbMetadata> readMetadata();

  ByteReader mBytes;
  std::uint32_t mVersion = 0, mLibraryMajor = 0, mLibraryMinor = 0;
  bool mHasOffsets = true;
  std::vector<VdbEntry> mEntries;
};

}  // namespace pdc::detail
