#include <gtest/gtest.h>
#include <placegraph/eval/uncertainty/drive_interval.h>
#include <placegraph/eval/uncertainty/student_t.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/random.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "tests/support/message_of.h"

namespace placegraph {
namespace drive_interval_test {

/// Independent errors of `count` motions of one frame.
ErrorSeries independent_errors_of(int count, Random& random) {
  ErrorSeries series{"1 frame", {}};
  for (int i = 0; i < count; ++i) series.errors.push_back({i, i + 1, random.uniform(1, 3)});
  return series;
}

/// Errors over `frames` frames from every frame on: means of independent ones.
ErrorSeries overlapping_errors(int count, int frames, Random& random) {
  const ErrorSeries single = independent_errors_of(count + frames, random);
  ErrorSeries series{std::to_string(frames) + " frames", {}};
  for (int i = 0; i < count; ++i) {
    double sum = 0;
    for (int k = i; k < i + frames; ++k) sum += single.errors[k].error;
    series.errors.push_back({i, i + frames, sum / frames});
  }
  return series;
}

/// The deviation of the mean of errors of single frames, by the definition: projections on cosines.
double deviation_by_definition(const ErrorSeries& series, int waves) {
  const double count = static_cast<double>(series.errors.size());
  double squares = 0;
  for (int wave = 1; wave <= waves; ++wave) {
    double projection = 0;
    for (std::size_t i = 0; i < series.errors.size(); ++i)
      projection += series.errors[i].error *
                    std::cos(std::numbers::pi * wave * (static_cast<double>(i) + 0.5) / count);
    squares += 2 * projection * projection;
  }
  return std::sqrt(squares / (waves - 0.4)) / count;
}

TEST(DriveInterval, OfSingleFramesIsThatOfTheProjectionsOnWaves) {
  Random random(1);
  const ErrorSeries series = independent_errors_of(500, random);
  double sum = 0;
  for (const StretchError& e : series.errors) sum += e.error;
  const ConfidenceInterval interval = interval_of_mean({series});
  ASSERT_TRUE(interval.outcome) << interval.outcome.reason;
  EXPECT_NEAR(interval.estimate, sum / 500, 1e-12);
  EXPECT_EQ(interval.of, "this drive's errors");
  const int waves = static_cast<int>(interval.degrees_freedom);
  EXPECT_GE(waves, 20);
  EXPECT_LE(waves, 40);
  const double half = student_t_quantile(0.975, waves) * deviation_by_definition(series, waves);
  EXPECT_NEAR(interval.low, interval.estimate * std::exp(-half / interval.estimate), 1e-9);
  EXPECT_NEAR(interval.high, interval.estimate * std::exp(half / interval.estimate), 1e-9);
}

TEST(DriveInterval, OfErrorsOfBothSignsIsSymmetric) {
  Random random(2);
  ErrorSeries series = independent_errors_of(300, random);
  for (StretchError& e : series.errors) e.error -= 2;
  const ConfidenceInterval interval = interval_of_mean({series});
  ASSERT_TRUE(interval.outcome);
  EXPECT_NEAR(interval.high - interval.estimate, interval.estimate - interval.low, 1e-12);
}

TEST(DriveInterval, OfTheRmseIsTheRootOfThatOfTheMeanSquare) {
  Random random(3);
  const ErrorSeries series = independent_errors_of(300, random);
  ErrorSeries squares = series;
  for (StretchError& e : squares.errors) e.error *= e.error;
  const ConfidenceInterval root = interval_of_rmse({series}), mean = interval_of_mean({squares});
  ASSERT_TRUE(root.outcome);
  EXPECT_NEAR(root.estimate, std::sqrt(mean.estimate), 1e-12);
  // Correlations are those of the errors, not of their squares: the waves may differ.
  if (root.degrees_freedom == mean.degrees_freedom) {
    EXPECT_NEAR(root.low, std::sqrt(mean.low), 1e-12);
    EXPECT_NEAR(root.high, std::sqrt(mean.high), 1e-12);
  }
  EXPECT_LT(root.low, root.estimate);
  EXPECT_GT(root.high, root.estimate);
}

TEST(DriveInterval, OfTheMedianIsBetweenErrors) {
  Random random(4);
  const ErrorSeries series = independent_errors_of(401, random);
  const ConfidenceInterval interval = interval_of_median({series});
  ASSERT_TRUE(interval.outcome);
  int below = 0, within = 0;
  for (const StretchError& e : series.errors) {
    below += e.error < interval.estimate;
    within += interval.low <= e.error && e.error <= interval.high;
  }
  EXPECT_EQ(below, 200);
  // 2 t sqrt(n) / 2 ranks, t = 2.02; the deviation itself is known to a tenth or two.
  EXPECT_GT(within, 0.6 * 2.02 * std::sqrt(401.0));
  EXPECT_LT(within, 1.5 * 2.02 * std::sqrt(401.0));
}

TEST(DriveInterval, ScalesMirrorsAndShiftsWithTheDrive) {
  Random random(5);
  const ErrorSeries series = overlapping_errors(600, 20, random);
  ErrorSeries scaled = series, shifted = series, mirrored{series.stretch, {}};
  for (StretchError& e : scaled.errors) e.error *= 7;
  for (StretchError& e : shifted.errors) {
    e.first_frame += 12345;
    e.last_frame += 12345;
  }
  for (auto e = series.errors.rbegin(); e != series.errors.rend(); ++e)
    mirrored.errors.push_back({-e->last_frame, -e->first_frame, e->error});
  const ConfidenceInterval base = interval_of_mean({series});
  ASSERT_TRUE(base.outcome) << base.outcome.reason;
  EXPECT_NEAR(interval_of_mean({scaled}).high, 7 * base.high, 1e-9);
  EXPECT_NEAR(interval_of_mean({shifted}).high, base.high, 1e-9);
  EXPECT_NEAR(interval_of_mean({mirrored}).high, base.high, 1e-2 * (base.high - base.low));
}

TEST(DriveInterval, OfOverlappingErrorsKnowsThatNeighboursShareTheirNoise) {
  // The same frames, seen by 3,000 overlapping stretches, are no more independent: the deviation is
  // that of the frames' mean, 0.577 / sqrt(3000), not that of 3,000 independent stretches.
  Random random(6);
  double mean_half = 0;
  for (int i = 0; i < 20; ++i) {
    const ConfidenceInterval interval = interval_of_mean({overlapping_errors(3000, 30, random)});
    ASSERT_TRUE(interval.outcome) << interval.outcome.reason;
    EXPECT_LE(interval.degrees_freedom, 40);
    mean_half += 0.5 * (interval.high - interval.low) / 20 /
                 student_t_quantile(0.975, interval.degrees_freedom);
  }
  EXPECT_NEAR(mean_half, 2 / std::sqrt(12.0) / std::sqrt(3000.0), 0.2 * 0.577 / std::sqrt(3000.0));
}

TEST(DriveInterval, OfAMillionErrorsIsTheOneOfTheirNumber) {
  Random random(7);
  const ConfidenceInterval interval = interval_of_mean({independent_errors_of(200'000, random)});
  ASSERT_TRUE(interval.outcome);
  EXPECT_EQ(interval.degrees_freedom, 40);
  // Forty squares know the deviation to 11 %.
  EXPECT_NEAR(0.5 * (interval.high - interval.low), 2.02 * 0.577 / std::sqrt(200'000.0),
              0.45 * 2.02 * 0.577 / std::sqrt(200'000.0));
}

TEST(DriveInterval, IsNoneOfFewStretches) {
  Random random(8);
  const ConfidenceInterval interval = interval_of_mean({overlapping_errors(300, 100, random)});
  EXPECT_EQ(interval.outcome.code, Outcome::Code::kTooFewData);
  EXPECT_EQ(interval.outcome.reason, "only 3 disjoint stretches of 100 frames, 4 are needed");
  EXPECT_NEAR(interval.estimate, 2, 0.5);
  EXPECT_NE(to_text(interval).find(", only 3 disjoint stretches"), std::string::npos);
}

TEST(DriveInterval, IsNoneOfErrorsThatWalk) {
  Random random(9);
  ErrorSeries series{"1 frame", {}};
  double level = 100;
  for (int i = 0; i < 1000; ++i) series.errors.push_back({i, i + 1, level += random.normal()});
  for (const auto interval_of : {interval_of_mean, interval_of_rmse, interval_of_median}) {
    const ConfidenceInterval interval = interval_of({series}, 0.95);
    EXPECT_EQ(interval.outcome.code, Outcome::Code::kTooFewData);
    EXPECT_NE(interval.outcome.reason.find("are correlated"), std::string::npos)
        << interval.outcome.reason;
  }
}

TEST(DriveInterval, IsNoneOfEqualErrors) {
  Random random(10);
  ErrorSeries series = independent_errors_of(100, random);
  for (StretchError& e : series.errors) e.error = 0.1;
  EXPECT_EQ(interval_of_mean({series}).outcome.code, Outcome::Code::kDegenerate);
}

TEST(DriveInterval, RefusesWhatIsNoSeries) {
  Random random(11);
  ErrorSeries series = independent_errors_of(100, random);
  EXPECT_THROW((void)interval_of_mean({}), ArgumentError);
  EXPECT_THROW((void)interval_of_median({}), ArgumentError);
  EXPECT_THROW((void)interval_of_mean({{"1 s", {}}}), ArgumentError);
  EXPECT_THROW((void)interval_of_mean({series}, 1), ArgumentError);
  series.errors[50].error = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(test::message_of<ArgumentError>([&] { (void)interval_of_rmse({series}); }),
            "the error of frames 50 to 51 is no finite number");
  series.errors[50] = {3, 4, 1};
  EXPECT_EQ(test::message_of<ArgumentError>([&] { (void)interval_of_mean({series}); }),
            "the error of frames 3 to 4 is out of order");
}

TEST(ErrorSeries, OfSegmentsAreOnePerLength) {
  const std::vector<SegmentError> segments = {
      {0, 90, 100, 1.5, 0.2, 10}, {0, 180, 200, 1.1, 0.1, 10}, {10, 99, 100, 1.6, 0.3, 10}};
  const auto translation = translation_series(segments), rotation = rotation_series(segments);
  ASSERT_EQ(translation.size(), 2u);
  EXPECT_EQ(translation[0].stretch, "100 m");
  ASSERT_EQ(translation[0].errors.size(), 2u);
  EXPECT_EQ(translation[0].errors[1].last_frame, 99);
  EXPECT_EQ(translation[1].errors[0].error, 1.1);
  EXPECT_EQ(rotation[0].errors[1].error, 0.3);
}

}  // namespace drive_interval_test
}  // namespace placegraph
