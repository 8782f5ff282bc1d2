#include "eval/volume_to_mesh.h"

#include <openvdb/tools/VolumeToMesh.h>

namespace pdc::eval {

Mesh volumeToMesh(const openvdb::FloatGrid& grid, double iso, double adaptivity) {
  openvdb::tools::VolumeToMesh mesher(iso, adaptivity);
  mesher(grid);
  Mesh mesh;
  for (std::size_t i = 0; i < mesher.pointListSize(); ++i) {
    const openvdb::Vec3s& p = mesher.pointList()[i];
    mesh.positions.push_back({p.x(), p.y(), p.z()});
  }
  for (std::size_t i = 0; i < mesher.polygonPoolListSize(); ++i) {
    const openvdb::tools::PolygonPool& pool = mesher.polygonPoolList()[i];
    // OpenVDB winds the other way.
    for (openvdb::Index k = 0; k < pool.numQuads(); ++k) {
      const openvdb::Vec4I& q = pool.quad(k);
      mesh.quads.push_back({q[3], q[2], q[1], q[0]});
    }
    for (openvdb::Index k = 0; k < pool.numTriangles(); ++k) {
      const openvdb::Vec3I& t = pool.triangle(k);
      mesh.triangles.push_back({t[2], t[1], t[0]});
    }
  }
  return mesh;
}

}  // namespace pdc::eval
