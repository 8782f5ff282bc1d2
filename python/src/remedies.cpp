#include "remedies.h"

#include <algorithm>
#include <array>

namespace pdc::python {
namespace {

/// What stands behind an option in a line.
enum class Value { kNone, kNumber, kWord };

struct Remedy {
  std::string_view option, python;
  Value value;
};

constexpr std::array<Remedy, 16> kRemedies{{{"iso", "level", Value::kNumber},
                                            {"class", "grid_class", Value::kWord},
                                            {"inside", "inside", Value::kWord},
                                            {"nan", "nan", Value::kWord},
                                            {"flood-fill", "flood_fill=True", Value::kNone},
                                            {"open", "open=True", Value::kNone},
                                            {"spacing", "spacing", Value::kNone},
                                            {"volume-index", "volume_index", Value::kNone},
                                            {"channel", "channel", Value::kNone},
                                            {"series", "series", Value::kNone},
                                            {"array", "array", Value::kNone},
                                            {"raw", "raw", Value::kNone},
                                            {"origin", "mesh_origin", Value::kWord},
                                            {"resample", "Grid.resample()", Value::kNone},
                                            {"fog-to-level-set", "Grid.fog_to_level_set()", Value::kNone},
                                            {"mesh-to-level-set", "Grid.from_mesh()", Value::kNone}}};

bool isOf(char c, std::string_view more) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || more.find(c) != std::string_view::npos;
}

/// How many characters from a place on belong to a word that may hold these.
std::size_t lengthOf(std::string_view text, std::string_view more) {
  return static_cast<std::size_t>(std::find_if_not(text.begin(), text.end(), [&](char c) { return isOf(c, more); }) -
                                  text.begin());
}

}  // namespace

std::string inPythonsWords(std::string_view line) {
  std::string result;
  while (!line.empty()) {
    const std::size_t at = std::min(line.find("--"), line.size());
    result += line.substr(0, at);
    line.remove_prefix(at);
    if (line.empty()) break;
    const std::size_t name = lengthOf(line.substr(2), "-");
    const auto* const found = std::find_if(kRemedies.begin(), kRemedies.end(),
                                           [&](const Remedy& r) { return r.option == line.substr(2, name); });
    if (name == 0 || found == kRemedies.end()) {
      result += line.substr(0, 2 + name);
      line.remove_prefix(2 + name);
      continue;
    }
    result += found->python;
    line.remove_prefix(2 + name);
    if (found->value == Value::kNone || !line.starts_with(' ')) continue;
    const std::size_t length = lengthOf(line.substr(1), "|-");
    const std::string_view quote = found->value == Value::kWord ? "'" : "";
    result.append("=").append(quote).append(line.substr(1, length)).append(quote);
    line.remove_prefix(1 + length);
  }
  return result;
}

std::vector<std::string> inPythonsWords(const std::vector<std::string>& lines) {
  std::vector<std::string> result;
  for (const std::string& line : lines) result.push_back(inPythonsWords(line));
  return result;
}

}  // namespace pdc::python
