#pragma once
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/core/random.h>
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/measurements/landmark.h>

#include <array>
#include <vector>

namespace placegraph {

/// A feature of the left image and its row offset in the right image, 0 in a rectified pair.
struct RowSample {
  Eigen::Vector2d ray = Eigen::Vector2d::Zero();  ///< x and y of the left camera's ray at z = 1
  double rows = 0;                                ///< v_right - v_left [px]
  double disparity_px = 0;                        ///< u_left - u_right
  double sigma_px = 1;  ///< standard deviation of `rows`, by the features' size
};

/// Samples of one pair: mutually best matches whose rows differ by at most `band_px`.
///
/// Their disparity may have either sign.
std::vector<RowSample> row_samples(const Camera& camera, const std::vector<Feature>& left,
                                   const std::vector<Feature>& right, double band_px);

/// Row offset of the right camera as a polynomial over the left image.
///
/// Constant (pitch, shift), by x (roll), by y (zoom), by xy (yaw) and by y^2 (pitch).
struct RowOffsets {
  Outcome outcome;
  std::array<double, 5> rows{};  ///< coefficients of 1, x, y, xy, y^2 of the left camera's ray [px]
  int matches = 0, inliers = 0;  ///< the inliers agree with the model to about two pixels
  double rms_px = 0;             ///< root mean square of the model's rows at the inliers
  int behind = 0;                ///< inliers whose disparity is clearly negative

  double at(const Eigen::Vector2d& ray) const {
    return rows[0] + rows[1] * ray.x() + rows[2] * ray.y() + rows[3] * ray.x() * ray.y() +
           rows[4] * ray.y() * ray.y();
  }
};

/// Robust fit of the row offsets.
///
/// RANSAC over the first three terms, then reweighted least squares over all, with a prior of zero
/// for terms that the samples do not determine. Outcomes: too few data, no consensus.
RowOffsets fit_row_offsets(const std::vector<RowSample>& samples, Random& random);

}  // namespace placegraph
