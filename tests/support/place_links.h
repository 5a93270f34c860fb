#pragma once
#include <numbers>

#include <gtest/gtest.h>
#include <placegraph/pipeline/places/place_mapper.h>

#include "tests/support/scenes/scene.h"

namespace placegraph::test {

inline Matrix6d information_of(double sigma_m, double sigma_rad) {
  Vector6d diagonal;
  diagonal.head<3>().setConstant(1 / (sigma_m * sigma_m));
  diagonal.tail<3>().setConstant(1 / (sigma_rad * sigma_rad));
  return diagonal.asDiagonal();
}

inline PlaceMapper::Link link(std::int64_t from, const SE3& T_from_this, double sigma_m = 0.05,
                              double sigma_rad = 0.005) {
  return {KeyframeId(from), T_from_this, information_of(sigma_m, sigma_rad),
          ConstraintSource::kOdometry};
}

inline Loop loop(std::int64_t query, std::int64_t match, const SE3& T_match_query, double sigma_m,
                 double sigma_rad) {
  Loop loop{KeyframeId(query), KeyframeId(match), T_match_query};
  loop.information.topLeftCorner<6, 6>() = information_of(sigma_m, sigma_rad);
  return loop;
}

/// One that tells the ratio of units too.
inline Loop scaled_loop(std::int64_t query, std::int64_t match, const SE3& T_match_query,
                        double scale) {
  Loop result = loop(query, match, T_match_query, 0.01, 0.001);
  result.scale_match_query = scale;
  result.information(6, 6) = 1e4;
  return result;
}

inline const SE3 kShort = pose({0, 0.02, 0}, {0.1, 0, 0.5}),
                 kLong = pose({0, 0.05, 0}, {0.2, 0, 5});
inline constexpr double kDepth_m = 10;  // a place reaches 3 m

inline PlaceGraph optimized(PlaceMapper& mapper) {
  const IncrementalStep step = mapper.finish();
  EXPECT_TRUE(step.outcome) << step.outcome.reason;
  return mapper.place_graph();
}

/// A square of 5 m sides whose odometry turns a little too much: keyframes 0 to 4, the last back at
/// the first; 5 hangs on the place of 4.
inline PlaceMapper square(bool merge = false) {
  PlaceOptions options;
  options.merge = merge;
  PlaceMapper mapper(options);
  const SE3 side = pose({0, std::numbers::pi / 2 + 0.04, 0}, {0, 0, 5.2});
  mapper.add_keyframe(KeyframeId(0), std::nullopt, {}, kDepth_m);
  for (int i = 1; i <= 4; ++i)
    mapper.add_keyframe(KeyframeId(i), link(i - 1, side, 0.1, 0.03), {}, kDepth_m);
  mapper.add_keyframe(KeyframeId(5), link(4, kShort), {}, kDepth_m);
  return mapper;
}

}  // namespace placegraph::test
