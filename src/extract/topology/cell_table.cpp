#include "extract/topology/cell_table.h"

namespace pdc::detail {

constinit const std::array<CellEntry, 256> kCellTable = makeCellTable();

}  // namespace pdc::detail
