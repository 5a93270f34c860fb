#include <fmt/format.h>
#include <placegraph/eval/uncertainty/mean_deviation.h>
#include <placegraph/graph/core/error.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace placegraph {
namespace {

// Student's quantile of 40 degrees of freedom is 3 % above that of infinitely many. Chosen.
constexpr int kMostWaves = 40;
// Two stretches in half a wave, and two waves: with one, the interval would span a factor of
// thousands.
constexpr int kStretchesOfHalfWave = 2, kFewestWaves = 2;
// With four, autoregressive errors lose a tenth of the shortest wave, and how long they are
// correlated is underestimated in drives that hold few of them (scripts/interval_study).
constexpr int kCorrelationsOfHalfWave = 8;
// A random walk, which has no mean, passes for as many in one or two of a hundred drives
// (scripts/interval_study).
constexpr double kFewestIndependent = 25;
// A loop that is closed takes about so much from the longest waves (scripts/interval_study).
constexpr double kWavesOfLoops = 0.4;
// Longer series are summed in groups: a group is a hundredth of the shortest half wave. Chosen.
constexpr int kMostGroups = 4096;

/// Errors of a series less their mean, neighbours summed.
struct ErrorGroup {
  int first_frame, last_frame, count;
  double sum;
};
using GroupedSeries = std::vector<ErrorGroup>;

using Term = std::function<double(double)>;

GroupedSeries grouped(const ErrorSeries& series, const Term& term) {
  const std::size_t size = (series.errors.size() + kMostGroups - 1) / kMostGroups;
  double mean = 0;
  for (const StretchError& e : series.errors) mean += term(e.error);
  mean /= static_cast<double>(series.errors.size());
  GroupedSeries groups;
  for (std::size_t i = 0; i < series.errors.size(); ++i) {
    const StretchError& e = series.errors[i];
    if (i % size == 0) groups.push_back({e.first_frame, e.last_frame, 0, 0});
    ErrorGroup& group = groups.back();
    group.last_frame = std::max(group.last_frame, e.last_frame);
    ++group.count;
    group.sum += term(e.error) - mean;
  }
  return groups;
}

double mean_frames(const ErrorSeries& series) {
  double frames = 0;
  for (const StretchError& e : series.errors) frames += e.last_frame - e.first_frame;
  return frames / static_cast<double>(series.errors.size());
}

/// How many stretches the series has of which none shares a frame's motion with another.
int disjoint_stretches(const ErrorSeries& series) {
  int count = 0, end = series.errors.front().first_frame;
  for (const StretchError& e : series.errors) {
    if (e.first_frame < end) continue;
    ++count;
    end = std::max(e.last_frame, e.first_frame + 1);
  }
  return count;
}

/// The number of independent errors that would have the same deviation of their mean, by the
/// autocorrelation up to where it first vanishes.
double independent_errors(const GroupedSeries& groups) {
  const std::size_t count = groups.size();
  double square = 0, products = 0;
  for (const ErrorGroup& group : groups) square += group.sum * group.sum;
  for (std::size_t lag = 1; lag < count; ++lag) {
    double product = 0;
    for (std::size_t i = lag; i < count; ++i) product += groups[i].sum * groups[i - lag].sum;
    if (product <= 0) break;
    products += product;
  }
  if (square == 0) return static_cast<double>(count);
  return static_cast<double>(count) / (1 + 2 * products / square);
}

/// Projections on the waves, and what the waves leave of errors of single frames.
struct WaveSums {
  Eigen::VectorXd of_errors;     // entry k: wave k + 1
  Eigen::MatrixXd of_frames;     // column: differences along the frames; row 0: the mean, k: wave k
  int first_frame, frames;

  WaveSums(int waves, int first, int last)
      : of_errors(Eigen::VectorXd::Zero(waves)),
        of_frames(Eigen::MatrixXd::Zero(waves + 1, std::min(last - first + 1, kMostGroups) + 1)),
        first_frame(first),
        frames(last - first + 1) {}

  Eigen::Index column_of(int frame) const {
    return static_cast<Eigen::Index>(frame - first_frame) * (of_frames.cols() - 1) / frames;
  }

