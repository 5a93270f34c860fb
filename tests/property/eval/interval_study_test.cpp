#include <gtest/gtest.h>
#include <placegraph/eval/uncertainty/comparison.h>
#include <placegraph/eval/uncertainty/drive_interval.h>
#include <placegraph/eval/uncertainty/run_interval.h>

#include <cmath>
#include <cstdio>
#include <functional>

#include "tests/support/error_models.h"

// The truth of intervals, by simulation; scripts/interval_study prints the tables.

namespace placegraph {
namespace interval_study_test {

using namespace test;

constexpr int kDraws = 2000;
// Of 95 %; a share of 2,000 draws has a deviation of 0.5 %.
constexpr double kFewest = 0.93, kMost = 0.97;

const std::vector<double> kLengths = {100, 200, 300, 400, 500, 600, 700, 800};

struct DriveCase {
  const char* figure;
  Shape shape;
  int frames;
  double step_m;
  std::function<ConfidenceInterval(const PlanarDrive&, const PlanarDrive&)> interval;
};

DriveCase segments(Shape shape, int frames, double step_m, const std::vector<double>& lengths_m) {
  return {lengths_m.back() > 200 ? "t_rel, 100 to 800 m" : "t_rel, 100 and 200 m", shape, frames,
          step_m, [=](const PlanarDrive& truth, const PlanarDrive& estimate) {
            return interval_of_mean(segment_series(truth, estimate, lengths_m, step_m));
          }};
}

template <class IntervalOf>
DriveCase motions(const char* figure, Shape shape, int frames, int over, int every,
                  IntervalOf interval_of) {
  return {figure, shape, frames, 1, [=](const PlanarDrive& truth, const PlanarDrive& estimate) {
            return interval_of(motion_series(truth, estimate, over, every), 0.95);
          }};
}

std::vector<DriveCase> drive_cases() {
  return {segments(Shape::kWinding, 4000, 1, kLengths),
          segments(Shape::kBlocks, 4000, 1.25, kLengths),
          segments(Shape::kRing, 3500, 1, kLengths),
          segments(Shape::kBlocks, 3000, 1, {100, 200}),
          motions("RPE, 1 frame, mean", Shape::kWinding, 1000, 1, 1, interval_of_mean),
          motions("RPE, 1 frame, median", Shape::kRing, 1000, 1, 1, interval_of_median),
          motions("RPE, 10 frames, all, RMSE", Shape::kBlocks, 2000, 10, 1, interval_of_rmse),
          motions("RPE, 100 frames, all, mean", Shape::kRing, 4000, 100, 1, interval_of_mean)};
}

struct Coverage {
  int given = 0, held = 0;
  double half_width = 0;
  double share() const { return static_cast<double>(held) / given; }
};

/// How many intervals of `draws` estimates are given, and how many of these hold the mean of all
/// estimates' figures.
Coverage coverage_of(const DriveCase& drive, ErrorModel model, int draws) {
  const PlanarDrive truth = planar_drive(drive.shape, drive.frames, drive.step_m);
  Random random(1, static_cast<std::uint64_t>(model));
  std::vector<ConfidenceInterval> intervals;
  double expectation = 0;
  for (int i = 0; i < draws; ++i) {
    intervals.push_back(drive.interval(truth, estimate_of(truth, model, random)));
    expectation += intervals.back().estimate / draws;
  }
  Coverage coverage;
  for (const ConfidenceInterval& interval : intervals) {
    if (!interval.outcome) continue;
    ++coverage.given;
    coverage.held += interval.low <= expectation && expectation <= interval.high;
    coverage.half_width += 50 * std::log(interval.high / interval.low);
  }
  coverage.half_width /= std::max(1, coverage.given);
  return coverage;
}

void print_row(const char* figure, const char* shape, int frames, ErrorModel model,
               const Coverage& coverage, int draws) {
  std::printf("| %s | %s, %d | %s | %.1f | ", figure, shape, frames, to_string(model),
              100.0 * coverage.given / draws);
  if (coverage.given < draws / 20)
    std::printf("| |\n");
  else
    std::printf("%.1f | %.0f |\n", 100 * coverage.share(), coverage.half_width);
  std::fflush(stdout);
}

void study_drives(const std::vector<ErrorModel>& models, bool judged) {
  std::printf("| figure | drive, frames | errors | given [%%] | hold [%%] | half width [%%] |\n"
              "|---|---|---|---|---|---|\n");
  for (const DriveCase& drive : drive_cases())
    for (const ErrorModel model : models) {
      const Coverage coverage = coverage_of(drive, model, kDraws);
      print_row(drive.figure, to_string(drive.shape), drive.frames, model, coverage, kDraws);
      if (!judged) continue;
      SCOPED_TRACE(std::string(drive.figure) + ", " + to_string(model));
      EXPECT_GE(coverage.given, 0.9 * kDraws);
      EXPECT_GE(coverage.share(), kFewest);
      EXPECT_LE(coverage.share(), kMost);
    }
}

TEST(IntervalStudy, IntervalsOfOneDriveHold) {
  study_drives({ErrorModel::kWhite, ErrorModel::kPositionWalk, ErrorModel::kHeadingWalk,
                ErrorModel::kLoopClosed},
               true);
}

TEST(IntervalStudy, AScaleThatWalksFromItsStartGetsNoIntervalFromOneDrive) {
  for (const DriveCase& drive : drive_cases()) {
    const Coverage coverage = coverage_of(drive, ErrorModel::kScaleWalk, kDraws);
    print_row(drive.figure, to_string(drive.shape), drive.frames, ErrorModel::kScaleWalk, coverage,
              kDraws);
    EXPECT_LE(coverage.given, 0.03 * kDraws) << drive.figure;
  }
}

/// Figures of runs over one drive, from which runs are drawn.
std::vector<double> ate_of_runs(Shape shape, ErrorModel model, int runs) {
  const PlanarDrive truth = planar_drive(shape, 1000);
  Random random(2, static_cast<std::uint64_t>(model));
  std::vector<double> figures;
  for (int i = 0; i < runs; ++i)
    figures.push_back(planar_ate_m(truth, estimate_of(truth, model, random)));
  return figures;
}

std::vector<double> drawn(const std::vector<double>& figures, int count, Random& random) {
  std::vector<double> result;
  for (int i = 0; i < count; ++i)
    result.push_back(figures[random.index(static_cast<int>(figures.size()))]);
  return result;
}

void study_runs(const std::vector<ErrorModel>& models, bool judged) {
  std::printf("| drive | errors | 5 runs hold [%%] | 10 | 20 |\n|---|---|---|---|---|\n");
  for (const Shape shape : {Shape::kWinding, Shape::kBlocks, Shape::kRing})
    for (const ErrorModel model : models) {
      const std::vector<double> figures = ate_of_runs(shape, model, 4 * kDraws);
      double expectation = 0;
      for (const double figure : figures) expectation += figure / (4 * kDraws);
      Random random(3);
      std::printf("| %s | %s |", to_string(shape), to_string(model));
      for (const int runs : {5, 10, 20}) {
        int held = 0;
        for (int i = 0; i < 4 * kDraws; ++i) {
          const ConfidenceInterval interval = interval_of_runs(drawn(figures, runs, random));
          held += interval.low <= expectation && expectation <= interval.high;
        }
        const double share = held / (4.0 * kDraws);
        std::printf(" %.1f |", 100 * share);
        if (!judged) continue;
        SCOPED_TRACE(std::string(to_string(shape)) + ", " + to_string(model));
        EXPECT_GE(share, kFewest);
        EXPECT_LE(share, kMost);
      }
      std::printf("\n");
      std::fflush(stdout);
    }
}

TEST(IntervalStudy, IntervalsOfTheAteOfRepeatedRunsHold) {
  study_runs({ErrorModel::kWhite, ErrorModel::kPositionWalk, ErrorModel::kHeadingWalk,
              ErrorModel::kScaleWalk, ErrorModel::kLoopClosed},
             true);
}

TEST(IntervalStudy, RatiosOfTwoEstimatesOfOneDriveHold) {
  // The second system's errors are the first model's too, of other noise: the true ratio is 1.
  std::printf(
      "| figure | errors | given [%%] | hold 1 [%%] | p < 0.05 [%%] |\n|---|---|---|---|---|\n");
  const PlanarDrive truth = planar_drive(Shape::kBlocks, 4000, 1.25);
  for (const ErrorModel model : {ErrorModel::kWhite, ErrorModel::kPositionWalk,
                                 ErrorModel::kHeadingWalk, ErrorModel::kLoopClosed})
    for (const bool segment : {true, false}) {
      Random random(4, static_cast<std::uint64_t>(model));
      int given = 0, held = 0, small = 0;
      for (int i = 0; i < kDraws; ++i) {
        const auto errors = [&] {
          const PlanarDrive estimate = estimate_of(truth, model, random);
          return segment ? segment_series(truth, estimate, kLengths, 1.25)
                         : motion_series(truth, estimate, 10, 10);
        };
        const auto first = errors(), second = errors();
        const Comparison comparison = compare_series(
            first, second, segment ? SeriesFigure::kMean : SeriesFigure::kRmse);
        if (!comparison.outcome) continue;
        ++given;
        held += comparison.difference == Difference::kNone;
        small += comparison.p_value < 0.05;
      }
      const double share = static_cast<double>(held) / given;
      std::printf("| %s | %s | %.1f | %.1f | %.1f |\n",
                  segment ? "t_rel, 100 to 800 m" : "RPE, 10 frames, RMSE", to_string(model),
                  100.0 * given / kDraws, 100 * share, 100.0 * small / given);
      std::fflush(stdout);
      EXPECT_GE(given, 0.9 * kDraws);
      EXPECT_GE(share, kFewest);
      EXPECT_LE(share, kMost);
    }
}

TEST(IntervalStudy, EqualSystemsRaiseFewAlarmsAndTenPercentAreFoundByTheRunsAskedFor) {
  // The deviation of 5 % of so many is a quarter of a percent.
  constexpr int kPairs = 4 * kDraws;
  std::printf("| scatter [%%] | runs of the baseline | runs needed, median | alarms, equal [%%] | "
              "alarms, 10 %% worse [%%] |\n|---|---|---|---|---|\n");
  for (const double scatter : {0.03, 0.1, 0.3})
    for (const int first : {5, 10, 20}) {
      Random random(5, static_cast<std::uint64_t>(100 * scatter) + 1000 * first);
      int alarms = 0, found = 0;
      std::vector<int> needed;
      for (int i = 0; i < kPairs; ++i) {
        // Of the skewed kind that errors are.
        const auto run = [&](double mean) {
          return mean * std::exp(random.normal(0, scatter) - 0.5 * scatter * scatter);
        };
        const auto runs = [&](int count, double mean) {
          std::vector<double> figures;
          for (int k = 0; k < count; ++k) figures.push_back(run(mean));
          return figures;
        };
        std::vector<double> baseline = runs(first, 1);
        needed.push_back(runs_needed(baseline).runs);
        while (static_cast<int>(baseline.size()) < needed.back()) baseline.push_back(run(1));
        const auto alarm = [&](double mean) {
          return compare_runs(baseline, runs(needed.back(), mean)).p_worse < 0.05;
        };
        alarms += alarm(1);
        found += alarm(1.1);
      }
      std::nth_element(needed.begin(), needed.begin() + kPairs / 2, needed.end());
      std::printf("| %.0f | %d | %d | %.1f | %.1f |\n", 100 * scatter, first,
                  needed[kPairs / 2], 100.0 * alarms / kPairs, 100.0 * found / kPairs);
      std::fflush(stdout);
      EXPECT_LE(alarms, 0.06 * kPairs);
      EXPECT_GE(found, 0.8 * kPairs);
    }
}

TEST(IntervalStudy, ModelsThatNoConstantWasChosenBy) {
  study_drives({ErrorModel::kBursts, ErrorModel::kCorrelated,
                ErrorModel::kHeavyTails},
               false);
  study_runs({ErrorModel::kBursts, ErrorModel::kCorrelated,
              ErrorModel::kHeavyTails},
             false);
}

}  // namespace interval_study_test
}  // namespace placegraph
