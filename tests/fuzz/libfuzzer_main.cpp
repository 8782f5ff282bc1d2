// The entry of libFuzzer; PDC_FUZZ_TARGET names one of the functions of targets.h.

#include <cstddef>
#include <cstdint>

#include "fuzz/targets.h"
#include "pdc/error.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    pdc::PDC_FUZZ_TARGET({reinterpret_cast<const char*>(data), size});
  } catch (const pdc::Error&) {
    return -1;  // Not worth keeping: what is refused leads nowhere new.
  }
  return 0;
}
