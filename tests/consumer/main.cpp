// Uses the installed headers that the README's example does not, down to a field of its own.
#include <pdc/extract/contour.h>
#include <pdc/field/function_field.h>
#include <pdc/mesh/mesh_report.h>
#include <pdc/sample/implicit/field_source.h>

#include <cmath>
#include <cstdio>

int main() {
  const pdc::FieldPtr ball =
      pdc::functionField({.value = [](const pdc::Vec3d& p) { return pdc::length(p) - 1; }, .lipschitz = 1.0});
  const pdc::FieldSource source(ball, {.box = {{-1.5, -1.5, -1.5}, {1.5, 1.5, 1.5}}, .voxelSize = 0.1});
  const pdc::MeshReport report = pdc::analyze(pdc::contour(source));
  std::printf("euler number %lld, volume %.4f\n", report.eulerNumber, report.volume);
  const double ballVolume = 4.0 / 3.0 * 3.14159265358979;
  return report.eulerNumber == 2 && std::abs(report.volume - ballVolume) < 0.01 * ballVolume ? 0 : 1;
}
