#include "subdivide/limit_masks.h"

#include <cmath>
#include <numbers>

// Each mask is a left eigenvector of the matrix that takes a vertex and its ring to those of the next level: for the
// eigenvalue 1 of places, for the next one of tangents (Halstead, Kass & DeRose 1993; Zorin & Schröder 2000).
namespace pdc::detail {
namespace {

/// Whole turns, in radians.
double turns(double share) { return 2 * std::numbers::pi * share; }

RingMask emptyMask(std::size_t edges, std::size_t faces) {
  return {0, std::vector<double>(edges, 0), std::vector<double>(faces, 0)};
}

}  // namespace

RingMask loopLimit(std::size_t n, double weight) {
  const double each = 1 / (static_cast<double>(n) + 3 / (8 * weight));
  return {1 - static_cast<double>(n) * each, std::vector<double>(n, each)};
}

RingMask catmullClarkLimit(std::size_t count) {
  const auto n = static_cast<double>(count);
  return {n / (n + 5), std::vector<double>(count, 4 / (n * (n + 5))), std::vector<double>(count, 1 / (n * (n + 5)))};
}

TangentMasks loopTangents(std::size_t n) {
  // So that those of regular vertices are derivatives.
  constexpr double kScale = 1.0 / 3;
  TangentMasks masks{emptyMask(n, 0), emptyMask(n, 0)};
  for (std::size_t i = 0; i < n; ++i) {
    const double at = static_cast<double>(i), all = static_cast<double>(n);
    masks.u.edge[i] = kScale * std::cos(turns(at / all));
    masks.v.edge[i] = kScale * std::cos(turns((at - 1) / all));
  }
  return masks;
}

TangentMasks catmullClarkTangents(std::size_t count) {
  constexpr double kScale = 1.0 / 12;
  const auto n = static_cast<double>(count);
  const double c = std::cos(turns(1 / n));
  const double a = 1 + c + std::cos(turns(0.5 / n)) * std::sqrt(2 * (9 + c));
  TangentMasks masks{emptyMask(count, count), emptyMask(count, count)};
  for (std::size_t i = 0; i < count; ++i) {
    const auto wave = [&](double shift) { return kScale * std::cos(turns((static_cast<double>(i) + shift) / n)); };
    masks.u.edge[i] = a * wave(0);
    masks.u.face[i] = wave(0) + wave(1);
    masks.v.edge[i] = a * wave(-1);
    masks.v.face[i] = wave(-1) + wave(0);
  }
  return masks;
}

// Along a lattice direction the box spline's second derivative is the second difference. Edges 0, 1 and 2 lead along u,
// v and v − u.
SecondMasks loopSecond() {
  return {{-2, {1, 0, 0, 1, 0, 0}}, {-1, {0.5, 0.5, -0.5, 0.5, 0.5, -0.5}}, {-2, {0, 1, 0, 0, 1, 0}}};
}

// These are the second derivatives of the bicubic B-spline.
SecondMasks catmullClarkSecond() {
  constexpr double k = 1.0 / 6;
  return {{-8 * k, {4 * k, -2 * k, 4 * k, -2 * k}, {k, k, k, k}},
          {0, {0, 0, 0, 0}, {0.25, -0.25, 0.25, -0.25}},
          {-8 * k, {-2 * k, 4 * k, -2 * k, 4 * k}, {k, k, k, k}}};
}

// Inside a sector the weights across are sin(iπ/k) at edge i. Those of the ends w and of the vertex follow from their
// columns of the matrix,
//   (1/2 − λ) w + (what the inside adds to an end) + vertex/8 = 0,
//   (3/4 − λ) vertex + w + (what the inside adds to the vertex) = 0.
TangentMasks sectorTangents(std::size_t faces, bool triangles) {
  const std::size_t ofFaces = triangles ? 0 : faces;
  TangentMasks masks{emptyMask(faces + 1, ofFaces), emptyMask(faces + 1, ofFaces)};
  masks.u.edge.front() = 1;
  masks.u.edge.back() = -1;
  RingMask& across = masks.v;
  if (faces == 1) {
    // The curve bends into the only face there is.
    across.centre = -2;
    across.edge = {1, 1};
    return masks;
  }
  const auto k = static_cast<double>(faces);
  const double s = std::sin(turns(0.5 / k)), c = std::cos(turns(0.5 / k));
  const double eigenvalue = triangles ? 0.375 + c / 4 : (5 + c + std::sqrt((c + 9) * (c + 1))) / 16;
  const double ofFace = triangles ? 0 : 1 / (16 * eigenvalue - 4);
  double sum = 0;
  for (std::size_t i = 1; i < faces; ++i) sum += across.edge[i] = std::sin(turns(0.5 * static_cast<double>(i) / k));
  for (std::size_t i = 0; i < ofFaces; ++i) across.face[i] = ofFace * (across.edge[i] + across.edge[i + 1]);
  const double toEnd = triangles ? s / 8 : s * (1.0 / 16 + ofFace / 4);
  const double toVertex = sum * (triangles ? 0.375 : 0.375 + ofFace / 2);
  const double end = (8 * toEnd * (0.75 - eigenvalue) - toVertex) / (1 - 8 * (0.75 - eigenvalue) * (0.5 - eigenvalue));
  across.edge.front() = across.edge.back() = end;
  across.centre = -8 * (0.5 - eigenvalue) * end - 8 * toEnd;
  return masks;
}

TangentMasks cornerTangents(std::size_t faces, bool triangles) {
  const std::size_t ofFaces = triangles ? 0 : faces;
  TangentMasks masks{emptyMask(faces + 1, ofFaces), emptyMask(faces + 1, ofFaces)};
  masks.u.centre = masks.v.centre = -1;
  masks.u.edge.front() = 1;
  masks.v.edge.back() = 1;
  return masks;
}

}  // namespace pdc::detail
