#pragma once

#include <string>

#include "pdc/mesh/mesh.h"

namespace pdc::detail {

class ByteOutput;

/// Through OpenMesh's writers, straight from the faces as they are, so that meshes that are no manifolds can be written
/// too. Quads and polygons become triangles; text or binary. The normal of a triangle without area is zero.
/// \param frame what is known of the coordinates; see frameText(). \throws
/// Error if there are more faces than OpenMesh can count (2^31 - 1).
void writeStl(const Mesh& mesh, ByteOutput& file, bool ascii, const std::string& frame);
/// Text, with the origin, the frame and that we wrote it in comments at the end; quads come before triangles, and those
/// before polygons. \throws Error as above.
void writeOff(const Mesh& mesh, ByteOutput& file, const std::string& frame);

}  // namespace pdc::detail
