#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

#include "pdc/mesh/mesh.h"

namespace pdc::eval {

/// What a decimator made, and the seconds that its thread ran for: from its own representation of the mesh to the
/// decimated one in that representation. Conversions are left out.
struct Decimated {
  Mesh mesh;
  double seconds = 0;
};

/// A mesh that a decimator's representation cannot hold.
struct CannotHold : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Another project's decimator, on one thread, with the settings that it has by default.
struct DecimationPeer {
  std::string name;
  /// \param mesh of triangles. \param targetFaces it may end up with more. \throws CannotHold.
  Decimated (*decimate)(const Mesh& mesh, std::size_t targetFaces);
};

/// Lists the peers that were there when this was built.
[[nodiscard]] std::vector<DecimationPeer> decimationPeers();
/// The names of the others.
[[nodiscard]] std::vector<std::string> missingDecimationPeers();

/// CGAL: the quadrics of Garland and Heckbert; with probabilistic planes; the cost and placement of Lindstrom and Turk.
/// The first two place vertices only where no normal turns by more than 90 degrees, as in CGAL's example.
[[nodiscard]] Decimated cgalPlanes(const Mesh& mesh, std::size_t targetFaces);
/// The standard deviations are those that the paper on probabilistic quadrics takes: 0.05 for normals, and 0.05 mean
/// lengths of an edge for positions. CGAL's own variances would be 0.05 and 0.005 times that length, which depend on
/// the unit.
[[nodiscard]] Decimated cgalProbabilisticPlanes(const Mesh& mesh, std::size_t targetFaces);
[[nodiscard]] Decimated cgalLindstromTurk(const Mesh& mesh, std::size_t targetFaces);

/// OpenMesh's decimater with its modules for quadrics and against normals that flip.
[[nodiscard]] Decimated openMeshQuadrics(const Mesh& mesh, std::size_t targetFaces);

/// meshopt_simplify, without a limit of the error.
[[nodiscard]] Decimated meshoptSimplify(const Mesh& mesh, std::size_t targetFaces);

/// VTK: vtkQuadricDecimation; and vtkDecimatePro, which removes vertices, told to keep the topology as the others do.
[[nodiscard]] Decimated vtkQuadrics(const Mesh& mesh, std::size_t targetFaces);
[[nodiscard]] Decimated vtkPro(const Mesh& mesh, std::size_t targetFaces);

}  // namespace pdc::eval
