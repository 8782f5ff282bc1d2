#pragma once

#include <openvdb/Grid.h>

#include "pdc/field/field.h"

namespace pdc {

/// A scalar OpenVDB grid as a field: trilinear interpolation of (value - iso), or (iso - value) if insideIsHigher, with
/// the interpolant's own gradient, through the grid's transform.
///
/// Active and inactive voxels count alike; outside of the stored nodes the value is the background's. Interpolants of
/// NaN and infinite voxels, where those are accepted, are NaN, and bound() leaves them out. Bounds are those of the
/// interpolant over the box's image in index space if that is smaller than eight voxels along each axis; for larger
/// boxes they come from the stored ranges of cubes of voxels, which are computed here, on all threads, and
/// take memory in proportion to the number of leaves. No Lipschitz constant is known. The field shares ownership of the
/// grid, which must not change while the field lives.
/// \param acceptNonFinite false: NaN and infinite voxels are an error, wherever in the tree they are stored.
/// \throws Error for other types than float and double, for voxels that are not finite and not accepted, and for a
/// transform that is not affine or cannot be inverted; std::invalid_argument for a null grid or an iso that is not
/// finite.
FieldPtr gridField(const openvdb::GridBase::ConstPtr& grid, double iso, bool insideIsHigher,
                   bool acceptNonFinite = false);

}  // namespace pdc
