#pragma once

#include <memory>

#include "pdc/io/volume/volume_reader.h"

namespace pdc::python {

/// What Python holds of a dense volume from a file. Shared with the arrays that look into it, so it never changes.
struct VolumeHandle {
  std::shared_ptr<const DenseVolume> volume;
};

}  // namespace pdc::python
