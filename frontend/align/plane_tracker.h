#pragma once
#include <placegraph/frontend/align/align_options.h>
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/geometry/se3.h>
#include <placegraph/graph/image/image.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Method by which a template was found in a frame.
enum class PlaneTrackSource { kPrediction, kLastPlace, kSecondTemplate, kSwarm, kFeatures };
/// Names of the methods, in their order.
const std::vector<std::string>& plane_track_source_names();

/// State of the template in a frame.
///
/// Unless `outcome` is ok the template is lost there and only the outcome, which has the reason, is
/// meaningful.
struct PlaneTrack {
  Outcome outcome;
  PlaneTrackSource source = PlaneTrackSource::kPrediction;
  Eigen::Matrix3d H_cur_ref = Eigen::Matrix3d::Identity();
  std::vector<Eigen::Vector2d> corners_px;  ///< corners of the template, in the given order
  /// Covariance of the four corners [px^2], 2x2 blocks in their order; the corners are the eight
  /// degrees of freedom of the homography.
  Eigen::Matrix<double, 8, 8> covariance = Eigen::Matrix<double, 8, 8>::Zero();
  double similarity = 0;  ///< weighted correlation with the template where it is not occluded
  double robust_similarity = 0;  ///< see robust_similarity(): an occluded part counts as an error
  double visible_share = 0;      ///< share of the template in the image
  double inlier_share = 0;       ///< share of inliers among the samples in the image
  /// Motion in units of the plane's distance, n^T X_ref = 1; only with a camera and once the views
  /// determine the plane's normal.
  std::optional<SE3> T_cur_ref;
  Outcome normal_outcome;  ///< not attempted without a camera
  Eigen::Vector3d normal_ref = Eigen::Vector3d::UnitZ();
  double normal_sigma_rad = 0;
};

/// Tracks a planar region of one image through a sequence by direct alignment.
///
/// After Paper III of the thesis the project builds on. Each frame is aligned with the first image,
/// from the motion predicted by the last two frames, so that there is no drift. The template counts
/// as tracked if the similarity is above the null distribution, the template's image is a convex
/// quadrilateral of the same orientation whose area changed continuously, and the alignment's own
/// gates pass. If the first image no longer resembles the frame, a second template is used, taken
/// from a recent frame in which the first was confirmed: errors accumulate over one step at most
/// (compare Matthews, Ishikawa & Baker 2004, "The template update problem"). A lost template is
/// searched about its last position by a swarm, then anywhere by point features. It is accepted
/// only if its similarity also exceeds that of repetitions in the template's own image and the
/// backward alignment agrees.
class PlaneTracker {
 public:
  /// Takes the template from the quadrilateral `corners_px` of `image_ref` (CV_8UC1).
  ///
  /// The four corners are in order around it. `normal_ref`: unit normal of the plane, if known.
  /// Throws ArgumentError if the quadrilateral is not convex, for options out of range, or if the
  /// model needs a camera and there is none.
  PlaneTracker(const Image& image_ref, const std::vector<Eigen::Vector2d>& corners_px,
               const PlaneTrackerOptions& options, const std::optional<Camera>& camera = {},
               const std::optional<Eigen::Vector3d>& normal_ref = {});
  ~PlaneTracker();
  PlaneTracker(PlaneTracker&& other) noexcept;
  PlaneTracker& operator=(PlaneTracker&& other) noexcept;

  /// Whether the template can be tracked: kTooFewData or kDegenerate if not.
  const Outcome& outcome() const;
  /// Least similarity of a tracked frame.
  double least_similarity() const;
  /// Least similarity of a template that is found again.
  double least_similarity_found() const;
  /// Tracks the template in the next frame (CV_8UC1, of any size).
  [[nodiscard]] PlaneTrack track(const Image& image);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace placegraph
