#pragma once

namespace pdc {

/// Instruction sets that loops over batches are compiled for, each holding the one before it. Results have the same
/// bits at every level.
enum class SimdLevel { kBaseline, kAvx2, kAvx512 };

/// The highest level that this processor runs; the processor is asked once. Safe from any thread; kBaseline on machines
/// that are not x86-64.
[[nodiscard]] SimdLevel bestSimdLevel();

}  // namespace pdc
