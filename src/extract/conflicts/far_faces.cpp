#include "extract/conflicts/far_faces.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "math/lane_loops.h"

namespace pdc::detail {
namespace {

/// Where there are fewer faces to one that is far-reaching, none is listed.
constexpr std::size_t kFacesPerListed = 4;

}  // namespace

/// Whether a face whose vertices stay where they are never reaches into a box.
inline bool FarFaces::staysApart(const EdgeRef& e, const Float4Box& box) const {
  const Quad* quad = mFaces.quad(mFaces.edgeCells().face(e));
  if (quad == nullptr) return false;
  Float4Box own(mFaces.corners(*quad));
  if (!own.apartFrom(box)) return false;
  // It may become a fan, about a vertex on its lattice edge.
  Vec3d end = mFaces.edgeCells().lowEnd(e);
  own.add(float4(mFaces.map().rounded(mFaces.map().position(end))));
  end[e.axis()] += 1;
  own.add(float4(mFaces.map().rounded(mFaces.map().position(end))));
  own.addRounding();
  return own.apartFrom(box);
}

/// Lists what is near the face wherever it is between its present and its safe place.
inline void FarFaces::list(Face& face, std::vector<EdgeRef>& edges) const {
  const Quad ring = mFaces.edgeCells().vertices(face.edge);
  face.likely = Float4Box(mFaces.corners(ring));
  for (const std::uint32_t v : ring)
    if (const SuspectVertex* suspect = mFaces.suspect(v))
      face.likely.add(float4(mFaces.worldPosition(*suspect, suspect->safe)));
  mLocator.facesAbout(mLocator.latticeBox(face.edge, face.likely), edges);
  for (const EdgeRef& e : edges) {
    if (mLocator.farReaching().has(e)) {
      if (e != face.edge) face.far.push_back(static_cast<std::uint32_t>(mLocator.farReaching().number(e)));
    } else if (!staysApart(e, face.likely)) {
      face.others.push_back(e);
    }
  }
}

FarFaces::FarFaces(const FaceTests& faces, const FaceLocator& locator, const std::vector<EdgeRef>& farReaching,
                   SimdLevel level, const Monitor& monitor)
    : mFaces(faces), mLocator(locator) {
  if (farReaching.size() > faces.edgeCells().faceCount() / kFacesPerListed) return;
  mListed.resize(farReaching.size());
  tbb::enumerable_thread_specific<std::vector<EdgeRef>> edges;
  tbb::parallel_for(std::size_t{0}, farReaching.size(), [&](std::size_t i) {
    monitor.throwIfStopped();
    mListed[i].edge = farReaching[i];
    std::vector<EdgeRef>& own = edges.local();
    withSimd(level, [&] { list(mListed[i], own); });
  });
}

void FarFaces::update(const EdgeRef& e, std::vector<Triangle>& triangles) {
  if (!listed(e)) return;
  Face& face = mListed[mLocator.farReaching().number(e)];
  const std::uint64_t number = mFaces.edgeCells().face(e);
  if (const Quad* quad = mFaces.quad(number)) {
    face.now = Float4Box(mFaces.corners(*quad));
    return;
  }
  mFaces.triangles(e, number, triangles);
  face.now = Float4Box(mFaces.corners(triangles[0]));
  for (const Triangle& t : triangles) face.now.add(Float4Box(mFaces.corners(t)));
}

}  // namespace pdc::detail
