#pragma once

#include <openvdb/Grid.h>

#include "pdc/field/field.h"

namespace pdc {

/// A scalar OpenVDB grid as a field: trilinear interpolation of (value - iso), or (iso - value) if insideIsHigher, with
/// the interpolant's own gradient, through the grid's transform. Bounds come from stored value ranges of blocks of
/// voxels. Float and double grids with an affine transform; others throw Error. std::invalid_argument for null or an
/// iso that is not finite. The grid must not change while the field lives.
FieldPtr gridField(const openvdb::GridBase::ConstPtr& grid, double iso, bool insideIsHigher);

}  // namespace pdc
