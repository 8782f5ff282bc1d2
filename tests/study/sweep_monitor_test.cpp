// What a sweep's monitor hears, and that its stop flag ends the sweep within a block's time in whatever it does.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <string>
#include <vector>

#include "pdc/field/function_field.h"
#include "pdc/sample/implicit/field_source.h"
#include "pdc/sample/sampled_source.h"
#include "pdc/study/sweep.h"
#include "sample/creases/noisy_part.h"
#include "sample/watched_source.h"

namespace pdc {
namespace {

constexpr int kThreads = 2;
/// Batches of work that may be under way when the flag is set.
constexpr std::size_t kUnderWay = 2 * kThreads;

FieldSource part() { return {test::drilledBox(), {.box = test::kDrilledBoxBounds, .voxelSize = 0.025}}; }

SweepOptions withThreads(SweepTruth truth = {}) {
  return {.contour = {.threads = kThreads}, .truth = std::move(truth)};
}

/// The function of the part as a truth; calls `watch` each time that its gradient is asked for.
SweepTruth watchedTruth(std::function<void()> watch) {
  const FieldPtr field = test::drilledBox();
  return {.field = functionField({.value = [field](const Vec3d& p) { return field->valueAt(p); },
                                  .gradient =
                                      [field, watch = std::move(watch)](const Vec3d& p) {
                                        watch();
                                        return field->gradientAt(p);
                                      }})};
}

/// Counts calls, and sets a flag at the one with number `at`, counted from 1.
struct Trigger {
  std::size_t at = 0;
  std::atomic<std::size_t> calls = 0;
  std::atomic<bool> stop = false;

  explicit Trigger(std::size_t number) : at(number) {}
  void operator()() {
    if (++calls == at) stop = true;
  }
  [[nodiscard]] std::size_t after() const { return calls - std::min(calls.load(), at); }
};

void expectInOrderToTheEnd(const std::vector<double>& shares) {
  ASSERT_GT(shares.size(), 100u);
  EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
  EXPECT_GE(shares.front(), 0);
  EXPECT_EQ(shares.back(), 1);
}

TEST(SweepMonitor, ProgressOfSigmasNeverFallsAndEndsAtOne) {
  std::vector<double> shares;
  const Monitor monitor{.progress = [&](const char*, double share) { shares.push_back(share); }};
  const Sweep sweep = sweepSigma(part(), {0, 0.1}, withThreads(), monitor);
  EXPECT_EQ(sweep.steps.size(), 2u);
  expectInOrderToTheEnd(shares);
}

TEST(SweepMonitor, ProgressOfInputsNeverFallsAndEndsAtOne) {
  std::vector<double> shares;
  const Monitor monitor{.progress = [&](const char*, double share) { shares.push_back(share); }};
  const auto open = [](double) { return SweepInput{std::make_unique<FieldSource>(part()), {}}; };
  const Sweep sweep = sweepInputs(SweepParameter::kIso, {0, 1}, open, withThreads(), monitor);
  EXPECT_EQ(sweep.steps.size(), 2u);
  expectInOrderToTheEnd(shares);
}

TEST(SweepMonitor, StopEndsTheContourThatFindsFlatVertices) {
  const FieldSource source = part();
  const std::size_t blocks = source.surfaceBlocks({}).coords.size();
  ASSERT_GT(blocks, 400u);
  // Kept crossings are not asked for again, planes are: one contour, then that one.
  Trigger trigger(blocks + 1);
  const test::WatchedSource watched(source, {.planes = std::ref(trigger)});
  const Monitor monitor{.stop = &trigger.stop};
  EXPECT_THROW(static_cast<void>(sweepSigma(watched, {0.1}, withThreads(), monitor)), Cancelled);
  ASSERT_GE(trigger.calls, trigger.at);
  EXPECT_LT(trigger.after(), blocks / 4);
}

TEST(SweepMonitor, StopEndsTheDistancesToTheField) {
  constexpr std::size_t kBatch = 256;
  Trigger trigger(1000);
  const FieldSource source = part();
  const Monitor monitor{.stop = &trigger.stop};
  EXPECT_THROW(static_cast<void>(sweepSigma(source, {0.1}, withThreads(watchedTruth(std::ref(trigger))), monitor)),
               Cancelled);
  ASSERT_GE(trigger.calls, trigger.at);
  EXPECT_LE(trigger.after(), kUnderWay * kBatch);
}

/// Sets the flag at the first report of a stage, and counts its reports; says whether another stage was heard after it.
struct StageWatch {
  std::string stage;
  Trigger trigger{1};
  bool others = false;

  [[nodiscard]] Monitor monitor() {
    return {.progress =
                [this](const char* heard, double) {
                  others |= trigger.stop && stage != heard;
                  if (stage == heard) trigger();
                },
            .stop = &trigger.stop};
  }
};

TEST(SweepMonitor, StopEndsTheDistancesToAMesh) {
  const FieldSource source = part();
  const SweepTruth truth{.reference = std::make_shared<Mesh>(contour(source))};
  StageWatch watch{.stage = "measuring"};
  EXPECT_THROW(static_cast<void>(sweepSigma(source, {0.1}, withThreads(truth), watch.monitor())), Cancelled);
  EXPECT_GE(watch.trigger.calls, 1u);
  EXPECT_LE(watch.trigger.after(), kUnderWay);
  EXPECT_FALSE(watch.others);
}

TEST(SweepMonitor, StopEndsTheSearchForSelfIntersections) {
  StageWatch watch{.stage = "intersecting"};
  EXPECT_THROW(static_cast<void>(sweepSigma(part(), {0.1}, withThreads(), watch.monitor())), Cancelled);
  EXPECT_GE(watch.trigger.calls, 1u);
  EXPECT_LE(watch.trigger.after(), kUnderWay);
  EXPECT_FALSE(watch.others);
}

TEST(SweepMonitor, StopInTheLastMeasurementOfInputsEndsThem) {
  Trigger trigger(1);
  const auto open = [&](double) {
    return SweepInput{std::make_unique<FieldSource>(part()), watchedTruth(std::ref(trigger))};
  };
  const Monitor monitor{.stop = &trigger.stop};
  EXPECT_THROW(static_cast<void>(sweepInputs(SweepParameter::kIso, {0}, open, withThreads(), monitor)), Cancelled);
  EXPECT_GE(trigger.calls, 1u);
}

TEST(SweepMonitor, StopBetweenInputsOpensNoOther) {
  Trigger trigger(1);
  const auto open = [&](double) {
    trigger();
    return SweepInput{std::make_unique<FieldSource>(part()), {}};
  };
  const Monitor monitor{.stop = &trigger.stop};
  EXPECT_THROW(static_cast<void>(sweepInputs(SweepParameter::kIso, {0, 1}, open, withThreads(), monitor)), Cancelled);
  EXPECT_EQ(trigger.calls, 1u);
}

}  // namespace
}  // namespace pdc