  void add(const GroupedSeries& groups) {
    Eigen::VectorXd wave(of_frames.rows());
    for (std::size_t i = 0; i < groups.size(); ++i) {
      const double phase = std::numbers::pi * (static_cast<double>(i) + 0.5) /
                           static_cast<double>(groups.size());
      wave[0] = 1;
      double before = 1, value = std::cos(phase);
      const double twice = 2 * value;
      for (Eigen::Index k = 1; k < wave.size(); ++k) {
        wave[k] = std::numbers::sqrt2 * value;
        before = std::exchange(value, twice * value - before);
      }
      of_errors += groups[i].sum * wave.tail(of_errors.size());
      const Eigen::Index begin = column_of(groups[i].first_frame);
      const Eigen::Index end = std::max(begin + 1, column_of(groups[i].last_frame));
      wave *= static_cast<double>(groups[i].count) / static_cast<double>(end - begin);
      of_frames.col(begin) += wave;
      of_frames.col(end) -= wave;
    }
  }

  /// The variance of the sum of all errors, by the projections.
  double variance() const {
    Eigen::VectorXd along = Eigen::VectorXd::Zero(of_frames.rows()), squares = along;
    for (Eigen::Index i = 0; i + 1 < of_frames.cols(); ++i) {
      along += of_frames.col(i);
      squares += along.cwiseAbs2();
    }
    const auto waves = of_errors.size();
    return squares[0] * of_errors.cwiseAbs2().cwiseQuotient(squares.tail(waves)).sum() /
           (static_cast<double>(waves) - kWavesOfLoops);
  }
};

/// The waves that the errors of a drive allow, or why they allow none.
struct AllowedWaves {
  Outcome outcome;
  int count = 0;
};

AllowedWaves allowed_waves(const std::vector<ErrorSeries>& series) {
  const auto [shortest, longest] = std::minmax_element(
      series.begin(), series.end(),
      [](const ErrorSeries& a, const ErrorSeries& b) { return mean_frames(a) < mean_frames(b); });
  const int disjoint = disjoint_stretches(*longest);
  if (constexpr int kFewest = kStretchesOfHalfWave * kFewestWaves; disjoint < kFewest)
    return {Outcome::failure(Outcome::Code::kTooFewData,
                             fmt::format("only {} disjoint stretch{} of {}, {} are needed",
                                         disjoint, disjoint == 1 ? "" : "es", longest->stretch,
                                         kFewest))};
  const double independent = independent_errors(grouped(*shortest, [](double e) { return e; }));
  if (independent < kFewestIndependent)
    return {Outcome::failure(
        Outcome::Code::kTooFewData,
        fmt::format("the errors over {} are correlated: {:.1f} independent ones, {:g} are needed",
                    shortest->stretch, independent, kFewestIndependent))};
  return {Outcome::ok(), std::min({kMostWaves, disjoint / kStretchesOfHalfWave,
                                   static_cast<int>(independent / kCorrelationsOfHalfWave)})};
}

}  // namespace

MeanDeviation deviation_of_mean(const std::vector<ErrorSeries>& series, const Term& term) {
  require(!series.empty(), "no series of errors");
  std::vector<GroupedSeries> groups;
  double sum = 0, squares = 0, count = 0;
  for (const ErrorSeries& one : series) {
    one.check();
    groups.push_back(grouped(one, term));
    for (const StretchError& e : one.errors) sum += term(e.error);
    for (const ErrorGroup& group : groups.back()) squares += group.sum * group.sum;
    count += static_cast<double>(one.errors.size());
  }
  MeanDeviation result;
  result.mean = sum / count;
  const AllowedWaves waves = allowed_waves(series);
  result.outcome = waves.outcome;
  if (!result.outcome) return result;
  // Rounding of equal errors.
  if (squares <= 1e-24 * sum * sum) {
    result.outcome = Outcome::failure(Outcome::Code::kDegenerate, "the errors do not vary");
    return result;
  }
  int first = groups.front().front().first_frame, last = first;
  for (const GroupedSeries& one : groups)
    for (const ErrorGroup& group : one) {
      first = std::min(first, group.first_frame);
      last = std::max(last, group.last_frame);
    }
  result.waves = waves.count;
  WaveSums sums(waves.count, first, last);
  for (const GroupedSeries& one : groups) sums.add(one);
  result.sigma = std::sqrt(sums.variance()) / count;
  return result;
}

}  // namespace placegraph
