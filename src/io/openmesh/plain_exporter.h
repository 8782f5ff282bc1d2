#pragma once

#include <OpenMesh/Core/IO/exporter/BaseExporter.hh>
#include <vector>

namespace pdc::detail {

/// The questions of OpenMesh's exporter interface that have one answer for a mesh without colours, texture and
/// half-edges. Left open: point, normal of a face, get_vhandles and the counts.
class PlainExporter : public OpenMesh::IO::BaseExporter {
 public:
  using Vec2f = OpenMesh::Vec2f;
  using Vec3f = OpenMesh::Vec3f;
  using Vec3d = OpenMesh::Vec3d;
  using Vec3uc = OpenMesh::Vec3uc;
  using Vec4uc = OpenMesh::Vec4uc;
  using Vec3ui = OpenMesh::Vec3ui;
  using Vec4ui = OpenMesh::Vec4ui;
  using Vec4f = OpenMesh::Vec4f;
  using VertexHandle = OpenMesh::VertexHandle;
  using HalfedgeHandle = OpenMesh::HalfedgeHandle;
  using EdgeHandle = OpenMesh::EdgeHandle;
  using FaceHandle = OpenMesh::FaceHandle;
  using StatusInfo = OpenMesh::Attributes::StatusInfo;
  using OpenMesh::IO::BaseExporter::normal;

  Vec3d pointd(VertexHandle v) const override { return Vec3d(point(v)); }
  bool is_point_double() const override { return false; }
  Vec3f normal(VertexHandle) const override { return Vec3f(0.0f); }
  Vec3d normald(VertexHandle) const override { return Vec3d(0.0); }
  bool is_normal_double() const override { return false; }
  Vec3uc color(VertexHandle) const override { return Vec3uc(0); }
  Vec4uc colorA(VertexHandle) const override { return Vec4uc(0); }
  Vec3ui colori(VertexHandle) const override { return Vec3ui(0); }
  Vec4ui colorAi(VertexHandle) const override { return Vec4ui(0); }
  Vec3f colorf(VertexHandle) const override { return Vec3f(0.0f); }
  Vec4f colorAf(VertexHandle) const override { return Vec4f(0.0f); }
  Vec2f texcoord(VertexHandle) const override { return Vec2f(0.0f); }
  Vec2f texcoord(HalfedgeHandle) const override { return Vec2f(0.0f); }
  StatusInfo status(VertexHandle) const override { return {}; }

  HalfedgeHandle getHeh(FaceHandle, VertexHandle) const override { return HalfedgeHandle(); }
  unsigned int get_face_texcoords(std::vector<Vec2f>&) const override { return 0; }
  Vec3d normald(FaceHandle f) const override { return Vec3d(normal(f)); }
  Vec3uc color(FaceHandle) const override { return Vec3uc(0); }
  Vec4uc colorA(FaceHandle) const override { return Vec4uc(0); }
  Vec3ui colori(FaceHandle) const override { return Vec3ui(0); }
  Vec4ui colorAi(FaceHandle) const override { return Vec4ui(0); }
  Vec3f colorf(FaceHandle) const override { return Vec3f(0.0f); }
  Vec4f colorAf(FaceHandle) const override { return Vec4f(0.0f); }
  StatusInfo status(FaceHandle) const override { return {}; }

  Vec3uc color(EdgeHandle) const override { return Vec3uc(0); }
  Vec4uc colorA(EdgeHandle) const override { return Vec4uc(0); }
  Vec3ui colori(EdgeHandle) const override { return Vec3ui(0); }
  Vec4ui colorAi(EdgeHandle) const override { return Vec4ui(0); }
  Vec3f colorf(EdgeHandle) const override { return Vec3f(0.0f); }
  Vec4f colorAf(EdgeHandle) const override { return Vec4f(0.0f); }
  StatusInfo status(EdgeHandle) const override { return {}; }

  int get_halfedge_id(VertexHandle) override { return -1; }
  int get_halfedge_id(FaceHandle) override { return -1; }
  int get_next_halfedge_id(HalfedgeHandle) override { return -1; }
  int get_to_vertex_id(HalfedgeHandle) override { return -1; }
  int get_face_id(HalfedgeHandle) override { return -1; }
  StatusInfo status(HalfedgeHandle) const override { return {}; }
  size_t n_edges() const override { return 0; }
};

}  // namespace pdc::detail
