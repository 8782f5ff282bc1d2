#include "folders.h"

namespace pdc::test {

std::filesystem::path dataFolder() { return PDC_DATA_DIR; }
std::filesystem::path sourceFolder() { return PDC_SOURCE_DIR; }

}  // namespace pdc::test
