#include "commands/input_kind.h"

#include <string>

namespace pdc {

InputKind inputKind(const std::filesystem::path& path) {
  std::string suffix = path.extension().string();
  for (char& c : suffix) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  if (suffix == ".vdb") return InputKind::kGrid;
  if (suffix == ".yaml" || suffix == ".yml") return InputKind::kScene;
  return InputKind::kOther;
}

}  // namespace pdc
