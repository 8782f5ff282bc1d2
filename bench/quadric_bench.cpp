// Table 1 of Trettner & Kobbelt 2020 in Markdown: building quadrics of planes and triangles, and minimising them, one
// by one and in batches, beside the authors' header, where it is on the include path, and Eigen's solvers. Rates are in
// millions of operations per second on one thread, and in brackets as multiples of the header's.

#include <array>
#include <cstddef>
#include <cstdio>
#include <deque>
#include <memory>
#include <new>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "authors_quadrics.h"
#include "best_rates.h"
#include "eigen_solvers.h"
#include "pdc/math/quadric_batch.h"
#include "pdc/math/solvers.h"
#include "pdc/math/triangle_quadric.h"
#include "quadric_inputs.h"

namespace {

using namespace pdc;
using bench::Candidate;

constexpr int kRounds = 15;

/// The implementations of one operation; `run` is empty where there is none.
struct Row {
  std::string name;
  Candidate header, one, batch;
};

/// Stops the compiler from leaving out what was written to memory.
inline void clobberMemory() { asm volatile("" ::: "memory"); }

/// The memory that all candidates of a table write to, so that each has the same pages.
class Output {
 public:
  explicit Output(std::size_t bytes) : mMemory(static_cast<std::byte*>(::operator new(bytes, kAlignment))) {}

  template <typename Out>
  Out* of() const {
    return reinterpret_cast<Out*>(mMemory.get());
  }

 private:
  static constexpr std::align_val_t kAlignment{4096};
  struct Free {
    void operator()(std::byte* p) const { ::operator delete(p, kAlignment); }
  };
  std::unique_ptr<std::byte, Free> mMemory;
};

/// Sets out[i] = f(i) for all i.
template <typename Out, typename F>
Candidate loop(const Output& to, std::size_t count, const F& f) {
  return {[out = to.of<Out>(), count, f] {
            for (std::size_t i = 0; i < count; ++i) out[i] = f(i);
            clobberMemory();
          },
          count};
}

/// Calls f with the batches that hold `count` results.
template <typename Out, typename F>
Candidate batch(const Output& to, std::size_t count, const F& f) {
  return {[out = std::span(to.of<Out>(), batchCount(count)), f] {
            f(out);
            clobberMemory();
          },
          count};
}

/// All rows of one scalar and one number of operands.
template <typename T>
class Table {
 public:
  explicit Table(std::size_t count)
      : mCount(count),
        mOut(count * sizeof(Quadric<T>)),
        mIn(count)
#if PDC_BENCH_HAS_AUTHORS_HEADER
        ,
        mAuthors(mIn)
#endif
  {
    addPlanes();
    addTriangles();
    addSolvers();
  }
  Table(const Table&) = delete;
  Table& operator=(const Table&) = delete;

  std::deque<Row>& rows() { return mRows; }

 private:
  /// \param authors takes the header's quadric type and an index. \param one takes an index. \param all takes a span of
  /// batches.
  template <typename Authors, typename One, typename All>
  void addQuadrics(const std::string& name, const Authors& authors, const One& one, const All& all) {
    add<NormalEquations<T>, NormalEquationsLanes<T>>(name + " (A, b)", authors, one, all);
    add<Quadric<T>, QuadricLanes<T>>(name + " (A, b, c)", authors, one, all);
  }

  template <typename Out, typename OutLanes, typename Authors, typename One, typename All>
  void add(const std::string& name, const Authors& authors, const One& one, const All& all) {
    Row& row = mRows.emplace_back();
    row.name = name;
    row.batch = batch<OutLanes>(mOut, mCount, all);
    row.one = loop<Out>(mOut, mCount, [one](std::size_t i) -> Out {
      if constexpr (std::is_same_v<Out, NormalEquations<T>>)
        return one(i).normalEquations();
      else
        return one(i);
    });
#if PDC_BENCH_HAS_AUTHORS_HEADER
    using Kept = bench::AuthorsOutput<Out, T>;
    row.header = loop<typename Kept::Type>(
        mOut, mCount, [authors, in = &mAuthors](std::size_t i) { return Kept::of(authors(*in, i)); });
#else
    static_cast<void>(authors);
#endif
  }

