#pragma once

#include <array>
#include <optional>
#include <string_view>

namespace pdc::detail {

/// A unit of length that mesh formats know.
struct LengthUnit {
  std::string_view name;     ///< As in volumes' headers and MeshWriteOptions.
  std::string_view threeMf;  ///< As .3mf files name it.
  double metres;
};

inline constexpr std::array<LengthUnit, 6> kLengthUnits{{{"um", "micron", 1e-6},
                                                         {"mm", "millimeter", 1e-3},
                                                         {"cm", "centimeter", 1e-2},
                                                         {"m", "meter", 1},
                                                         {"in", "inch", 0.0254},
                                                         {"ft", "foot", 0.3048}}};

/// The unit of that name; nothing if it is none of them.
[[nodiscard]] constexpr std::optional<LengthUnit> lengthUnit(std::string_view name) {
  for (const LengthUnit& unit : kLengthUnits)
    if (unit.name == name) return unit;
  return std::nullopt;
}

}  // namespace pdc::detail
