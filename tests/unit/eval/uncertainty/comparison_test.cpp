#include <gtest/gtest.h>
#include <placegraph/eval/uncertainty/comparison.h>
#include <placegraph/eval/uncertainty/student_t.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/random.h>

#include <cmath>

namespace placegraph {
namespace comparison_test {

const std::vector<double> kFirst = {1, 1.1, 0.9, 1.05, 0.95};
const std::vector<double> kSecond = {1.3, 1.2, 1.25, 1.35, 1.15, 1.25};

/// Errors of two estimates of one drive that is hard in places, the second's `factor` times as
/// large, with noise of their own.
std::pair<ErrorSeries, ErrorSeries> two_series(double factor, double noise) {
  Random random(1);
  ErrorSeries a{"1 frame", {}}, b{"1 frame", {}};
  for (int i = 0; i < 500; ++i) {
    const double hard = random.uniform(1, 5);
    a.errors.push_back({i, i + 1, hard * std::exp(random.normal(0, noise))});
    b.errors.push_back({i, i + 1, factor * hard * std::exp(random.normal(0, noise))});
  }
  return {a, b};
}

TEST(CompareRuns, IsWelchsTestOfTheLogarithms) {
  // Means 1 and 1.25; deviation of the log ratio 0.0422295, 7.1065 degrees of freedom (by hand).
  const Comparison comparison = compare_runs(kFirst, kSecond);
  ASSERT_TRUE(comparison.outcome);
  EXPECT_NEAR(comparison.first, 1, 1e-12);
  EXPECT_NEAR(comparison.second, 1.25, 1e-12);
  EXPECT_NEAR(comparison.ratio.estimate, 1.25, 1e-12);
  EXPECT_NEAR(comparison.ratio.degrees_freedom, 7.106545, 1e-5);
  const double half = 0.0422295315 * student_t_quantile(0.975, 7.10654542);
  EXPECT_NEAR(comparison.ratio.low, 1.25 * std::exp(-half), 1e-6);
  EXPECT_NEAR(comparison.ratio.high, 1.25 * std::exp(half), 1e-6);
  EXPECT_NEAR(comparison.p_worse, student_t_tail(0.22314355 / 0.0422295315, 7.10654542), 1e-8);
  EXPECT_NEAR(comparison.p_value, 2 * comparison.p_worse, 1e-12);
  EXPECT_EQ(comparison.difference, Difference::kWorse);
}

TEST(CompareRuns, FewRunsThatScatterLittleAreNotBelievedAgainstMany) {
  // By hand: Welch's half width is 0.15145 (p 0.077), that of equal variances 0.20823 (p 0.149305,
  // 13 degrees of freedom).
  const Comparison comparison =
      compare_runs({1, 1.02, 0.98, 1.01, 0.99}, {1, 1, 1.6, 1, 1.05, 0.95, 1.5, 1, 1.02, 0.98});
  ASSERT_TRUE(comparison.outcome);
  EXPECT_EQ(comparison.ratio.degrees_freedom, 13);
  EXPECT_NEAR(comparison.p_worse, 0.1493051, 1e-7);
  EXPECT_NEAR(std::log(comparison.ratio.high / comparison.ratio.estimate), 0.2082326, 1e-7);
}

TEST(CompareRuns, SaysWhatItFoundInASentence) {
  ComparisonOptions options;
  options.figure = "ATE";
  options.unit = "m";
  EXPECT_EQ(compare_runs(kFirst, kSecond, options).sentence,
            "B is 25 % worse than A: ATE 1 to 1.25 m, 95 % interval of the ratio 1.13 to 1.38");
  EXPECT_EQ(compare_runs(kSecond, kFirst, options).sentence,
            "B is 20 % better than A: ATE 1.25 to 1 m, 95 % interval of the ratio 0.724 to 0.884");
  options.noise_floor = 0.3;
  EXPECT_EQ(compare_runs(kFirst, kSecond, options).sentence,
            "the difference between A and B, 0.25 m, is within the noise of the truth, 0.3 m: "
            "ATE 1 and 1.25 m");
  EXPECT_EQ(compare_runs({1, 2, 3, 4, 5}, {2, 3, 4, 1, 5.5}, options).difference,
            Difference::kNone);
}

TEST(CompareRuns, TheOtherWayRoundIsTheInverse) {
  const Comparison ab = compare_runs(kFirst, kSecond), ba = compare_runs(kSecond, kFirst);
  EXPECT_NEAR(ab.ratio.low * ba.ratio.high, 1, 1e-12);
  EXPECT_NEAR(ab.p_value, ba.p_value, 1e-12);
  EXPECT_NEAR(ab.p_worse + ba.p_worse, 1, 1e-12);
  EXPECT_EQ(ba.difference, Difference::kBetter);
}

TEST(CompareRuns, NeedsFiveRunsOfEach) {
  const Comparison comparison = compare_runs(kFirst, {1, 2, 3});
  EXPECT_EQ(comparison.outcome.code, Outcome::Code::kTooFewData);
  EXPECT_EQ(comparison.sentence, "error of A and B cannot be compared: B has 3 runs: 5 are needed");
  EXPECT_EQ(comparison.difference, Difference::kUnknown);
}

TEST(CompareRuns, OfComputationsThatRepeatIsTheSameOrHasNoInterval) {
  const std::vector<double> one(5, 0.7), other(6, 0.8), none(5, 0.0);
  const Comparison same = compare_runs(one, one), differ = compare_runs(one, other);
  EXPECT_EQ(same.difference, Difference::kNone);
  EXPECT_EQ(same.p_value, 1);
  EXPECT_EQ(differ.outcome.code, Outcome::Code::kDegenerate);
  EXPECT_EQ(differ.difference, Difference::kUnknown);
  EXPECT_EQ(compare_runs(none, kFirst).outcome.code, Outcome::Code::kDegenerate);
  EXPECT_EQ(compare_runs(none, none).difference, Difference::kNone);
}

TEST(ComparePairedRuns, IsStudentsTestOfTheLogRatios) {
  // Ratios 1.1, 1.05, 1.15, 1.05, 1.125: mean log 0.0900871, deviation of the mean 0.0182658.
  const Comparison comparison = compare_paired_runs({1, 2, 4, 8, 16}, {1.1, 2.1, 4.6, 8.4, 18});
  ASSERT_TRUE(comparison.outcome);
  EXPECT_NEAR(comparison.first, 4, 1e-12);
  EXPECT_NEAR(comparison.ratio.estimate, 1.09426959, 1e-7);
  EXPECT_NEAR(comparison.ratio.low, 1.04015842, 1e-6);
  EXPECT_NEAR(comparison.ratio.high, 1.15119573, 1e-6);
  EXPECT_EQ(comparison.difference, Difference::kWorse);
  // Unpaired, the sequences' own difficulty hides it.
  EXPECT_EQ(compare_runs({1, 2, 4, 8, 16}, {1.1, 2.1, 4.6, 8.4, 18}).difference,
            Difference::kNone);
}

TEST(ComparePairedRuns, RefusesPairsThatAreNone) {
  EXPECT_THROW((void)compare_paired_runs({1, 2}, {1}), ArgumentError);
  EXPECT_THROW((void)compare_paired_runs({1, 2, 3, 4, 0}, {1, 2, 3, 4, 5}), ArgumentError);
  EXPECT_EQ(compare_paired_runs({1, 2}, {1, 3}).outcome.code, Outcome::Code::kTooFewData);
}

TEST(CompareSeries, FindsASmallDifferenceOfPairedErrors) {
  const auto [a, b] = two_series(1.05, 0.1);
  for (const SeriesFigure figure : {SeriesFigure::kMean, SeriesFigure::kRmse}) {
    const Comparison comparison = compare_series({a}, {b}, figure);
    ASSERT_TRUE(comparison.outcome) << comparison.outcome.reason;
    EXPECT_EQ(comparison.difference, Difference::kWorse) << comparison.sentence;
    EXPECT_LT(comparison.ratio.low, 1.05);
    EXPECT_GT(comparison.ratio.high, 1.05);
    EXPECT_LT(comparison.p_value, 0.01);
    EXPECT_EQ(comparison.common, 500);
    const Comparison back = compare_series({b}, {a}, figure);
    EXPECT_NEAR(back.ratio.low * comparison.ratio.high, 1, 1e-9);
    EXPECT_EQ(back.difference, Difference::kBetter);
  }
}

TEST(CompareSeries, ComparesOnlyWhatBothHave) {
  auto [a, b] = two_series(1, 0.1);
  const Comparison whole = compare_series({a}, {b}, SeriesFigure::kMean);
  b.errors.erase(b.errors.begin() + 100, b.errors.begin() + 120);
  a.errors.erase(a.errors.begin(), a.errors.begin() + 5);
  b.errors[0].error = 1e6;  // of a stretch that the first lacks
  const Comparison part = compare_series({a, {"1 s", {{0, 10, 3}}}}, {b}, SeriesFigure::kMean);
  EXPECT_EQ(part.common, 475);
  EXPECT_EQ(part.left_out, 26);
  EXPECT_NEAR(part.ratio.estimate, whole.ratio.estimate, 0.02);
  const Comparison nothing = compare_series({a}, {{"1 s", {{0, 10, 3}}}}, SeriesFigure::kMean);
  EXPECT_EQ(nothing.outcome.code, Outcome::Code::kInconsistent);
}

TEST(CompareSeries, OfTheSameErrorsFindsNoDifference) {
  const auto [a, b] = two_series(1.05, 0.1);
  const Comparison same = compare_series({a}, {a}, SeriesFigure::kMean);
  EXPECT_TRUE(same.outcome);
  EXPECT_EQ(same.difference, Difference::kNone);
  EXPECT_EQ(same.p_value, 1);
  ErrorSeries twice = a;
  for (StretchError& e : twice.errors) e.error *= 2;
  EXPECT_EQ(compare_series({a}, {twice}, SeriesFigure::kMean).outcome.code,
            Outcome::Code::kDegenerate);
}

TEST(CompareSeries, CountsNothingBelowTheNoiseOfTheTruth) {
  const auto [a, b] = two_series(1.05, 0.01);
  ComparisonOptions options;
  options.noise_floor = 0.5;
  EXPECT_EQ(compare_series({a}, {b}, SeriesFigure::kMean, options).difference,
            Difference::kBelowNoise);
  options.noise_floor = -1;
  EXPECT_THROW((void)compare_series({a}, {b}, SeriesFigure::kMean, options), ArgumentError);
}

TEST(CompareSeries, RefusesNegativeErrors) {
  auto [a, b] = two_series(1.05, 0.01);
  a.errors[7].error = -1;
  EXPECT_THROW((void)compare_series({a}, {b}, SeriesFigure::kMean), ArgumentError);
}

TEST(Comparison, NamesItsDifferences) {
  EXPECT_STREQ(to_string(Difference::kUnknown), "unknown");
  EXPECT_STREQ(to_string(Difference::kNone), "none");
  EXPECT_STREQ(to_string(Difference::kBelowNoise), "below noise");
  EXPECT_STREQ(to_string(Difference::kBetter), "better");
  EXPECT_STREQ(to_string(Difference::kWorse), "worse");
}

}  // namespace comparison_test
}  // namespace placegraph
