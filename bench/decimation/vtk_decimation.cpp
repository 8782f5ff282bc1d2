#include <vtkCellArray.h>
#include <vtkDecimatePro.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkQuadricDecimation.h>

#include "best_rates.h"
#include "decimation/decimation_peers.h"

namespace pdc::eval {
namespace {

void toVtk(const Mesh& mesh, vtkPolyData& out) {
  const vtkNew<vtkPoints> points;
  for (const Vec3f& p : mesh.positions) points->InsertNextPoint(p.x, p.y, p.z);
  const vtkNew<vtkCellArray> faces;
  for (const Triangle& t : mesh.triangles) {
    const vtkIdType corners[3]{t[0], t[1], t[2]};
    faces->InsertNextCell(3, corners);
  }
  out.SetPoints(points);
  out.SetPolys(faces);
}

Mesh fromVtk(vtkPolyData& mesh) {
  Mesh out;
  for (vtkIdType v = 0; v < mesh.GetNumberOfPoints(); ++v) {
    double p[3];
    mesh.GetPoint(v, p);
    out.positions.push_back(vecCast<float>(Vec3d{p[0], p[1], p[2]}));
  }
  vtkIdType size = 0;
  const vtkIdType* corners = nullptr;
  for (mesh.GetPolys()->InitTraversal(); mesh.GetPolys()->GetNextCell(size, corners) != 0;)
    out.triangles.push_back({static_cast<std::uint32_t>(corners[0]), static_cast<std::uint32_t>(corners[1]),
                             static_cast<std::uint32_t>(corners[2])});
  return out;
}

template <typename Filter>
Decimated run(const Mesh& mesh, Filter& filter, std::size_t targetFaces) {
  const vtkNew<vtkPolyData> input;
  toVtk(mesh, *input);
  filter.SetInputData(input);
  filter.SetTargetReduction(1 - static_cast<double>(targetFaces) / static_cast<double>(mesh.triangles.size()));
  const double start = bench::threadSeconds();
  filter.Update();
  const double seconds = bench::threadSeconds() - start;
  return {fromVtk(*filter.GetOutput()), seconds};
}

}  // namespace

Decimated vtkQuadrics(const Mesh& mesh, std::size_t targetFaces) {
  const vtkNew<vtkQuadricDecimation> filter;
  return run(mesh, *filter, targetFaces);
}

Decimated vtkPro(const Mesh& mesh, std::size_t targetFaces) {
  const vtkNew<vtkDecimatePro> filter;
  filter->PreserveTopologyOn();
  return run(mesh, *filter, targetFaces);
}

}  // namespace pdc::eval
