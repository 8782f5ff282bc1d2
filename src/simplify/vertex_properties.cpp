#include "simplify/vertex_properties.h"

#include <cmath>
#include <cstddef>
#include <type_traits>
#include <variant>

namespace pdc::detail {

void InterpolatedProperties::blend(std::uint32_t a, std::uint32_t b, double share) {
  for (VertexProperty& property : mProperties)
    std::visit(
        [&, n = static_cast<std::size_t>(property.components)](auto& values) {
          using Number = typename std::remove_reference_t<decltype(values)>::value_type;
          for (std::size_t i = 0; i < n; ++i) {
            const double from = static_cast<double>(values[a * n + i]), to = static_cast<double>(values[b * n + i]);
            const double between = (1 - share) * from + share * to;
            // Between two numbers of a type rounding gives a number of the type.
            values[a * n + i] = static_cast<Number>(std::is_integral_v<Number> ? std::round(between) : between);
          }
        },
        property.values);
}

std::vector<VertexProperty> InterpolatedProperties::of(std::span<const std::uint32_t> vertices) const {
  std::vector<VertexProperty> result;
  for (const VertexProperty& property : mProperties) {
    const auto n = static_cast<std::size_t>(property.components);
    std::visit(
        [&](const auto& values) {
          std::remove_cvref_t<decltype(values)> some;
          some.reserve(n * vertices.size());
          for (const std::uint32_t v : vertices)
            some.insert(some.end(), values.begin() + v * n, values.begin() + (v + 1) * n);
          result.push_back({property.name, property.components, std::move(some)});
        },
        property.values);
  }
  return result;
}

}  // namespace pdc::detail
