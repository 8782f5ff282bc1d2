#include "simplify/decimation/new_intersections.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

#include "mesh/faces.h"
#include "mesh/mesh_checks.h"
#include "mesh/triangle_pair.h"
#include "parallel/for_each_in_parallel.h"
#include "parallel/gather.h"

namespace pdc::detail {
namespace {

/// So many collapses are one piece of a parallel loop.
constexpr std::size_t kGrain = 32;

/// Whether other triangles can be asked whether they intersect it.
bool hasArea(const TriangleCorners& corners) {
  return std::all_of(corners.begin(), corners.end(), isFinite) && !isDegenerate(corners);
}

Mesh writtenMesh(const DecimatedSurface& surface) {
  Mesh mesh;
  mesh.positions.resize(surface.positions.size());
  forEachInParallel(mesh.positions.size(), 4096, [&](std::size_t v) {
    mesh.positions[v] = surface.written(static_cast<std::uint32_t>(v), surface.positions[v]);
  });
  mesh.triangles = surface.faces;
  return mesh;
}

Buffer<std::uint32_t> trianglesWithArea(const Mesh& mesh) {
  Buffer<std::uint32_t> numbers;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    if (hasArea(corners(mesh, mesh.triangles[t]))) numbers.push_back(t);
  return numbers;
}

/// All pairs both ways round, sorted.
FacePairs bothWays(FacePairs pairs) {
  const std::size_t size = pairs.size();
  for (std::size_t i = 0; i < size; ++i) pairs.push_back({pairs[i][1], pairs[i][0]});
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

/// A face as a collapse makes it.
struct NewFace {
  std::uint32_t number;
  Triangle vertices;
  TriangleCorners corners;
  BoxF box;
};

bool meet(const NewFace& f, const Triangle& vertices, const TriangleCorners& corners, const BoxF& box) {
  return f.box.meets(box) && trianglesIntersect(f.corners, f.vertices, corners, vertices);
}

bool meet(const NewFace& f, const NewFace& g) { return meet(f, g.vertices, g.corners, g.box); }

}  // namespace

/// What a collapse does to the faces at the edge's ends.
struct NewIntersections::Change {
  std::vector<std::uint32_t> before;  ///< Their numbers.
  std::vector<NewFace> after;         ///< Those that do not vanish and have an area then.
  BoxF box = BoxF::empty();           ///< Around them.
};

/// The new faces of several changes, to be asked which of different changes intersect.
class NewIntersections::NewFaces {
 public:
  /// \param included the changes that count.
  NewFaces(const std::vector<Change>& changes, const std::vector<std::uint32_t>& included)
      : mChanges(changes), mSoup(soupOf(changes, included)), mTree(mSoup, numbersOf(mSoup)) {}

  /// Calls visit(other) for changes, later ones, that have a face that intersects one of this.
  template <typename Visit>
  void visitIntersecting(std::uint32_t change, const Visit& visit) const {
    mTree.visitMeeting(mChanges[change].box, [&](std::uint32_t t) {
      const std::uint32_t other = mOwner[t][0];
      if (other <= change) return;
      const NewFace& g = mChanges[other].after[mOwner[t][1]];
      const auto& faces = mChanges[change].after;
      if (std::any_of(faces.begin(), faces.end(), [&](const NewFace& f) { return meet(f, g); })) visit(other);
    });
  }

 private:
  Mesh soupOf(const std::vector<Change>& changes, const std::vector<std::uint32_t>& included) {
    Mesh soup;
    for (const std::uint32_t c : included)
      for (std::uint32_t i = 0; i < changes[c].after.size(); ++i) {
        const auto first = static_cast<std::uint32_t>(soup.positions.size());
        for (const Vec3f& p : changes[c].after[i].corners) soup.positions.push_back(p);
        soup.triangles.push_back({first, first + 1, first + 2});
        mOwner.push_back({c, i});
      }
    return soup;
  }
  static Buffer<std::uint32_t> numbersOf(const Mesh& soup) {
    Buffer<std::uint32_t> numbers(soup.triangles.size());
    std::iota(numbers.begin(), numbers.end(), 0U);
    return numbers;
  }

