#include "tiles/input_identity.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <vector>

#include "io/file/file_error.h"
#include "math/hash128.h"

namespace pdc {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

Json sizeAndTime(const fs::path& file) {
  std::error_code error;
  const std::uintmax_t size = fs::file_size(file, error);
  if (error) throw detail::fileError(file, "cannot be read", error.value());
  return {{"size", size}, {"changed", fs::last_write_time(file).time_since_epoch().count()}};
}

std::string hashOfFile(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  detail::StreamHash hash;
  std::vector<char> chunk(std::size_t{1} << 20);
  while (file) {
    file.read(chunk.data(), static_cast<std::streamsize>(chunk.size()));
    hash.add(chunk.data(), static_cast<std::size_t>(file.gcount()));
  }
  if (!file.eof()) throw detail::fileError(path, "cannot be read");
  return detail::hashText(hash.hash());
}

std::string hashOfFolder(const fs::path& folder) {
  std::vector<std::string> lines;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    if (entry.is_regular_file())
      lines.push_back(entry.path().filename().string() + " " + sizeAndTime(entry.path()).dump());
  std::sort(lines.begin(), lines.end());
  detail::StreamHash hash;
  for (const std::string& line : lines) hash.add(line.data(), line.size());
  return detail::hashText(hash.hash());
}

}  // namespace

Json inputIdentity(const fs::path& input) {
  if (fs::is_directory(input)) return {{"hash", hashOfFolder(input)}};
  Json identity = sizeAndTime(input);
  identity["hash"] = hashOfFile(input);
  return identity;
}

void checkIdentity(const fs::path& input, const Json& identity) {
  const bool isFolder = fs::is_directory(input);
  if (!isFolder) {
    Json now = sizeAndTime(input);
    now["hash"] = identity.at("hash");
    if (now == identity) return;
  }
  if ((isFolder ? hashOfFolder(input) : hashOfFile(input)) != identity.at("hash").get<std::string>())
    throw detail::fileError(input, "has changed since it was planned; plan it again");
}

}  // namespace pdc
