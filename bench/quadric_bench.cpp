// Table 1 of Trettner & Kobbelt 2020: building quadrics of planes and triangles, and minimising them, one by one and in
// batches, with Eigen's solvers in the same process. Rates are in operations per second, on one thread.
//
// The second argument of each row is the number of quadrics gone through again and again: 2048 stay in cache, a million
// stream through memory as in the paper.

#include <benchmark/benchmark.h>

#include <Eigen/Dense>
#include <cstddef>
#include <functional>
#include <random>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "pdc/math/quadric_batch.h"
#include "pdc/math/solvers.h"
#include "pdc/math/triangle_quadric.h"

namespace {

using namespace pdc;

constexpr int kInCache = 2048;
constexpr int kInMemory = 1 << 20;

/// The same random inputs one by one and in blocks.
template <typename T>
struct Inputs {
  std::vector<Vec3<T>> p, q, r, n;
  std::vector<SymMat3<T>> Sp, Sq, Sr;
  std::vector<Quadric<T>> quadrics;
  std::vector<PlaneLanes<T>> planes;
  std::vector<TriangleLanes<T>> triangles;
  std::vector<TriangleCovarianceLanes<T>> Sigmas;
  std::vector<SymMat3Lanes<T>> Sigma_n, Sigma_q;
  std::vector<QuadricLanes<T>> systems;

  explicit Inputs(std::size_t count) {
    std::mt19937 engine(1);
    std::uniform_real_distribution<T> uniform(-1, 1);
    const auto point = [&] { return Vec3<T>{uniform(engine), uniform(engine), uniform(engine)}; };
    const auto covariance = [&] { return (outer(point()) + outer(point()) + outer(point())) * T(0.01); };
    const std::size_t blocks = blockCount(count);
    planes.resize(blocks);
    triangles.resize(blocks);
    Sigmas.resize(blocks);
    Sigma_n.resize(blocks);
    Sigma_q.resize(blocks);
    systems.resize(blocks);
    for (std::size_t i = 0; i < count; ++i) {
      for (auto* v : {&p, &q, &r, &n}) v->push_back(point());
      for (auto* m : {&Sp, &Sq, &Sr}) m->push_back(covariance());
      quadrics.push_back(probabilisticTriangleQuadric(p[i], q[i], r[i], T(0.1)));
      const std::size_t block = i / kLanes;
      const int lane = static_cast<int>(i % kLanes);
      planes[block].q.set(lane, q[i]);
      planes[block].n.set(lane, n[i]);
      triangles[block].p.set(lane, p[i]);
      triangles[block].q.set(lane, q[i]);
      triangles[block].r.set(lane, r[i]);
      Sigmas[block].p.set(lane, Sp[i]);
      Sigmas[block].q.set(lane, Sq[i]);
      Sigmas[block].r.set(lane, Sr[i]);
      Sigma_n[block].set(lane, Sp[i]);
      Sigma_q[block].set(lane, Sq[i]);
      systems[block].set(lane, quadrics[i]);
    }
  }

