#include "study/sweep_columns.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <stdexcept>

namespace pdc::detail {
namespace {

using Value = std::optional<double>;

double count(std::size_t n) { return static_cast<double>(n); }

constexpr std::array kColumns{
    SweepColumn{"voxel_size", "voxel size, world units", [](const SweepStep& s) -> Value { return s.voxelSize; }},
    SweepColumn{"vertices", "vertices", [](const SweepStep& s) -> Value { return count(s.vertices); }},
    SweepColumn{"faces", "faces", [](const SweepStep& s) -> Value { return count(s.faces); }},
    SweepColumn{"triangles", "triangles, quads as two", [](const SweepStep& s) -> Value { return count(s.triangles); }},
    SweepColumn{"adapted_max", "to and from the full mesh, largest at vertices, voxels",
                [](const SweepStep& s) { return s.adaptedMax; }},
    SweepColumn{"vertex_rms", "vertex to surface, RMS, voxels", [](const SweepStep& s) { return s.vertexRms; }},
    SweepColumn{"vertex_max", "vertex to surface, maximum, voxels", [](const SweepStep& s) { return s.vertexMax; }},
    SweepColumn{"crease_rms", "true crease to mesh, RMS, voxels", [](const SweepStep& s) { return s.creaseRms; }},
    SweepColumn{"crease_max", "true crease to mesh, maximum, voxels", [](const SweepStep& s) { return s.creaseMax; }},
    SweepColumn{"roughness", "roughness of flat parts, voxels",
                [](const SweepStep& s) -> Value { return s.roughness; }},
    SweepColumn{"out_of_cell", "minimisers out of their cell",
                [](const SweepStep& s) -> Value { return count(s.contour.outOfCell); }},
    SweepColumn{
        "moved", "moved vertices",
        [](const SweepStep& s) -> Value { return count(s.contour.clamped + s.contour.shortened + s.contour.drawnIn); }},
    SweepColumn{"min_angle_p1", "smallest angle, percentile 1, degrees",
                [](const SweepStep& s) -> Value { return s.minimumAngle[0]; }},
    SweepColumn{"min_angle_p5", "smallest angle, percentile 5, degrees",
                [](const SweepStep& s) -> Value { return s.minimumAngle[1]; }},
    SweepColumn{"min_angle_p50", "smallest angle, median, degrees",
                [](const SweepStep& s) -> Value { return s.minimumAngle[2]; }},
    SweepColumn{"self_intersections", "self-intersections",
                [](const SweepStep& s) -> Value { return count(s.selfIntersections); }},
    SweepColumn{"euler_number", "Euler number",
                [](const SweepStep& s) -> Value { return static_cast<double>(s.eulerNumber); }},
    SweepColumn{"seconds", "contouring, seconds", [](const SweepStep& s) -> Value { return s.seconds; }},
};

}  // namespace

std::span<const SweepColumn> sweepColumns() { return kColumns; }

const SweepColumn& sweepColumn(const std::string& key) {
  for (const SweepColumn& column : kColumns)
    if (column.key == key) return column;
  throw std::invalid_argument("no column " + key);
}

std::string sweepNumber(double value) { return fmt::format("{:.6g}", value); }

}  // namespace pdc::detail
