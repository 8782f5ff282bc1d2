#include "io/vdb/vdb_tree_check.h"

#include <fmt/format.h>
#include <openvdb/io/Compression.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <optional>
#include <sstream>
#include <vector>

#include "io/file/byte_reader.h"
#include "pdc/error.h"
#include "sample/meaning/contourable_grids.h"

namespace pdc::detail {
namespace {

/// Bytes of a value.
struct ValueSize {
  std::uint64_t full;
  std::uint64_t half;  ///< The bytes where reals are stored with 16 bits.
};

std::optional<ValueSize> valueSize(const std::string& type) {
  constexpr std::uint64_t kHalf = 2;
  std::optional<ValueSize> size;
  forEachGridType<SampledGrids>([&]<typename GridT>(std::type_identity<GridT>) {
    using ValueT = typename GridT::ValueType;
    using Number = typename openvdb::VecTraits<ValueT>::ElementType;
    if (type != GridT::gridType()) return;
    size = {sizeof(ValueT),
            std::is_floating_point_v<Number> ? sizeof(ValueT) / sizeof(Number) * kHalf : sizeof(ValueT)};
  });
  return size;
}

constexpr std::uint64_t nodeValues(int log2Dim) { return std::uint64_t{1} << (3 * log2Dim); }
constexpr std::uint64_t maskBytes(int log2Dim) { return nodeValues(log2Dim) / 8; }

constexpr std::size_t kBloscHeaderBytes = 16;

using Origin = std::array<std::int32_t, 3>;

/// One walk through a tree, which ends at the first thing that is wrong.
class TreeWalk {
 public:
  TreeWalk(ByteReader& bytes, const VdbTreeFormat& format, ValueSize size)
      : mBytes(bytes),
        mCompression(format.compression),
        mIsBool(size.full == 1),
        mSize(size.full),
        mStoredSize(format.half ? size.half : size.full) {}

  void run() {
    constexpr std::uint32_t kKnownFlags =
        openvdb::io::COMPRESS_ZIP | openvdb::io::COMPRESS_ACTIVE_MASK | openvdb::io::COMPRESS_BLOSC;
    if ((mCompression & ~kKnownFlags) != 0) throw Error(fmt::format("compression {:#x} is unknown", mCompression));
    if (mBytes.get<std::int32_t>() != 1) throw damaged("number of buffers");
    checkRoot();
    for (; mLeaves > 0; --mLeaves) checkLeafBuffer();
  }

 private:
  Error damaged(const char* what) const {
    return Error(fmt::format("damaged at byte {}: {}", mBytes.position(), what));
  }

  void checkRoot() {
    readFullValue();
    const auto tiles = mBytes.get<std::uint32_t>(), children = mBytes.get<std::uint32_t>();
    std::vector<Origin> origins;
    for (std::uint32_t i = 0; i < tiles; ++i) {
      origins.push_back(readOrigin());
      readFullValue();
      if (mBytes.get<std::uint8_t>() > 1) throw damaged("tile");
    }
    for (std::uint32_t i = 0; i < children; ++i) {
      origins.push_back(readOrigin());
      checkNode(5);
    }
    // A second child at the same place would replace the first, and the buffers of both would follow.
    std::sort(origins.begin(), origins.end());
    if (std::adjacent_find(origins.begin(), origins.end()) != origins.end()) throw damaged("two nodes at one place");
  }

  Origin readOrigin() {
    constexpr std::int32_t kRootChildSize = 1 << (5 + 4 + 3);
    const auto origin = mBytes.get<Origin>();
    for (const std::int32_t c : origin)
      if (c % kRootChildSize != 0) throw damaged("origin of a node");
    return origin;
  }

  /// Checks the topology of an internal node and of all that is below it.
  void checkNode(int log2Dim) {
    const std::string children = mBytes.bytes(maskBytes(log2Dim)), active = mBytes.bytes(maskBytes(log2Dim));
    for (std::size_t i = 0; i < children.size(); ++i)
      if ((children[i] & active[i]) != 0) throw damaged("a node both child and active tile");
    checkValues(log2Dim, active, true);
    for (std::uint64_t n = countBits(children); n > 0; --n) {
      if (log2Dim == 5) {
        checkNode(4);
      } else {
        mBytes.skip(maskBytes(3));
        ++mLeaves;
      }
    }
  }

  void checkLeafBuffer() {
    if (mIsBool) {
      constexpr std::uint64_t kOriginBytes = 12;
      mBytes.skip(maskBytes(3) + kOriginBytes + maskBytes(3));
    } else {
      checkValues(3, mBytes.bytes(maskBytes(3)), false);
    }
  }