  const std::vector<Change>& mChanges;
  std::vector<std::array<std::uint32_t, 2>> mOwner;  ///< By triangle, the change and which of its faces it is.
  const Mesh mSoup;
  const TriangleTree mTree;
};

NewIntersections::NewIntersections(const DecimatedSurface& surface, const Monitor& monitor)
    : mSurface(surface),
      mMesh(writtenMesh(surface)),
      mGiven(surface.faces.size()),
      mChanging(surface.faces.size(), 0),
      mForest(mMesh, mMesh.triangles.size(), trianglesWithArea(mMesh)),
      mMet(bothWays(intersectingFaces(surface, surface.positions, surface.faces, monitor))) {
  std::iota(mGiven.begin(), mGiven.end(), 0U);
}

std::vector<ChosenCollapse> NewIntersections::takeOut(const VertexStars& stars, std::vector<ChosenCollapse>& collapses,
                                                      const Monitor& monitor) {
  const std::vector<Change> changes = changesOf(stars, collapses);
  ++mSearches;
  for (const Change& c : changes)
    for (const std::uint32_t f : c.before) mChanging[f] = mSearches;
  std::vector<Answer> answers(changes.size());
  forEachInParallel(changes.size(), kGrain, [&](std::size_t i) {
    if (!monitor.stopped()) answers[i] = answerTo(changes[i]);
  });
  monitor.throwIfStopped();
  std::vector<std::uint32_t> possible;
  for (std::uint32_t i = 0; i < changes.size(); ++i)
    if (answers[i] == Answer::kPossible) possible.push_back(i);
  const NewFaces faces(changes, possible);
  const auto pairs = gather<std::array<std::uint32_t, 2>>(possible.size(), [&](std::size_t i, auto& out) {
    faces.visitIntersecting(possible[i], [&](std::uint32_t other) {
      if (!haveMet(changes[possible[i]], changes[other])) out.push_back({possible[i], other});
    });
  });
  // Their order is that of the first of each.
  for (const auto& [i, later] : pairs)
    if (answers[i] == Answer::kPossible) answers[later] = Answer::kWaits;
  std::vector<ChosenCollapse> kept, impossible;
  for (std::size_t i = 0; i < collapses.size(); ++i) {
    if (answers[i] == Answer::kPossible) kept.push_back(collapses[i]);
    if (answers[i] == Answer::kImpossible) impossible.push_back(collapses[i]);
  }
  collapses.swap(kept);
  return impossible;
}

void NewIntersections::accept(const VertexStars& stars, const std::vector<ChosenCollapse>& collapses) {
  const std::vector<Change> changes = changesOf(stars, collapses);
  Buffer<std::uint32_t> changed;
  for (std::size_t i = 0; i < changes.size(); ++i) {
    const auto& [a, b, to] = collapses[i];
    for (const std::uint32_t f : changes[i].before) mForest.remove(f);
    for (const NewFace& f : changes[i].after) {
      mMesh.triangles[f.number] = f.vertices;
      changed.push_back(f.number);
    }
    mMesh.positions[a] = mSurface.written(a, to.place);
    // Any pair of one of them that has met is looked for again.
    for (const std::uint32_t f : changes[i].before) mChanging[f] = mSearches + 1;
  }
  ++mSearches;
  mForest.add(changed);
  if (!mMet.empty()) replaceMet(changed);
}

/// Finds anew which faces intersect those that have changed.
void NewIntersections::replaceMet(const Buffer<std::uint32_t>& changed) {
  const auto isOld = [&](const auto& pair) {
    return mChanging[pair[0]] == mSearches || mChanging[pair[1]] == mSearches;
  };
  mMet.erase(std::remove_if(mMet.begin(), mMet.end(), isOld), mMet.end());
  const FacePairs found = gather<std::array<std::uint32_t, 2>>(changed.size(), [&](std::size_t i, auto& out) {
    const std::uint32_t f = changed[i];
    mForest.visitMeeting(boxOf(corners(mMesh, mMesh.triangles[f])), [&](std::uint32_t g) {
      if (g == f || !intersect(f, g)) return;
      out.push_back({f, g});
      out.push_back({g, f});
    });
  });
  mMet.insert(mMet.end(), found.begin(), found.end());
  std::sort(mMet.begin(), mMet.end());
  mMet.erase(std::unique(mMet.begin(), mMet.end()), mMet.end());
}

bool NewIntersections::intersect(std::uint32_t face, std::uint32_t other) const {
  const Triangle &f = mMesh.triangles[face], &g = mMesh.triangles[other];
  return trianglesIntersect(corners(mMesh, f), f, corners(mMesh, g), g);
}

NewIntersections::Change NewIntersections::changeOf(const VertexStars& stars, const ChosenCollapse& collapse) const {
  const auto& [a, b, to] = collapse;
  const Vec3f place = mSurface.written(a, to.place);
  Change change;
  const auto visit = [&](const StarCorner& c) {
    const std::uint32_t number = mGiven[c.face];
    change.before.push_back(number);
    if (c.next == b || c.previous == b) return;
    const TriangleCorners corners{place, mMesh.positions[c.next], mMesh.positions[c.previous]};
    if (!hasArea(corners)) return;
    change.after.push_back({number, {a, c.next, c.previous}, corners, boxOf(corners)});
    change.box.include(change.after.back().box);
  };
  for (const StarCorner& c : stars[a]) visit(c);
  for (const StarCorner& c : stars[b])
    if (c.next != a && c.previous != a) visit(c);
  return change;
}

std::vector<NewIntersections::Change> NewIntersections::changesOf(const VertexStars& stars,
                                                                  const std::vector<ChosenCollapse>& all) const {
  std::vector<Change> changes(all.size());
  forEachInParallel(all.size(), kGrain, [&](std::size_t i) { changes[i] = changeOf(stars, all[i]); });
  return changes;
}

/// Whether the new faces of a change are possible beside the faces there are.
NewIntersections::Answer NewIntersections::answerTo(const Change& change) const {
  const auto& [before, after, box] = change;
  for (std::size_t i = 0; i < after.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (meet(after[i], after[j]) && !haveMet(change, change)) return Answer::kImpossible;
  Answer answer = Answer::kPossible;
  mForest.visitMeeting(box, [&](std::uint32_t g) {
    if (answer == Answer::kImpossible || std::find(before.begin(), before.end(), g) != before.end()) return;
    const Triangle& vertices = mMesh.triangles[g];
    const TriangleCorners places = corners(mMesh, vertices);
    const BoxF around = boxOf(places);
    const auto meetsIt = [&](const NewFace& f) { return meet(f, vertices, places, around); };
    if (!around.meets(box) || std::none_of(after.begin(), after.end(), meetsIt) || haveMet(change, g)) return;
    answer = mChanging[g] == mSearches ? Answer::kWaits : Answer::kImpossible;
  });
  return answer;
}

/// Whether a face intersects one of those that a change begins with.
bool NewIntersections::haveMet(const Change& change, std::uint32_t face) const {
  if (mMet.empty()) return false;
  return std::any_of(change.before.begin(), change.before.end(), [&](std::uint32_t f) {
    return std::binary_search(mMet.begin(), mMet.end(), std::array{f, face});
  });
}

bool NewIntersections::haveMet(const Change& a, const Change& b) const {
  return std::any_of(b.before.begin(), b.before.end(), [&](std::uint32_t f) { return haveMet(a, f); });
}

}  // namespace pdc::detail
