#pragma once

#include <cstddef>

#include "pdc/io/mesh/mesh_writer.h"
#include "pdc/mesh/mesh.h"

namespace pdc::detail {

class ByteOutput;

/// "int" if it holds every index of a mesh with that many vertices, else "uint".
[[nodiscard]] const char* plyIndexType(std::size_t vertices);

struct PlyCounts {
  std::size_t vertices, faces;
};

/// Binary little-endian or text; quads come before triangles, and those before polygons. \throws Error;
/// std::invalid_argument for names that checkPlyNames refuses.
void writePly(const Mesh& mesh, ByteOutput& file, const MeshWriteOptions& options);

// The parts of such a file, for meshes that come in pieces, one after the other.

/// \param mesh with the normals, properties and origin of the pieces; its polygons are all that there will be.
/// \throws as writePly().
void writePlyHeader(const Mesh& mesh, const PlyCounts& counts, ByteOutput& file, const MeshWriteOptions& options);
void writePlyVertices(const Mesh& mesh, ByteOutput& file, const MeshWriteOptions& options);
/// Corners are written as they are, whether `mesh` has such vertices or not.
void writePlyFaces(const Mesh& mesh, ByteOutput& file, const MeshWriteOptions& options);

}  // namespace pdc::detail