  /// Checks the values of one node, which have the layout of openvdb::io::readCompressedValues.
  void checkValues(int log2Dim, const std::string& active, bool topology) {
    const auto kind = mBytes.get<std::int8_t>();
    if (kind < openvdb::io::NO_MASK_OR_INACTIVE_VALS || kind > openvdb::io::NO_MASK_AND_ALL_VALS)
      throw damaged("kind of values");
    const bool two = kind == openvdb::io::MASK_AND_TWO_INACTIVE_VALS;
    const bool one =
        kind == openvdb::io::NO_MASK_AND_ONE_INACTIVE_VAL || kind == openvdb::io::MASK_AND_ONE_INACTIVE_VAL;
    for (int i = two ? 2 : one ? 1 : 0; i > 0; --i) readFullValue();
    if (two || kind == openvdb::io::MASK_AND_NO_INACTIVE_VALS || kind == openvdb::io::MASK_AND_ONE_INACTIVE_VAL)
      mBytes.skip(maskBytes(log2Dim));
    const bool onlyActive =
        (mCompression & openvdb::io::COMPRESS_ACTIVE_MASK) != 0 && kind != openvdb::io::NO_MASK_AND_ALL_VALS;
    const std::uint64_t count = onlyActive ? countBits(active) : nodeValues(log2Dim);
    if (count == 0 && mStoredSize < mSize) return;  // No size is stored for no halves.
    checkData(count * mStoredSize, topology);
  }

  /// Checks values of `size` bytes, which are stored as they are or compressed.
  void checkData(std::uint64_t size, bool topology) {
    const bool blosc = (mCompression & openvdb::io::COMPRESS_BLOSC) != 0;
    if (!blosc && (mCompression & openvdb::io::COMPRESS_ZIP) == 0) {
      takeData(size, topology);
      return;
    }
    const auto stored = mBytes.get<std::int64_t>();
    if (stored <= 0) {  // The writer found that compression does not pay.
      if (std::uint64_t{0} - static_cast<std::uint64_t>(stored) != size) throw damaged("size of a block of values");
      takeData(size, topology);
      return;
    }
    const auto storedSize = static_cast<std::uint64_t>(stored);
    if (topology) {
      checkDecompression(mBytes.bytes(storedSize), size);
    } else if (blosc) {
      const std::string header = mBytes.bytes(std::min<std::uint64_t>(storedSize, kBloscHeaderBytes));
      checkBloscHeader(header, storedSize, size);
      mBytes.skip(storedSize - header.size());
    } else {
      mBytes.skip(storedSize);
    }
  }

  /// Goes past values that are stored as they are. Below the topology there are no bools to check.
  void takeData(std::uint64_t size, bool topology) {
    if (topology && mIsBool) {
      checkBools(mBytes.bytes(size));
    } else {
      mBytes.skip(size);
    }
  }

  /// The sizes in Blosc's own header are checked, because the decompressor trusts them.
  void checkBloscHeader(const std::string& header, std::uint64_t storedSize, std::uint64_t size) const {
    constexpr std::size_t kSizeAt = 4, kStoredSizeAt = 12;
    if (header.size() < kBloscHeaderBytes) throw damaged("size of a block of values");
    std::uint32_t announced, stored;
    std::memcpy(&announced, header.data() + kSizeAt, sizeof(announced));
    std::memcpy(&stored, header.data() + kStoredSizeAt, sizeof(stored));
    if (announced != size || stored != storedSize) throw damaged("size of a block of values");
  }

  void checkDecompression(const std::string& compressed, std::uint64_t size) const {
    const bool blosc = (mCompression & openvdb::io::COMPRESS_BLOSC) != 0;
    if (blosc) checkBloscHeader(compressed, compressed.size(), size);
    const auto stored = static_cast<std::int64_t>(compressed.size());
    std::istringstream stream(std::string(reinterpret_cast<const char*>(&stored), sizeof(stored)) + compressed);
    std::string values(size, '\0');
    try {
      (blosc ? openvdb::io::bloscFromStream : openvdb::io::unzipFromStream)(stream, values.data(), values.size());
    } catch (const openvdb::Exception&) {
      throw damaged("a block of values that cannot be decompressed");
    }
    if (mIsBool) checkBools(values);
  }

  void readFullValue() {
    std::string value = mBytes.bytes(mSize);
    if (mIsBool) checkBools(value);
  }

  void checkBools(const std::string& values) const {
    for (const char c : values)
      if (c != 0 && c != 1) throw damaged("a bool that is neither true nor false");
  }

  static std::uint64_t countBits(const std::string& mask) {
    std::uint64_t count = 0;
    for (const char c : mask) count += static_cast<std::uint64_t>(std::popcount(static_cast<unsigned char>(c)));
    return count;
  }

  ByteReader& mBytes;
  std::uint32_t mCompression;
  bool mIsBool;
  std::uint64_t mSize, mStoredSize;
  std::uint64_t mLeaves = 0;
};

}  // namespace

bool isContourableVdbTree(const std::string& type) {
  bool contourable = false;
  forEachContourableType(
      [&]<typename GridT>(std::type_identity<GridT>) { contourable = contourable || type == GridT::gridType(); });
  return contourable;
}

bool isSampledVdbTree(const std::string& type) { return valueSize(type).has_value(); }

void checkVdbTree(ByteReader& bytes, const VdbTreeFormat& format) {
  const auto size = valueSize(format.type);
  if (!size) throw Error(fmt::format("trees of type {} cannot be read", format.type));
  TreeWalk(bytes, format, *size).run();
}

}  // namespace pdc::detail
