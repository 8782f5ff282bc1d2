#pragma once

#include <string>
#include <vector>

#include "eval/shapes.h"
#include "pdc/mesh/mesh.h"

namespace pdc::eval {

/// A mesh as in Figures 1 and 2 of Trettner & Kobbelt 2020, with what it is without its faults.
struct FigureInput {
  std::string name;
  Mesh mesh, clean;
  std::vector<Segment> edges;  ///< The sharp edges of the clean surface.
  double share = 0.3;          ///< Of the faces, and so of the vertices, that are to be left.
  double spike = 0;            ///< How far spikes stand out, in world units; 0 where there are none.
};

/// Mean length of the sides of a mesh's triangles.
[[nodiscard]] double meanSide(const Mesh& mesh);

/// A drilled block with noise that grows from front to back; a regular cube; a cube with smaller triangles amid its
/// sides and a little noise; a cube whose noise grows along x; one with spikes; a bracket with curved and flat parts.
[[nodiscard]] std::vector<FigureInput> figureInputs();

}  // namespace pdc::eval
