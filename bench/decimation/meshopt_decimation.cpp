#include <meshoptimizer.h>

#include <cfloat>

#include "best_rates.h"
#include "decimation/decimation_peers.h"

namespace pdc::eval {

Decimated meshoptSimplify(const Mesh& mesh, std::size_t targetFaces) {
  const auto* const indices = mesh.triangles.front().data();
  std::vector<unsigned> kept(3 * mesh.triangles.size());
  const double start = bench::threadSeconds();
  const std::size_t count =
      meshopt_simplify(kept.data(), indices, kept.size(), &mesh.positions.front().x, mesh.positions.size(),
                       sizeof(Vec3f), 3 * targetFaces, FLT_MAX, 0, nullptr);
  const double seconds = bench::threadSeconds() - start;
  // It leaves the vertices as they are: those without a face go.
  Mesh out;
  std::vector<std::uint32_t> numbers(mesh.positions.size(), UINT32_MAX);
  for (std::size_t i = 0; i < count; i += 3) {
    Triangle t{};
    for (std::size_t k = 0; k < 3; ++k) {
      std::uint32_t& number = numbers[kept[i + k]];
      if (number == UINT32_MAX) {
        number = static_cast<std::uint32_t>(out.positions.size());
        out.positions.push_back(mesh.positions[kept[i + k]]);
      }
      t[k] = number;
    }
    out.triangles.push_back(t);
  }
  return {std::move(out), seconds};
}

}  // namespace pdc::eval
