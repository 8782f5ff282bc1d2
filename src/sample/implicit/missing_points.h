#pragma once

#include <tbb/enumerable_thread_specific.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "pdc/field/field.h"
#include "pdc/sample/lattice.h"
#include "sample/implicit/lattice_frame.h"

namespace pdc::detail {

/// The lattice points at which a function has been looked at and was not finite. Any thread may add some.
class MissingPoints {
 public:
  /// \param cells of the lattice; points beyond it do not count.
  MissingPoints(const Field& function, const LatticeFrame& frame, const Coord& cells)
      : mFunction(function), mFrame(frame), mCells(cells) {}

  /// A point may be added several times.
  void add(const Coord& point);
  /// \throws Error as throwIfAny() if there are more than kMostCountedPoints. No thread may add any meanwhile.
  void throwIfMany();
  /// \throws Error that counts them and names the first, if there are any.
  void throwIfAny();

 private:
  void gather();
  [[noreturn]] void fail() const;

  const Field& mFunction;
  LatticeFrame mFrame;
  Coord mCells;
  tbb::enumerable_thread_specific<std::vector<std::uint64_t>> mAdded;
  std::vector<std::uint64_t> mPoints;  ///< Ascending, each once.
};

}  // namespace pdc::detail
