#include "inputs/contour_run.h"

#include <fmt/format.h>

#include "files/mesh_attributes.h"
#include "parallel/stopwatch.h"
#include "parallel/with_threads.h"
#include "pdc/extract/contour.h"
#include "remedies.h"
#include "reports/mesh_checks.h"

namespace pdc::python {
namespace {

const MeshRemedies kRemedies{.precision = "mesh_origin='auto' keeps what is lost",
                             .specks = "a level farther from the noise or a smoothed input has fewer"};

void noteInput(const Input& input, MeshRun& run) {
  if (input.refusedNoise > 0)
    run.warnings.push_back(
        fmt::format("{} values of sigma and weight are negative or not finite; they count as 0", input.refusedNoise));
  run.warnings.insert(run.warnings.end(), input.warnings.begin(), input.warnings.end());
  run.meaning = input.meaning;
  run.mesh = input.mesh;
  run.volume = input.volume;
  run.steps = input.steps;
  run.crossingsWithoutData = input.crossingsWithoutData;
  run.iso = input.iso;
  run.planeOrigin = input.planeOrigin;
  run.valueNoise = input.valueNoise;
}

void noteMesh(const Input& input, const Mesh& mesh, MeshRun& run) {
  if (mesh.empty()) run.warnings.push_back(input.whyEmpty() + "; the mesh is empty");
  for (std::string& line : meshWarnings(input, mesh, kRemedies)) run.warnings.push_back(std::move(line));
  run.vertices = mesh.positions.size();
  run.quads = mesh.quads.size();
  run.triangles = mesh.triangles.size();
  run.origin = mesh.origin;
  run.properties = propertiesJson(mesh.properties);
  run.verticesOnBox = verticesOnBox(input, mesh);
}

}  // namespace

ContourRun contourInput(const OpenInput& open, const MeshRequest& request, const Monitor& monitor) {
  return detail::withThreads(request.threads.value_or(0), [&] {
    ContourRun made;
    MeshRun& run = made.run;
    detail::Stopwatch stopwatch;
    const Input input = open(monitor);
    run.secondsRead = stopwatch.lap();
    noteInput(input, run);
    checkAttributes(input, request.ownProperties());
    run.options = request.contourOptions(input.sigmaNormal);
    if (request.adaptive)
      run.options.adaptive =
          request.adaptive->value * (request.adaptive->suffixed ? input.source->map().voxelSize() : 1);
    run.options.adaptiveScale = input.adaptiveScale;
    made.mesh = contour(*input.source, run.options, &run.contour, monitor);
    addAttributes(input, made.mesh, monitor);
    run.secondsContour = stopwatch.lap();
    run.secondsTotal = run.secondsRead + run.secondsContour;
    noteMesh(input, made.mesh, run);
    run.warnings = inPythonsWords(run.warnings);
    return made;
  });
}

}  // namespace pdc::python
