#pragma once
#include <placegraph/frontend/features/feature_options.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/image/image.h>

#include <optional>
#include <vector>

namespace placegraph {

/// Disparities [px] (u_left - u_right, > 0) of points of the left image of a rectified pair.
///
/// ZNCC search along the row, sub-pixel by a parabola, checked from right to left. Nothing where
/// there is no distinct match. `expected_px`, empty or one per point, is the disparity around which
/// the search begins; the whole range is searched only if there is no match there.
std::vector<std::optional<double>> match_stereo(
    const Image& left, const Image& right, const std::vector<Eigen::Vector2f>& px_left,
    const StereoMatcherOptions& options,
    const std::vector<std::optional<double>>& expected_px = {});

}  // namespace placegraph
