#include "pdc/study/sweep.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "parallel/stopwatch.h"
#include "parallel/with_threads.h"
#include "pdc/mesh/distance.h"
#include "pdc/mesh/mesh_report.h"
#include "pdc/mesh/minimum_angles.h"
#include "pdc/mesh/roughness.h"
#include "pdc/mesh/self_intersections.h"
#include "pdc/sample/normal_noise.h"
#include "pdc/sample/sampled_source.h"
#include "study/recommend_sigma.h"
#include "study/whole_progress.h"

namespace pdc {
namespace {

/// Parts whose faces turn by less than this about a vertex are flat: half of what counts as a crease elsewhere.
constexpr double kFlatDegrees = 15;

/// |f| / |grad f| at each point, which is its distance from f = 0 to first order.
Buffer<double> distancesToField(const Mesh& mesh, const Field& field, const Monitor& monitor) {
  Buffer<double> result(mesh.positions.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, result.size(), 256), [&](const auto& range) {
    monitor.throwIfStopped();
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      const Vec3d p = mesh.origin + vecCast<double>(mesh.positions[i]);
      double value = 0;
      Vec3d g{};
      field.gradients({&p.x, &p.y, &p.z, 1}, &value, {&g.x, &g.y, &g.z});
      result[i] = std::abs(value) / length(g);
    }
  });
  return result;
}

/// Sets root mean square and maximum of the finite lengths, in voxels; leaves them empty if there are none.
void summarize(const Buffer<double>& lengths, double voxelSize, std::optional<double>& rms,
               std::optional<double>& max) {
  double squares = 0, most = 0, count = 0;
  for (const double d : lengths) {
    if (!std::isfinite(d)) continue;
    squares += d * d;
    most = std::max(most, d);
    count += 1;
  }
  if (count == 0) return;
  rms = std::sqrt(squares / count) / voxelSize;
  max = most / voxelSize;
}

std::array<double, 3> anglePercentiles(const Mesh& mesh) {
  Buffer<float> angles = minimumAngles(mesh);
  std::erase_if(angles, [](float a) { return std::isnan(a); });
  std::array<double, 3> result{};
  if (angles.empty()) return result;
  constexpr std::array kShares{0.01, 0.05, 0.5};
  for (std::size_t i = 0; i < kShares.size(); ++i) {
    const auto at = angles.begin() + static_cast<std::ptrdiff_t>(kShares[i] * static_cast<double>(angles.size() - 1));
    std::nth_element(angles.begin(), at, angles.end());
    result[i] = static_cast<double>(*at);
  }
  return result;
}

/// Fills what a step says beside value, voxel size, time and contour().
void measure(const Mesh& mesh, const std::vector<std::uint8_t>& flat, const SweepTruth& truth, SweepStep& step,
             const Monitor& monitor) {
  step.vertices = mesh.positions.size();
  step.faces = mesh.quads.size() + mesh.triangles.size();
  step.triangles = step.faces + mesh.quads.size();
  if (step.contour.trianglesBefore > 0) step.adaptedMax = step.contour.adaptedDistance / step.voxelSize;
  if (mesh.empty()) return;
  if (truth.field != nullptr) {
    summarize(distancesToField(mesh, *truth.field, monitor), step.voxelSize, step.vertexRms, step.vertexMax);
  } else if (truth.reference != nullptr) {
    summarize(vertexDistances(mesh, *truth.reference, monitor), step.voxelSize, step.vertexRms, step.vertexMax);
  }
  if (!truth.creases.empty())
    summarize(distances(truth.creases, mesh, monitor), step.voxelSize, step.creaseRms, step.creaseMax);
  step.roughness = roughness(mesh, flat) / step.voxelSize;
  step.minimumAngle = anglePercentiles(mesh);
  step.selfIntersections = selfIntersections(mesh, {}, monitor).pairs.size();
  step.eulerNumber = analyze(mesh, monitor).eulerNumber;
}

void checkValues(const std::vector<double>& values) {
  if (values.empty()) throw std::invalid_argument("sweep: no values");
}

/// The options for a lattice, but for what is swept.
ContourOptions optionsFor(const SweepOptions& options, double voxelSize) {
  ContourOptions result = options.contour;
  if (options.adaptive) result.adaptive = *options.adaptive * voxelSize;
  return result;
}

std::string noRecommendation(SweepParameter parameter) {
  return fmt::format("Nothing is recommended: which {} is right depends on what the mesh is for.",
                     namesOf(parameter).key);
}

void set(SweepParameter parameter, double value, double voxelSize, ContourOptions& options) {
  if (parameter == SweepParameter::kSigmaNormal) {
    options.sigmaNormal = value;
  } else if (value > 0) {
    options.adaptive = value * voxelSize;
  } else {
    options.adaptive.reset();
  }
}

