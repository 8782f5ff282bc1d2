#include "sample/dense/volume_signs.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <cstring>

#include "parallel/for_each_in_parallel.h"
#include "sample/block_index.h"
#include "sample/dense/bit_cube.h"
#include "sample/stencils/isovalue_points.h"

namespace pdc::detail {
namespace {

constexpr int kWordBlocks = 64 / kBlockSize;

}  // namespace

Coord blocksOf(const VolumeView& view) {
  Coord blocks;
  for (int axis = 0; axis < 3; ++axis)
    blocks[axis] = static_cast<std::int32_t>((view.size[axis] + kBlockSize - 1) / kBlockSize);
  return blocks;
}

/// Reads the signs of rows of blocks along the axis that memory runs along.
class VolumeSigns::RowReader {
 public:
  RowReader(const VolumeSampler& values, VolumeSigns& signs)
      : mValues(values), mSigns(signs), mRun(detail::runAxis(values.view())) {
    // The inner of the other two is that whose lines lie closer.
    const auto& stride = values.view().stride;
    const Axis u = nextAxis(mRun), v = previousAxis(mRun);
    const auto size = [&](Axis a) { return stride[a] < 0 ? -stride[a] : stride[a]; };
    mInner = size(u) < size(v) ? u : v;
    mOuter = mInner == u ? v : u;
  }

  [[nodiscard]] std::size_t rows() const {
    return static_cast<std::size_t>(mSigns.mBlocks[mOuter]) * static_cast<std::size_t>(mSigns.mBlocks[mInner]);
  }

  /// \returns false if a value is not finite.
  bool read(std::size_t row, std::vector<Coord>& onIso) const {
    const auto inner = static_cast<std::size_t>(mSigns.mBlocks[mInner]);
    Coord block{};
    block[mOuter] = static_cast<std::int32_t>(row / inner);
    block[mInner] = static_cast<std::int32_t>(row % inner);
    bool allFinite = true;
    const std::int64_t size = mValues.view().size[mRun];
    for (std::int64_t first = 0; first < size; first += kMostRun) {
      const int count = static_cast<int>(std::min<std::int64_t>(kMostRun, size - first));
      block[mRun] = static_cast<std::int32_t>(first / kBlockSize);
      allFinite = readRuns(block, count, onIso) && allFinite;
    }
    return allFinite;
  }

 private:
  static constexpr int kWords = kMostRun / 64;
  /// The bits of 8×8 lines: word w of line (outer, inner) is lines[w][8 outer + inner].
  using Lines = std::array<std::array<std::uint64_t, 64>, kWords>;

  bool readRuns(const Coord& block, int count, std::vector<Coord>& onIso) const {
    Lines lines;
    RunRemarks remarks;
    const int words = (count + 63) / 64;
    for (int outer = 0; outer < kBlockSize; ++outer)
      for (int inner = 0; inner < kBlockSize; ++inner) {
        Coord first{};
        first[mRun] = kBlockSize * block[mRun];
        first[mOuter] = kBlockSize * block[mOuter] + outer;
        first[mInner] = kBlockSize * block[mInner] + inner;
        std::array<std::uint64_t, kWords> bits{};
        if (mValues.holds(first)) {
          const RunRemarks r = mValues.insideBits(first, mRun, count, bits.data());
          remarks.allFinite = remarks.allFinite && r.allFinite;
          remarks.onIso |= r.onIso;
        }
        for (int w = 0; w < words; ++w) lines[w][kBlockSize * outer + inner] = bits[w];
      }
    Coord at = block;
    for (int w = 0; w < words; ++w, at[mRun] += kWordBlocks) {
      const int blocks = std::min(kWordBlocks, mSigns.mBlocks[mRun] - at[mRun]);
      setBlocks(at, blocks, lines[w]);
      if ((remarks.onIso >> w & 1) == 0) continue;
      for (int i = 0; i < blocks; ++i) {
        onIso.push_back(at);
        onIso.back()[mRun] += i;
      }
    }
    return remarks.allFinite;
  }

  /// Sets up to eight blocks in a row from the lines that they share.
  void setBlocks(const Coord& first, int count, const std::array<std::uint64_t, 64>& lines) const {
    std::uint64_t any = 0, all = ~std::uint64_t{0};
    for (const std::uint64_t line : lines) {
      any |= line;
      all &= line;
    }
    std::array<BitCube, kWordBlocks> cube;
    if (mixed(any, all)) {
      for (int outer = 0; outer < kBlockSize; ++outer) {
        BitCube part;
        std::memcpy(&part, &lines[static_cast<std::size_t>(kBlockSize) * outer], sizeof part);
        swapWordsAndBytes(part);
        for (int i = 0; i < kWordBlocks; ++i) cube[i][outer] = part[i];
      }
    }
    Coord block = first;
    for (int i = 0; i < count; ++i, ++block[mRun]) {
      const std::uint64_t one = any >> 8 * i & 0xFF, every = all >> 8 * i & 0xFF;
      if (one == 0 || every == 0xFF) {
        mSigns.mSide[mSigns.number(block)] = one == 0 ? Side::kOutside : Side::kInside;
        continue;
      }
      turnToXyz({mOuter, mInner, mRun}, cube[i]);
      mSigns.set(block, {cube[i]});
    }
  }

