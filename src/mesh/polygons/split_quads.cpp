#include "mesh/polygons/split_quads.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>

namespace pdc::detail {

void splitQuads(Mesh& mesh) {
  const std::size_t quads = mesh.quads.size();
  Buffer<Triangle> triangles(2 * quads + mesh.triangles.size());
  tbb::parallel_for(std::size_t{0}, quads, [&](std::size_t i) {
    const Quad& q = mesh.quads[i];
    triangles[2 * i] = {q[0], q[1], q[2]};
    triangles[2 * i + 1] = {q[0], q[2], q[3]};
  });
  std::copy(mesh.triangles.begin(), mesh.triangles.end(), triangles.begin() + static_cast<std::ptrdiff_t>(2 * quads));
  mesh.triangles.swap(triangles);
  Buffer<Quad>().swap(mesh.quads);
}

}  // namespace pdc::detail
