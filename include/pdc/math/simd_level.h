#pragma once

namespace pdc {

/// Instruction sets that the batches of quadrics are compiled for. The results have the same bits at every level.
enum class SimdLevel { kBaseline, kAvx2, kAvx512 };

/// The highest level that this processor runs; asked once.
[[nodiscard]] SimdLevel bestSimdLevel();

}  // namespace pdc
