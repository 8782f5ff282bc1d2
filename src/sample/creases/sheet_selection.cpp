#include "sample/creases/sheet_selection.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "math/lane_loops.h"

namespace pdc::detail {
namespace {

// The constants were chosen with bench/feature_eval: the tuning shapes at 64³, noise 0, 0.02 and 0.1 voxels.

/// A sheet farther than this from where all sheets meet, in voxels, does not meet them.
double mostResidual(double noise) { return 0.1 + 2 * noise; }

/// How far outside a cell, in voxels, sheets may meet that no crossing of it lies on. Without noise the crossings are
/// reliable, and vertices that leave their cells for nothing fold faces.
double margin(double noise) { return std::min(0.5, 5 * noise); }

double largestResidual(std::span<const CreaseSheet> sheets, const Vec3d& y) {
  double largest = 0;
  for (const CreaseSheet& s : sheets) largest = std::max(largest, std::abs(s.value(y)));
  return largest;
}

/// By pair of sheets: true if each lies behind the other, as the sides of a convex edge do.
using Convexity = std::array<std::array<bool, CreaseSheets::kMax>, CreaseSheets::kMax>;
Convexity findConvexity(const CreaseSheets& sheets) {
  Convexity convex{};
  for (int i = 0; i < sheets.count; ++i)
    for (int j = 0; j < i; ++j)
      convex[i][j] = convex[j][i] =
          sheets.sheet[i].value(sheets.sheet[j].center) + sheets.sheet[j].value(sheets.sheet[i].center) < 0;
  return convex;
}

/// Marks the sheets that end the solid along one edge, or the one that comes nearest to its crossing. \param root where
/// the edge meets each of `count` sheets on its way out; infinite where it does not. \param t of the crossing.
void markCrossed(const std::array<double, CreaseSheets::kMax>& root, int count, const Convexity& convex, double t,
                 std::array<bool, CreaseSheets::kMax>& crossed) {
  constexpr double kSlack = 0.05;  // of an edge
  const auto within = [](double r) { return r > -kSlack && r < 1 + kSlack; };
  bool found = false;
  int nearest = 0;
  for (int i = 0; i < count; ++i) {
    bool ends = within(root[i]);
    for (int j = 0; j < count; ++j)
      if (j != i && within(root[j])) ends = ends && (convex[i][j] ? root[i] <= root[j] : root[i] >= root[j]);
    crossed[i] = crossed[i] || ends;
    found = found || ends;
    if (std::abs(root[i] - t) < std::abs(root[nearest] - t)) nearest = i;
  }
  if (!found) crossed[nearest] = true;
}

}  // namespace

float sheetSigma(double noise) { return static_cast<float>(std::max(0.01, 0.7 * noise)); }

SheetSelection::SheetSelection(const Mat3d& M, double noise) : mInverse(inverse(M)), mNoise(noise) {
  for (int i = 0; i < kCorners; ++i) {
    const Vec3d p = M * cornerFromCenter(i);
    mX[i] = p.x;
    mY[i] = p.y;
    mZ[i] = p.z;
  }
}

Vec3d SheetSelection::select(const PatchCrossings& crossings, CreaseSheets& sheets) const {
  keepCrossedOrMeeting(crossings, sheets);
  Vec3d y = meeting(crossings, sheets.all());
  while (sheets.count > 1 && largestResidual(sheets.all(), y) > mostResidual(mNoise)) {
    const auto distance = [&](int i) { return length(sheets.sheet[i].center - crossings.massPoint); };
    int farthest = 0;
    for (int i = 1; i < sheets.count; ++i)
      if (distance(i) > distance(farthest)) farthest = i;
    sheets.drop(farthest);
    y = meeting(crossings, sheets.all());
  }
  return y;
}

Vec3d SheetSelection::meeting(const PatchCrossings& crossings, std::span<const CreaseSheet> sheets) const {
  return meetingPoint(sheets, crossings.massPoint, double{sheetSigma(mNoise)});
}

double SheetSelection::crossingError(const PatchCrossings& crossings, std::span<const CreaseSheet> sheets) const {
  double squares = 0;
  for (int c = 0; c < crossings.count; ++c) {
    const PatchCrossings::Edge& e = crossings.edge[c];
    const auto corner = [&](int i) { return Vec3d{mX[i], mY[i], mZ[i]}; };
    const Vec3d at = corner(e.inside) * (1 - e.t) + corner(e.outside) * e.t;
    double least = std::numeric_limits<double>::infinity();
    for (const CreaseSheet& s : sheets) least = std::min(least, std::abs(s.value(at)));
    squares += least * least;
  }
  return std::sqrt(squares / crossings.count);
}

int SheetSelection::nearest(const PatchCrossings& crossings, std::span<const CreaseSheet> sheets) const {
  int nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < sheets.size(); ++i) {
    const double error = crossingError(crossings, sheets.subspan(i, 1));
    if (error >= least) continue;
    least = error;
    nearest = static_cast<int>(i);
  }
  return nearest;
}

void SheetSelection::keepCrossedOrMeeting(const PatchCrossings& crossings, CreaseSheets& sheets) const {
  if (sheets.count < 2) return;
  Flags crossed = crossedSheets(crossings, sheets);
  const auto moveTo = [&](int to, int i) {
    if (to == i) return;
    std::swap(sheets.sheet[to], sheets.sheet[i]);
    std::swap(crossed[to], crossed[i]);
  };
  int kept = 0;
  for (int i = 0; i < sheets.count; ++i)
    if (crossed[i]) moveTo(kept++, i);
  for (int i = kept; i < sheets.count; ++i) {
    moveTo(kept, i);
    const auto more = sheets.all().first(static_cast<std::size_t>(kept) + 1);
    const Vec3d y = meeting(crossings, more), at = mInverse * y;
    if (largestResidual(more, y) <= mostResidual(mNoise) &&
        std::max({std::abs(at.x), std::abs(at.y), std::abs(at.z)}) <= 0.5 + margin(mNoise))
      ++kept;
  }
  sheets.count = kept;
}

/// Sheets are endless, but of two that lie behind each other, a convex edge, the first that an edge meets on its way
/// out ends the solid; of two before each other the last.
SheetSelection::Flags SheetSelection::crossedSheets(const PatchCrossings& crossings, const CreaseSheets& sheets) const {
  const Convexity convex = findConvexity(sheets);
  std::array<AtCorners, CreaseSheets::kMax> value;
  for (int i = 0; i < sheets.count; ++i) valueAtCorners(sheets.sheet[i], value[i]);
  Flags crossed{};
  for (int c = 0; c < crossings.count; ++c) {
    const PatchCrossings::Edge& edge = crossings.edge[c];
    std::array<double, CreaseSheets::kMax> root{};
    for (int i = 0; i < sheets.count; ++i) {
      const double v0 = value[i][edge.inside], v1 = value[i][edge.outside];
      root[i] = v1 > v0 ? -v0 / (v1 - v0) : std::numeric_limits<double>::infinity();
    }
    markCrossed(root, sheets.count, convex, edge.t, crossed);
  }
  return crossed;
}

void SheetSelection::valueAtCorners(const CreaseSheet& sheet, AtCorners& value) const {
  withSimd(bestSimdLevel(), [&] {
    // Copies on the stack, which no store can change: else the loop is not vectorised.
    const CreaseSheet s = sheet;
    AtCorners v;
    for (int i = 0; i < kCorners; ++i) v[i] = s.value({mX[i], mY[i], mZ[i]});
    value = v;
  });
}

}  // namespace pdc::detail
