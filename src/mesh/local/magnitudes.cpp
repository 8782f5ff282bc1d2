#include "mesh/local/magnitudes.h"

#include <cmath>
#include <cstddef>
#include <variant>

namespace pdc::detail {

Buffer<float> magnitudes(const VertexProperty& property) {
  const auto components = static_cast<std::size_t>(property.components);
  return std::visit(
      [&](const auto& numbers) {
        Buffer<float> result(numbers.size() / components);
        for (std::size_t i = 0; i < result.size(); ++i) {
          if (components == 1) {
            result[i] = static_cast<float>(numbers[i]);
            continue;
          }
          double squares = 0;
          for (std::size_t k = i * components; k < (i + 1) * components; ++k)
            squares += static_cast<double>(numbers[k]) * static_cast<double>(numbers[k]);
          result[i] = static_cast<float>(std::sqrt(squares));
        }
        return result;
      },
      property.values);
}

}  // namespace pdc::detail
