#include "commands/input_kind.h"

#include <string>

#include "io/file/suffix.h"

namespace pdc {

InputKind inputKind(const std::filesystem::path& path) {
  const std::string suffix = detail::suffixOf(path);
  if (suffix == ".vdb") return InputKind::kGrid;
  if (suffix == ".yaml" || suffix == ".yml") return InputKind::kScene;
  return InputKind::kOther;
}

}  // namespace pdc
