#include "io/file/file_error.h"

#include <fmt/format.h>

#include <system_error>

namespace pdc::detail {

std::string oneLine(std::string_view text) {
  std::string line(text);
  for (char& c : line)
    if (static_cast<unsigned char>(c) < ' ' || c == '\x7f') c = ' ';
  return line;
}

Error systemError(std::string_view what, int errorNumber) {
  return Error(fmt::format("{}: {}", what, std::generic_category().message(errorNumber)));
}

Error fileError(const std::filesystem::path& path, std::string_view what) {
  return Error(oneLine(fmt::format("{}: {}", path.string(), what)));
}

Error fileError(const std::filesystem::path& path, std::string_view what, int errorNumber) {
  return fileError(path, systemError(what, errorNumber).what());
}

}  // namespace pdc::detail
