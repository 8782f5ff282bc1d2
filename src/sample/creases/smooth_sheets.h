#pragma once

#include "sample/creases/crease_sheets.h"

namespace pdc::detail {

/// Joins sheets that one curved sheet explains as well, the most alike first, until no two are left: what
/// findSheets() parts by the turn of the normals alone is one on a small sphere, a strand or a noisy plane. Sheets that
/// turn their backs on each other stay apart. \param samples, weights as findSheets() left them. \param normalNoise as
/// for findSheets().
void joinSmoothSheets(const SurfaceSamples& samples, double normalNoise, CreaseSheets& sheets, SheetWeights& weights,
                      SimdLevel level = bestSimdLevel());

}  // namespace pdc::detail
