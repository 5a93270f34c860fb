#include <gtest/gtest.h>
#include <placegraph/eval/uncertainty/drive_interval.h>
#include <placegraph/eval/uncertainty/run_interval.h>

#include <cmath>

#include "tests/support/error_models.h"

// A few hundred draws of what interval_study_test.cpp makes thousands of.

namespace placegraph {
namespace interval_coverage_test {

using namespace test;

constexpr int kDraws = 300;
// 93 % less four deviations of a share of 300 draws, 1.5 % each.
constexpr double kFewest = 0.93 - 4 * 0.015;

constexpr ErrorModel kModels[] = {ErrorModel::kWhite, ErrorModel::kPositionWalk,
                                  ErrorModel::kHeadingWalk, ErrorModel::kLoopClosed};

double mean_estimate(const std::vector<ConfidenceInterval>& intervals) {
  double mean = 0;
  for (const ConfidenceInterval& interval : intervals)
    mean += interval.estimate / static_cast<double>(intervals.size());
  return mean;
}

double share_that_holds(const std::vector<ConfidenceInterval>& intervals, double expectation) {
  double given = 0, held = 0;
  for (const ConfidenceInterval& interval : intervals) {
    given += static_cast<bool>(interval.outcome);
    held += interval.outcome && interval.low <= expectation && expectation <= interval.high;
  }
  EXPECT_GE(given, 0.9 * static_cast<double>(intervals.size()));
  return held / given;
}

TEST(IntervalCoverage, IntervalsOfOneDriveHoldTheirExpectation) {
  const PlanarDrive truth = planar_drive(Shape::kBlocks, 1000, 3);
  for (const ErrorModel model : kModels) {
    SCOPED_TRACE(to_string(model));
    Random random(11, static_cast<std::uint64_t>(model));
    std::vector<ConfidenceInterval> segments, motions;
    for (int i = 0; i < kDraws; ++i) {
      const PlanarDrive estimate = estimate_of(truth, model, random);
      segments.push_back(interval_of_mean(segment_series(truth, estimate, {50, 100, 200}, 3)));
      motions.push_back(interval_of_rmse(motion_series(truth, estimate, 10, 10)));
    }
    EXPECT_GE(share_that_holds(segments, mean_estimate(segments)), kFewest);
    EXPECT_GE(share_that_holds(motions, mean_estimate(motions)), kFewest);
  }
}

TEST(IntervalCoverage, AScaleThatWalksFromItsStartGetsNoInterval) {
  const PlanarDrive truth = planar_drive(Shape::kWinding, 1000, 3);
  Random random(12);
  int given = 0;
  for (int i = 0; i < 100; ++i) {
    const PlanarDrive estimate = estimate_of(truth, ErrorModel::kScaleWalk, random);
    given += static_cast<bool>(
        interval_of_mean(segment_series(truth, estimate, {50, 100, 200}, 3)).outcome);
  }
  EXPECT_LE(given, 9);  // 3 %, and four deviations
}

TEST(IntervalCoverage, IntervalsOfRepeatedRunsHoldTheirExpectation) {
  const PlanarDrive truth = planar_drive(Shape::kWinding, 200, 3);
  for (const ErrorModel model : kModels) {
    SCOPED_TRACE(to_string(model));
    Random random(13, static_cast<std::uint64_t>(model));
    std::vector<ConfidenceInterval> intervals;
    for (int i = 0; i < kDraws; ++i) {
      std::vector<double> figures;
      for (int run = 0; run < 6; ++run)
        figures.push_back(planar_ate_m(truth, estimate_of(truth, model, random)));
      intervals.push_back(interval_of_runs(figures));
    }
    EXPECT_GE(share_that_holds(intervals, mean_estimate(intervals)), kFewest);
  }
}

TEST(ErrorModels, SegmentsAreThoseOfTheEvaluation) {
  const PlanarDrive truth = planar_drive(Shape::kWinding, 1000);
  Random random(14);
  const PlanarDrive estimate = estimate_of(truth, ErrorModel::kHeadingWalk, random);
  const auto pose = [](const PlanarPose& p) {
    Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
    T.linear() = Eigen::AngleAxisd(p.heading_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    T.translation().head<2>() = p.position_m;
    return T;
  };
  std::vector<FramePair> pairs;
  for (int i = 0; i < 1000; ++i) pairs.push_back({i, i, pose(truth[i]), pose(estimate[i])});
  // Lengths between two frames: those of the path are rounded.
  SegmentOptions options;
  options.lengths_m = {100.5, 200.5};
  const SegmentResult result = kitti_segments(pairs, false, options);
  const auto expected = translation_series(result.segments);
  const auto planar = segment_series(truth, estimate, {100.5, 200.5});
  ASSERT_EQ(planar.size(), expected.size());
  for (std::size_t k = 0; k < planar.size(); ++k) {
    ASSERT_EQ(planar[k].errors.size(), expected[k].errors.size());
    for (std::size_t i = 0; i < planar[k].errors.size(); ++i) {
      EXPECT_EQ(planar[k].errors[i].last_frame, expected[k].errors[i].last_frame);
      EXPECT_NEAR(planar[k].errors[i].error, expected[k].errors[i].error, 1e-9);
    }
  }
}

}  // namespace interval_coverage_test
}  // namespace placegraph
