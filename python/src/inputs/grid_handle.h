#pragma once

#include <openvdb/Grid.h>

namespace pdc::python {

/// What Python holds of an OpenVDB grid, which does not change while anybody looks at it.
struct GridHandle {
  openvdb::GridBase::Ptr grid;
};

}  // namespace pdc::python