  void addPlanes() {
    const T sigma = T(0.1);
    const Vec3<T>*q = mIn.q.data(), *n = mIn.n.data();
    const SymMat3<T>*Sn = mIn.Sp.data(), *Sq = mIn.Sq.data();
    addQuadrics(
        "plane, classical",
        [](const auto& in, auto i) { return std::decay_t<decltype(in)>::Quadric::plane_quadric(in.q[i], in.n[i]); },
        [=](std::size_t i) { return planeQuadric(q[i], n[i]); }, [this](auto out) { planeQuadrics(mIn.planes, out); });
    addQuadrics(
        "plane, probabilistic",
        [](const auto& in, auto i) {
          return std::decay_t<decltype(in)>::Quadric::probabilistic_plane_quadric(in.q[i], in.n[i], in.Sq[i], in.Sp[i]);
        },
        [=](std::size_t i) { return probabilisticPlaneQuadric(q[i], n[i], Sn[i], Sq[i]); },
        [this](auto out) {
          if constexpr (requires { out[0].c; })
            probabilisticPlaneQuadrics<T>(mIn.planes, mIn.Sigma_n, mIn.Sigma_q, out);
          else
            probabilisticPlaneQuadrics(mIn.planes, mIn.Sigma_n, out);
        });
    addQuadrics(
        "plane, probabilistic, isotropic",
        [sigma](const auto& in, auto i) {
          return std::decay_t<decltype(in)>::Quadric::probabilistic_plane_quadric(in.q[i], in.n[i], sigma, sigma);
        },
        [=](std::size_t i) { return probabilisticPlaneQuadric(q[i], n[i], sigma, sigma); },
        [=, this](auto out) { probabilisticPlaneQuadrics(mIn.planes, sigma, sigma, out); });
  }

  void addTriangles() {
    const T sigma = T(0.1);
    const Vec3<T>*p = mIn.p.data(), *q = mIn.q.data(), *r = mIn.r.data();
    const SymMat3<T>*Sp = mIn.Sp.data(), *Sq = mIn.Sq.data(), *Sr = mIn.Sr.data();
    addQuadrics(
        "triangle, classical",
        [](const auto& in, auto i) {
          return std::decay_t<decltype(in)>::Quadric::triangle_quadric(in.p[i], in.q[i], in.r[i]);
        },
        [=](std::size_t i) { return triangleQuadric(p[i], q[i], r[i]); },
        [this](auto out) { triangleQuadrics(mIn.triangles, out); });
    addQuadrics(
        "triangle, probabilistic",
        [](const auto& in, auto i) {
          return std::decay_t<decltype(in)>::Quadric::probabilistic_triangle_quadric(in.p[i], in.q[i], in.r[i],
                                                                                     in.Sp[i], in.Sq[i], in.Sr[i]);
        },
        [=](std::size_t i) { return probabilisticTriangleQuadric(p[i], q[i], r[i], Sp[i], Sq[i], Sr[i]); },
        [this](auto out) { probabilisticTriangleQuadrics(mIn.triangles, mIn.Sigmas, out); });
    addQuadrics(
        "triangle, probabilistic, isotropic",
        [sigma](const auto& in, auto i) {
          return std::decay_t<decltype(in)>::Quadric::probabilistic_triangle_quadric(in.p[i], in.q[i], in.r[i], sigma);
        },
        [=](std::size_t i) { return probabilisticTriangleQuadric(p[i], q[i], r[i], sigma); },
        [=, this](auto out) { probabilisticTriangleQuadrics(mIn.triangles, sigma, out); });
  }

