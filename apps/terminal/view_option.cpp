#include "terminal/view_option.h"

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

#include "pdc/render/camera.h"
#include "terminal/numbers.h"

namespace pdc {
namespace {

Vec3d parseView(const std::string& text) {
  if (const auto view = viewNamed(text)) return *view;
  const std::vector<double> v = parseReals(text, ',');
  const double l = v.size() == 3 ? length(Vec3d{v[0], v[1], v[2]}) : 0;
  if (!(l > 0) || !std::isfinite(l))
    throw CLI::ValidationError(
        "--view",
        fmt::format("'{}' is not iso, front, back, left, right, top, bottom or a direction X,Y,Z to the viewer", text));
  return {v[0], v[1], v[2]};
}

}  // namespace

void addView(CLI::App& command, Vec3d& target) {
  command
      .add_option_function<std::string>(
          "--view", [&target](const std::string& text) { target = parseView(text); },
          "From where (iso): iso, front, back, left, right, top,\nbottom, or the direction X,Y,Z to the viewer; z is "
          "up")
      ->type_name("FROM");
}

}  // namespace pdc
