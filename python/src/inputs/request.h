#pragma once

#include "given_options.h"
#include "pdc/io/volume/volume_reader.h"
#include "pdc/sample/meaning/grid_meaning.h"
#include "requests/mesh_request.h"

namespace pdc::python {

/// What the program would be asked for with these options, named as pdc.contour() names them; None is not said.
/// \throws py::value_error for words and lengths that are none.
[[nodiscard]] MeshRequest requestOf(const py::dict& options);

/// How to read a dense volume. \throws as requestOf() does.
[[nodiscard]] VolumeReadOptions volumeOptionsOf(const GivenOptions& options);

/// What the values of a grid are said to mean.
[[nodiscard]] GridMeaningOptions meaningOf(const GivenOptions& options);

/// Whether values that are not finite are outside, and no error.
[[nodiscard]] bool acceptsNonFinite(const GivenOptions& options);

}  // namespace pdc::python