  void addSolvers() {
    const Quadric<T>* f = mIn.quadrics.data();
    Row& ldlt = mRows.emplace_back();
    ldlt.name = "A⁻¹b by LDLᵀ";
    ldlt.one =
        loop<Vec3<T>>(mOut, mCount, [f](std::size_t i) { return solveLdlt(f[i].A, f[i].b).value_or(Vec3<T>{}); });
    ldlt.batch =
        batch<SolutionLanes<T>>(mOut, mCount, [this](auto out) { solveLdlt<QuadricLanes<T>>(mIn.systems, out); });
#if PDC_BENCH_HAS_AUTHORS_HEADER
    ldlt.header = loop<typename bench::AuthorsInputs<T>::Pos>(
        mOut, mCount, [g = mAuthors.quadrics.data()](std::size_t i) { return g[i].minimizer(); });
#endif
    addEigen();
  }

  /// A few quadrics will do, because computing takes the time and not memory.
  void addEigen() {
    constexpr std::size_t kCount = 256;
    const Quadric<T>* f = mIn.quadrics.data();
    const auto addSolver = [&](const char* name, Vec3<T> (*solve)(const Quadric<T>&)) {
      Row& row = mRows.emplace_back();
      row.name = name;
      row.one = loop<Vec3<T>>(mOut, kCount, [=](std::size_t i) { return solve(f[i]); });
    };
    addSolver("Eigen JacobiSVD", bench::solveJacobiSvd<T>);
    addSolver("Eigen BDCSVD", bench::solveBdcSvd<T>);
    addSolver("Eigen SelfAdjointEigenSolver, direct", bench::solveEigenDirect<T>);
  }

  std::size_t mCount;
  Output mOut;
  bench::QuadricInputs<T> mIn;
#if PDC_BENCH_HAS_AUTHORS_HEADER
  bench::AuthorsInputs<T> mAuthors;
#endif
  std::deque<Row> mRows;
};

std::string cell(const Candidate& c, const Candidate& header) {
  if (c.rate == 0) return " |";
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), c.rate < 1e8 ? " %.1f" : " %.0f", c.rate / 1e6);
  std::string s = text.data();
  if (&c != &header && header.rate > 0) {
    const double ratio = c.rate / header.rate;
    std::snprintf(text.data(), text.size(), ratio < 2 ? " (%.2f)" : " (%.1f)", ratio);
    s += text.data();
  }
  return s + " |";
}

/// Measures and prints one table. Rows whose names do not contain `filter` are left out.
void printTable(std::size_t count, std::string_view filter) {
  Table<float> single(count);
  Table<double> twice(count);
  std::vector<std::array<Row*, 2>> rows;
  std::vector<Candidate*> candidates;
  for (std::size_t i = 0; i < single.rows().size(); ++i) {
    const std::array<Row*, 2> row{&single.rows()[i], &twice.rows()[i]};
    if (row[0]->name.find(filter) == std::string::npos) continue;
    rows.push_back(row);
    for (Row* r : row)
      for (Candidate* c : {&r->header, &r->one, &r->batch})
        if (c->run) candidates.push_back(c);
  }
  bench::runRounds(candidates, kRounds);
  std::printf(
      "\n%zu operands\n\n| operation | float: header | one | batch | double: header | one | batch |\n"
      "|---|---|---|---|---|---|---|\n",
      count);
  for (const auto& row : rows) {
    std::printf("| %s |", row[0]->name.c_str());
    for (const Row* r : row)
      for (const Candidate* c : {&r->header, &r->one, &r->batch}) std::fputs(cell(*c, r->header).c_str(), stdout);
    std::puts("");
  }
}

}  // namespace

/// \param argv optionally a part of the names of the rows wanted.
int main(int argc, char** argv) {
  const std::string_view filter = argc > 1 ? argv[1] : "";
  // One table stays in the second-level cache, one goes through memory as in the paper.
  for (const std::size_t count : {2048U, 1U << 20}) printTable(count, filter);
}