  /// True if a byte is neither 0 in `any` nor 255 in `all`.
  static bool mixed(std::uint64_t any, std::uint64_t all) {
    bool result = false;
    for (int i = 0; i < kWordBlocks; ++i)
      result = result || ((any >> 8 * i & 0xFF) != 0 && (all >> 8 * i & 0xFF) != 0xFF);
    return result;
  }

  const VolumeSampler& mValues;
  VolumeSigns& mSigns;
  Axis mRun, mInner, mOuter;
};

VolumeSigns::VolumeSigns(const VolumeSampler& values, const VolumeSigns* data, const Monitor& monitor)
    : mBlocks(blocksOf(values.view())) {
  const std::size_t blocks = static_cast<std::size_t>(mBlocks[0]) * static_cast<std::size_t>(mBlocks[1]) *
                             static_cast<std::size_t>(mBlocks[2]);
  mSide.resize(blocks);
  mInside.resize(blocks);
  std::atomic<bool> allFinite = true;
  tbb::enumerable_thread_specific<std::vector<Coord>> onIso;
  const RowReader reader(values, *this);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, reader.rows(), 4), [&](const auto& range) {
    std::vector<Coord>& local = onIso.local();
    for (std::size_t row = range.begin(); row != range.end(); ++row) {
      monitor.throwIfStopped();
      if (!reader.read(row, local)) allFinite.store(false, std::memory_order_relaxed);
    }
  });
  mAllFinite = allFinite;
  for (const std::vector<Coord>& part : onIso) mOnIso.insert(mOnIso.end(), part.begin(), part.end());
  if (data != nullptr) keepOnly(*data, monitor);
}

bool VolumeSigns::inside(const Coord& point) const {
  const Coord block = blockOf(point);
  if (!holds(block)) return false;
  const std::size_t i = number(block);
  if (mSide[i] != Side::kBoth) return mSide[i] == Side::kInside;
  return mInside[i].test(point[0] & 7, point[1] & 7, point[2] & 7);
}

void VolumeSigns::set(const Coord& block, const CellMask& inside) {
  const std::size_t i = number(block);
  mSide[i] = sideOf(inside);
  if (mSide[i] == Side::kBoth) mInside[i] = inside;
}

void VolumeSigns::keepOnly(const VolumeSigns& data, const Monitor& monitor) {
  tbb::parallel_for(std::int32_t{0}, mBlocks[0], [&](std::int32_t x) {
    monitor.throwIfStopped();
    for (std::int32_t y = 0; y < mBlocks[1]; ++y)
      for (std::int32_t z = 0; z < mBlocks[2]; ++z) {
        const Coord block{x, y, z};
        if (data.side(block) == Side::kInside || side(block) == Side::kOutside) continue;
        CellMask own = mask(block);
        const CellMask counts = data.mask(block);
        for (int i = 0; i < kBlockSize; ++i) own.word[i] &= counts.word[i];
        set(block, own);
      }
  });
}

void VolumeSigns::addPointsBetween(const VolumeSampler& values, const VolumeSigns* data) {
  struct Added {
    Coord block;
    CellMask points;
  };
  // All are found before any is added.
  tbb::enumerable_thread_specific<std::vector<Added>> added;
  forEachInParallel(mOnIso.size(), 64, [&](std::uint32_t i) {
    const CellMask points = pointsBetween(mOnIso[i], values, data);
    if (!points.none()) added.local().push_back({mOnIso[i], points});
  });
  for (const std::vector<Added>& part : added)
    for (const Added& a : part) {
      CellMask own = mask(a.block);
      for (int x = 0; x < kBlockSize; ++x) own.word[x] |= a.points.word[x];
      set(a.block, own);
    }
  mOnIso.clear();
}

CellMask VolumeSigns::pointsBetween(const Coord& block, const VolumeSampler& values, const VolumeSigns* data) const {
  const auto beside = [&](int axis, int step) {
    Coord b = block;
    b[axis] += step;
    return b;
  };
  std::array<CellMask, 6> around;
  bool anyInside = side(block) != Side::kOutside;
  for (int i = 0; i < 6; ++i) {
    around[i] = mask(beside(i / 2, i % 2 == 0 ? -1 : 1));
    anyInside = anyInside || side(beside(i / 2, i % 2 == 0 ? -1 : 1)) != Side::kOutside;
  }
  if (!anyInside || side(block) == Side::kInside) return {};
  const CellMask own = mask(block);
  CellMask points = detail::pointsBetween(own, around);
  for (int x = 0; x < kBlockSize; ++x) {
    std::uint64_t& word = points.word[x];
    word &= ~own.word[x];
    for (std::uint64_t bits = word; bits != 0; bits &= bits - 1) {
      const int i = std::countr_zero(bits);
      const Coord p{kBlockSize * block[0] + x, kBlockSize * block[1] + (i >> 3), kBlockSize * block[2] + (i & 7)};
      if (!values.holds(p) || !values.onIso(p) || (data != nullptr && !data->inside(p)))
        word &= ~(std::uint64_t{1} << i);
    }
  }
  return points;
}

}  // namespace pdc::detail
