#pragma once

#include <algorithm>
#include <map>
#include <vector>

#include "extract/certify/uncertified_mesh.h"
#include "extract/conflicts/conflict.h"
#include "mesh/triangle_pair.h"

namespace pdc::detail {

/// All faces of a mesh, and what NearFaces and VertexTrial should find, in the plainest way: every pair of triangles.
class BruteForce {
 public:
  explicit BruteForce(const UncertifiedMesh& input) : mInput(input), mPositions(input.mesh.positions) {
    for (const EdgeRef& e : input.edges()) mFaces.push_back({e, input.triangles(e)});
  }

  /// The conflicts of these faces, sorted. \param active sorted.
  [[nodiscard]] std::vector<Conflict> conflicts(const std::vector<EdgeRef>& active) const {
    std::vector<Conflict> found;
    for (const Face& face : mFaces) {
      if (!std::binary_search(active.begin(), active.end(), face.edge)) continue;
      if (addOwnConflicts(face, found)) addConflictsWithOthers(face, active, found);
    }
    std::sort(found.begin(), found.end());
    return found;
  }

  /// How many conflicts the faces of a vertex have if it is elsewhere. A face that has a triangle facing backwards
  /// counts as one conflict, and whatever else such triangles meet may count or not: that is the difference between the
  /// two.
  struct Count {
    std::size_t least = 0, most = 0;
  };
  [[nodiscard]] Count countConflicts(std::uint32_t vertex, const Vec3f& place) {
    const Vec3f before = std::exchange(mPositions[vertex], place);
    const Count count = countConflictsOf(vertex);
    mPositions[vertex] = before;
    return count;
  }

 private:
  struct Face {
    EdgeRef edge;
    std::vector<Triangle> triangles;
  };
  /// A quad, or a triangle of a fan, that has the vertex.
  struct Piece {
    const Face* face;
    std::vector<Triangle> triangles;
    bool forward = true;
  };

  [[nodiscard]] TriangleCorners corners(const Triangle& t) const {
    return {mPositions[t[0]], mPositions[t[1]], mPositions[t[2]]};
  }
  [[nodiscard]] bool forward(const EdgeRef& e, const Triangle& t) const {
    return mInput.working.faces().facesForward(e, t, corners(t));
  }
  [[nodiscard]] bool meet(const Triangle& a, const Triangle& b) const {
    return trianglesIntersect(corners(a), a, corners(b), b);
  }
  [[nodiscard]] std::size_t countPairs(const std::vector<Triangle>& a, const std::vector<Triangle>& b) const {
    std::size_t count = 0;
    for (const Triangle& s : a)
      for (const Triangle& t : b) count += meet(s, t);
    return count;
  }

  /// \returns false if a triangle faces backwards, after which nothing else of the face is looked at.
  bool addOwnConflicts(const Face& face, std::vector<Conflict>& found) const {
    for (std::size_t i = 0; i < face.triangles.size(); ++i) {
      const Triangle& t = face.triangles[i];
      if (!forward(face.edge, t)) {
        found.push_back({face.edge, face.edge, t, t});
        return false;
      }
      for (std::size_t j = 0; j < i; ++j)
        if (meet(t, face.triangles[j])) found.push_back({face.edge, face.edge, face.triangles[j], t});
    }
    return true;
  }
  void addConflictsWithOthers(const Face& face, const std::vector<EdgeRef>& active,
                              std::vector<Conflict>& found) const {
    for (const Face& other : mFaces) {
      // A pair of active faces counts for the first of the two.
      const bool counted = other.edge < face.edge && std::binary_search(active.begin(), active.end(), other.edge);
      if (other.edge == face.edge || counted) continue;
      for (const Triangle& s : face.triangles)
        for (const Triangle& t : other.triangles)
          if (meet(s, t)) found.push_back({face.edge, other.edge, s, t});
    }
  }

  [[nodiscard]] Count countConflictsOf(std::uint32_t vertex) const {
    const auto has = [&](const Triangle& t) { return std::find(t.begin(), t.end(), vertex) != t.end(); };
    std::vector<Piece> own;
    std::vector<Triangle> fixed;
    for (const Face& face : mFaces) {
      const bool isQuad = mInput.working.faces().quad(mInput.working.edgeCells().face(face.edge)) != nullptr;
      const bool any = std::any_of(face.triangles.begin(), face.triangles.end(), has);
      if (isQuad && any) {
        own.push_back({&face, face.triangles});
      } else {
        for (const Triangle& t : face.triangles)
          if (has(t))
            own.push_back({&face, {t}});
          else
            fixed.push_back(t);
      }
    }
    for (Piece& p : own)
      p.forward = std::all_of(p.triangles.begin(), p.triangles.end(),
                              [&](const Triangle& t) { return forward(p.face->edge, t); });
    Count count;
    for (std::size_t i = 0; i < own.size(); ++i) {
      const Piece& p = own[i];
      if (p.forward) {
        count.least += p.triangles.size() == 2 && meet(p.triangles[0], p.triangles[1]);
        count.least += countPairs(p.triangles, fixed);
      } else {
        ++count.least;
      }
      for (std::size_t j = 0; j < i; ++j) {
        const std::size_t pairs = countPairs(p.triangles, own[j].triangles);
        if (p.forward && own[j].forward)
          count.least += pairs;
        else if (p.forward || own[j].forward)
          count.most += pairs;
      }
    }
    count.most += count.least;
    return count;
  }

  const UncertifiedMesh& mInput;
  Buffer<Vec3f> mPositions;
  std::vector<Face> mFaces;
};

}  // namespace pdc::detail