/// Over σn or the adaptive distance.
Sweep runSampled(SweepParameter parameter, const HermiteSource& source, const std::vector<double>& values,
                 const SweepOptions& options, const Monitor& monitor) {
  const bool overSigma = parameter == SweepParameter::kSigmaNormal;
  const double voxelSize = source.map().voxelSize();
  const ContourOptions shared = optionsFor(options, voxelSize);
  const bool sameVertices = overSigma && !shared.adaptive;
  // The parts are sampling, a contour and a measurement for each value, the flat vertices and the noise.
  detail::WholeProgress progress(monitor, 2 * values.size() + 1 + (sameVertices ? 1 : 0) + (overSigma ? 1 : 0));
  Sweep sweep{.parameter = parameter};
  detail::Stopwatch sampling;
  const SampledSource sampled(source, progress.beginPart());
  sweep.secondsSample = sampling.lap();
  for (const double value : values) {
    SweepStep step{.value = value, .voxelSize = voxelSize};
    ContourOptions contourOptions = shared;
    set(parameter, value, voxelSize, contourOptions);
    detail::Stopwatch contouring;
    sweep.meshes.push_back(contour(sampled, contourOptions, &step.contour, progress.beginPart()));
    step.seconds = contouring.lap();
    sweep.steps.push_back(step);
  }
  // Roughness is compared over the same vertices where all meshes have them: those that are flat where no normal has a
  // say.
  std::vector<std::uint8_t> flat;
  if (sameVertices)
    flat = flatVertices(
        contour(sampled, {.sigmaNormal = std::numeric_limits<double>::infinity(), .placement = Placement::kCell},
                nullptr, progress.beginPart()),
        kFlatDegrees);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const Mesh& mesh = sweep.meshes[i];
    const Monitor part = progress.beginPart();
    measure(mesh, sameVertices ? flat : flatVertices(mesh, kFlatDegrees), options.truth, sweep.steps[i], part);
  }
  if (overSigma) {
    sweep.normalNoise = normalNoise(sampled, progress.beginPart());
    detail::recommendSigma(sweep);
  } else {
    sweep.reason = noRecommendation(parameter);
  }
  progress.finish();
  return sweep;
}

Sweep runInputs(SweepParameter parameter, const std::vector<double>& values,
                const std::function<SweepInput(double)>& open, const SweepOptions& options, const Monitor& monitor) {
  // The parts of each value are opening, contouring and measuring.
  detail::WholeProgress progress(monitor, 3 * values.size());
  Sweep sweep{.parameter = parameter};
  for (const double value : values) {
    static_cast<void>(progress.beginPart());
    const SweepInput input = open(value);
    SweepStep step{.value = value, .voxelSize = input.source->map().voxelSize()};
    detail::Stopwatch contouring;
    Mesh mesh = contour(*input.source, optionsFor(options, step.voxelSize), &step.contour, progress.beginPart());
    step.seconds = contouring.lap();
    measure(mesh, flatVertices(mesh, kFlatDegrees), input.truth, step, progress.beginPart());
    sweep.steps.push_back(step);
    sweep.meshes.push_back(std::move(mesh));
  }
  sweep.reason = noRecommendation(parameter);
  progress.finish();
  return sweep;
}

}  // namespace

SweepParameterNames namesOf(SweepParameter parameter) {
  switch (parameter) {
    case SweepParameter::kSigmaNormal:
      return {"sigma_n", "σn"};
    case SweepParameter::kIso:
      return {"iso", "isovalue"};
    case SweepParameter::kVoxelSize:
      return {"voxel_size", "voxel size"};
    case SweepParameter::kAdaptive:
      return {"adaptive", "adaptive distance"};
  }
  throw std::invalid_argument("not a parameter of a sweep");
}

Sweep sweepSigma(const HermiteSource& source, const std::vector<double>& sigmas, const SweepOptions& options,
                 const Monitor& monitor) {
  checkValues(sigmas);
  for (const double sigma : sigmas)
    if (!(sigma >= 0)) throw std::invalid_argument(fmt::format("sweepSigma: σn is {}, must be at least 0", sigma));
  return detail::withThreads(options.contour.threads, [&] {
    return runSampled(SweepParameter::kSigmaNormal, source, sigmas, options, monitor);
  });
}

Sweep sweepAdaptive(const HermiteSource& source, const std::vector<double>& distances, const SweepOptions& options,
                    const Monitor& monitor) {
  checkValues(distances);
  for (const double distance : distances)
    if (!(distance >= 0 && std::isfinite(distance)))
      throw std::invalid_argument(
          fmt::format("sweepAdaptive: the distance is {}, must be at least 0 and finite", distance));
  return detail::withThreads(options.contour.threads, [&] {
    return runSampled(SweepParameter::kAdaptive, source, distances, options, monitor);
  });
}

Sweep sweepInputs(SweepParameter parameter, const std::vector<double>& values,
                  const std::function<SweepInput(double)>& open, const SweepOptions& options, const Monitor& monitor) {
  checkValues(values);
  if (parameter == SweepParameter::kSigmaNormal || parameter == SweepParameter::kAdaptive)
    throw std::invalid_argument("sweepInputs: σn and adaptive distances are for sweepSigma() and sweepAdaptive()");
  return detail::withThreads(options.contour.threads,
                             [&] { return runInputs(parameter, values, open, options, monitor); });
}

}  // namespace pdc