  static const Inputs& of(const benchmark::State& state) {
    static const Inputs inCache(kInCache), inMemory(kInMemory);
    return state.range(0) == kInCache ? inCache : inMemory;
  }
};

template <typename T>
const char* scalarName() {
  return sizeof(T) == sizeof(float) ? "float" : "double";
}

void addRow(const std::string& name, const std::function<void(benchmark::State&)>& run) {
  benchmark::RegisterBenchmark(name.c_str(), run)->Arg(kInCache)->Arg(kInMemory)->MinTime(0.1);
}

/// out[i] = one(inputs, i), where Out is Quadric<T> or NormalEquations<T> and decides whether c is computed.
template <typename Out, typename T, typename One>
void runOneByOne(benchmark::State& state, const One& one) {
  const Inputs<T>& in = Inputs<T>::of(state);
  std::vector<Out> out(static_cast<std::size_t>(state.range(0)));
  for (auto _ : state) {
    for (std::size_t i = 0; i < out.size(); ++i) {
      if constexpr (std::is_same_v<Out, NormalEquations<T>>)
        out[i] = one(in, i).normalEquations();
      else
        out[i] = one(in, i);
    }
    benchmark::DoNotOptimize(out.data());
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

template <typename Out, typename T, typename Batch>
void runBatch(benchmark::State& state, const Batch& batch) {
  const Inputs<T>& in = Inputs<T>::of(state);
  std::vector<Out> out(in.planes.size());
  for (auto _ : state) {
    batch(in, std::span(out));
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

/// The rows of one kind of quadric: with and without c, one by one and in batches.
template <typename T, typename One, typename Batch>
void addQuadricRows(const std::string& kind, const One& one, const Batch& batch) {
  const std::string row = std::string(scalarName<T>()) + "/" + kind;
  addRow(row + "/Ab/one", [one](benchmark::State& s) { runOneByOne<NormalEquations<T>, T>(s, one); });
  addRow(row + "/Ab/batch", [batch](benchmark::State& s) { runBatch<NormalEquationsLanes<T>, T>(s, batch); });
  addRow(row + "/Abc/one", [one](benchmark::State& s) { runOneByOne<Quadric<T>, T>(s, one); });
  addRow(row + "/Abc/batch", [batch](benchmark::State& s) { runBatch<QuadricLanes<T>, T>(s, batch); });
}

template <typename T>
void addPlaneRows() {
  const T sigma = T(0.1);
  addQuadricRows<T>(
      "plane_classical", [](const Inputs<T>& in, std::size_t i) { return planeQuadric(in.q[i], in.n[i]); },
      [](const Inputs<T>& in, auto out) { planeQuadrics(in.planes, out); });
  addQuadricRows<T>(
      "plane_probabilistic",
      [](const Inputs<T>& in, std::size_t i) {
        return probabilisticPlaneQuadric(in.q[i], in.n[i], in.Sp[i], in.Sq[i]);
      },
      [](const Inputs<T>& in, auto out) {
        if constexpr (requires { out[0].c; })
          probabilisticPlaneQuadrics<T>(in.planes, in.Sigma_n, in.Sigma_q, out);
        else
          probabilisticPlaneQuadrics(in.planes, in.Sigma_n, out);
      });
  addQuadricRows<T>(
      "plane_isotropic",
      [sigma](const Inputs<T>& in, std::size_t i) { return probabilisticPlaneQuadric(in.q[i], in.n[i], sigma, sigma); },
      [sigma](const Inputs<T>& in, auto out) { probabilisticPlaneQuadrics(in.planes, sigma, sigma, out); });
}

template <typename T>
void addTriangleRows() {
  const T sigma = T(0.1);
  addQuadricRows<T>(
      "triangle_classical",
      [](const Inputs<T>& in, std::size_t i) { return triangleQuadric(in.p[i], in.q[i], in.r[i]); },
      [](const Inputs<T>& in, auto out) { triangleQuadrics(in.triangles, out); });
  addQuadricRows<T>(
      "triangle_probabilistic",
      [](const Inputs<T>& in, std::size_t i) {
        return probabilisticTriangleQuadric(in.p[i], in.q[i], in.r[i], in.Sp[i], in.Sq[i], in.Sr[i]);
      },
      [](const Inputs<T>& in, auto out) { probabilisticTriangleQuadrics(in.triangles, in.Sigmas, out); });
  addQuadricRows<T>(
      "triangle_isotropic",
      [sigma](const Inputs<T>& in, std::size_t i) {
        return probabilisticTriangleQuadric(in.p[i], in.q[i], in.r[i], sigma);
      },
      [sigma](const Inputs<T>& in, auto out) { probabilisticTriangleQuadrics(in.triangles, sigma, out); });
}

/// x[i] = solve(quadric i).
template <typename T, typename X, typename Solve>
void addSolverRow(const std::string& name, const Solve& solve) {
  addRow(std::string(scalarName<T>()) + "/solve_" + name, [solve](benchmark::State& state) {
    const Inputs<T>& in = Inputs<T>::of(state);
    std::vector<X> x(static_cast<std::size_t>(state.range(0)));
    for (auto _ : state) {
      for (std::size_t i = 0; i < x.size(); ++i) x[i] = solve(in.quadrics[i]);
      benchmark::ClobberMemory();
    }
    state.SetItemsProcessed(state.iterations() * state.range(0));
  });
}

template <typename T>
void addSolverRows() {
  using Matrix = Eigen::Matrix<T, 3, 3>;
  using Vector = Eigen::Matrix<T, 3, 1>;
  const auto matrix = [](const Quadric<T>& f) {
    Matrix A;
    A << f.A.xx, f.A.xy, f.A.xz, f.A.xy, f.A.yy, f.A.yz, f.A.xz, f.A.yz, f.A.zz;
    return A;
  };
  const auto vector = [](const Quadric<T>& f) { return Vector(f.b.x, f.b.y, f.b.z); };
  addSolverRow<T, Vec3<T>>("LDLT/one", [](const Quadric<T>& f) { return solveLdlt(f.A, f.b).value_or(Vec3<T>{}); });
  addRow(std::string(scalarName<T>()) + "/solve_LDLT/batch", [](benchmark::State& s) {
    runBatch<SolutionLanes<T>, T>(s,
                                  [](const Inputs<T>& in, auto out) { solveLdlt<QuadricLanes<T>>(in.systems, out); });
  });
  addSolverRow<T, Vector>("JacobiSVD", [=](const Quadric<T>& f) {
    return Vector(Eigen::JacobiSVD<Matrix>(matrix(f), Eigen::ComputeFullU | Eigen::ComputeFullV).solve(vector(f)));
  });
  addSolverRow<T, Vector>("BDCSVD", [=](const Quadric<T>& f) {
    return Vector(Eigen::BDCSVD<Matrix>(matrix(f), Eigen::ComputeFullU | Eigen::ComputeFullV).solve(vector(f)));
  });
  addSolverRow<T, Vector>("SelfAdjointEigenSolver", [=](const Quadric<T>& f) {
    Eigen::SelfAdjointEigenSolver<Matrix> solver;
    solver.computeDirect(matrix(f));
    const Vector y = solver.eigenvectors().transpose() * vector(f);
    return Vector(solver.eigenvectors() * y.cwiseQuotient(solver.eigenvalues()));
  });
}

}  // namespace

int main(int argc, char** argv) {
  addPlaneRows<float>();
  addTriangleRows<float>();
  addSolverRows<float>();
  addPlaneRows<double>();
  addTriangleRows<double>();
  addSolverRows<double>();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
}
