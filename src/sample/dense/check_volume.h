#pragma once

#include "pdc/sample/dense/volume_view.h"

namespace pdc::detail {

/// \param what the view is called in errors. \throws what DenseSource throws for views.
void checkVolume(const VolumeView& view, const char* what);

}  // namespace pdc::detail
