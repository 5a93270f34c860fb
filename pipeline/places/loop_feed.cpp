#include <placegraph/graph/core/chi_squared.h>
#include <placegraph/graph/core/median.h>
#include <placegraph/graph/geometry/bounded_covariance.h>
#include <placegraph/pipeline/places/loop_feed.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

/// With fewer innovations the missing ones count as zero, so that less than three have no effect.
constexpr std::size_t kFewest = 6;
constexpr std::size_t kNewest = 200;  // innovations that are used
// Bound of the search: deviations a hundred times as large. Chosen.
constexpr double kMostFactor = 1e4;

/// The least factor on `of_loop` with which the squared errors are consistent; `squares(f)` is
/// their median with the factor f and falls with it.
double least_consistent(const auto& squares) {
  const double expected = chi_squared_quantile(0.5, 6);
  if (squares(1.0) <= expected) return 1;
  double low = 0, high = std::log(kMostFactor);
  for (int i = 0; i < 30; ++i) {
    const double middle = 0.5 * (low + high);
    (squares(std::exp(middle)) > expected ? low : high) = middle;
  }
  return std::exp(high);
}

/// Covariance of position and rotation; if the scale is measured, too, it is uncertain.
Matrix6d covariance_of(const Loop& loop) {
  if (loop.information(6, 6) > 0) return bounded_covariance(loop.information).topLeftCorner<6, 6>();
  return bounded_covariance(Matrix6d(loop.information.topLeftCorner<6, 6>()));
}

}  // namespace

double LoopFeed::factor() const {
  return least_consistent([&](double factor) {
    std::vector<double> squares(kFewest - std::min(innovations_.size(), kFewest), 0.0);
    for (const Innovation& each : innovations_) {
      const Matrix6d covariance = factor * each.of_loop + each.of_map;
      squares.push_back(each.error.dot(covariance.ldlt().solve(each.error)));
    }
    return median_of(std::move(squares));
  });
}

void LoopFeed::add(const std::vector<Loop>& stated, PlaceMapper& mapper) {
  if (stated.empty()) return;
  const Loop& newest = stated.back();
  const auto predicted = mapper.predicted(newest.match, newest.query);
  const double known = factor();
  for (const Loop& loop : stated) {
    const std::size_t number = mapper.add_loop(loop);
    mapper.scale_loop_covariance(number, known);
    added_.push_back({number, known});
  }
  if (!predicted || predicted->covariance.topLeftCorner<6, 6>().isZero(0)) return;
  const Vector7d error = (predicted->S_a_b.inverse() * newest.S_match_query()).log();
  innovations_.push_back(
      {error.head<6>(), covariance_of(newest), predicted->covariance.topLeftCorner<6, 6>()});
  if (innovations_.size() > kNewest) innovations_.erase(innovations_.begin());
}

void LoopFeed::finish(PlaceMapper& mapper) {
  const double last = factor();
  for (Added& loop : added_) {
    mapper.scale_loop_covariance(loop.number, last / loop.factor);
    loop.factor = last;
  }
}

}  // namespace placegraph
