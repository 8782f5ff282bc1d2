#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "pdc/mesh/mesh.h"
#include "pdc/monitor.h"

namespace pdc {

struct SmoothOptions {
  /// How often the quadric of each face is averaged with those of its neighbours, 0 to 1000.
  int iterations = 10;
  /// Standard deviation of each coordinate of the vertices, 0 or more, in mean edge lengths of the mesh, the same for
  /// all; 0 moves nothing. If not set, each vertex has what the surface seems to have around it, and none below 0.03.
  std::optional<double> sigma{};
  /// The property of the mesh that has the standard deviation of each vertex, in world units, finite and 0 or more, as
  /// contour() gives "sigma". None if empty. It takes the place of `sigma`. Less than 0.02 mean edges is none.
  std::string sigmaProperty{};
  /// Whether each face counts the same, whatever its size; else by the square of its area.
  bool normaliseArea = false;
  /// Averages with all neighbours alike, as the paper does, and not the less with those that differ by more than noise
  /// explains. Creases become round, and curved surfaces grow.
  bool plain = false;
  bool lockBoundary = false;  ///< Vertices at the boundary stay where they are.
};

struct SmoothReport {
  std::size_t vertices = 0, triangles = 0;  ///< A quad counts as two triangles.
  double meanEdge = 0;                      ///< Mean length of the edges given, in world units.
  double meanSigma = 0, largestSigma = 0;   ///< What the vertices were taken to have, in mean edge lengths.
  double meanMove = 0, largestMove = 0;     ///< How far vertices went, in mean edge lengths.
  std::size_t limitedMoves = 0;             ///< Vertices whose minimum was too far away to go there.
  std::size_t boundaryVertices = 0;
  std::size_t degenerateFaces = 0;  ///< Triangles that name a vertex twice, or have no finite corners: without a say.
};

/// Moves the vertices of a mesh so that noise goes and creases stay (Trettner & Kobbelt 2020, section 5.2). Each face
/// gets its probabilistic triangle quadric, quadrics are averaged with those of the faces across their edges, and each
/// vertex goes to the minimum of the sum over its faces: all the way where it has noise, and not where it has none. No
/// vertex goes farther than its longest edge, or than eight standard deviations.
///
/// Boundaries are held like creases, by planes that stand on them, so that they are smoothed and do not shrink. Faces,
/// their order, and properties of vertices stay as they are. The result does not depend on the number of threads, nor
/// on the unit of length, nor, to rounding, on where the mesh lies. Nothing keeps faces from intersecting.
///
/// \param mesh quads stand for their two triangles. Normals are made anew if it has any. Vertices without a face, or
/// that are not finite, stay where they are.
/// \throws std::invalid_argument for options out of range and as Mesh says; Error for a mesh without faces, for one
/// whose faces do not form one oriented fan at each vertex, for a face that names a vertex that does not exist, and for
/// a property that is missing or no standard deviation; Cancelled. Progress: "smooth". Memory: some 550 bytes per
/// vertex besides the meshes.
[[nodiscard]] Mesh smooth(const Mesh& mesh, const SmoothOptions& options, SmoothReport* report = nullptr,
                          const Monitor& monitor = {});

}  // namespace pdc
