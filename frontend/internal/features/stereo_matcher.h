#pragma once
#include <placegraph/frontend/features/feature_options.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/image/image.h>

#include <optional>
#include <vector>

namespace placegraph {

/// Disparity [px] (u_left - u_right, > 0) of points of the left eye of a rectified pair: ZNCC
/// search along the row, parabola to sub-pixels, checked from right to left. Nothing where there is
/// no distinct match. `expected_px`, empty or one a point, tells where a disparity is looked for
/// first; the whole range is searched only where there is none about it.
std::vector<std::optional<double>> match_stereo(
    const Image& left, const Image& right, const std::vector<Eigen::Vector2f>& px_left,
    const StereoMatcherOptions& options,
    const std::vector<std::optional<double>>& expected_px = {});

}  // namespace placegraph
