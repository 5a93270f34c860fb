#pragma once
#include <placegraph/frontend/align/aligner.h>
#include <placegraph/frontend/align/null_distribution.h>
#include <placegraph/frontend/align/template_finder.h>
#include <placegraph/frontend/planes/plane_normal.h>

#include <optional>

namespace placegraph {

/// Motion model of the template; all but the first need a camera.
enum class PlaneModel {
  kHomography,  ///< 8 degrees of freedom
  kSe3Plane,    ///< a rigid motion before the plane, whose normal must be known first
  kSe2Plane,    ///< a motion along the plane
};
const std::vector<std::string>& plane_model_names();

/// Options of the plane tracker.
struct PlaneTrackerOptions {
  /// Alignment of the template from frame to frame. The covariance includes the uncertainty of a
  /// corner out of view, which is acceptable up to max_sigma_px.
  AlignOptions align = [] {
    AlignOptions options;
    options.max_sigma_px = 8;
    return options;
  }();
  PlaneModel model = PlaneModel::kHomography;
  int levels = 4;          ///< levels of the pyramid
  int max_samples = 3000;  ///< maximum samples of a level
  int chance_trials = 12;  ///< surrogate images for the null distribution
  double chance_deviations =
      4;  ///< least deviations of the similarity above the null distribution's mean
  double rival_margin = 0.1;  ///< once lost, least similarity above the template's repetitions
  double max_area_change =
      2;                     ///< maximum factor of the area of the template's image between frames
  double min_area_px = 100;  ///< minimum area of the template's image
  double search_sigma = 0.06;  ///< deviation of the corners in the search when lost [diagonals]
  double search_shift =
      0.3;  ///< common deviation of all corners [diagonals]; grows by half of it with
  ///< every further lost frame, up to the image's size
  double back_px = 2;  ///< maximum forward-backward error of a template found again
  TemplateFinderOptions finder;
  double key_similarity = 0.85;  ///< minimum similarity of a view that becomes the second template
  int key_interval = 5;          ///< minimum number of frames between second templates
  PlaneNormalOptions normal;
  void check() const;
};
void visit(OptionVisitor& field, PlaneTrackerOptions& options);

/// Method by which a template was found in a frame.
enum class PlaneTrackSource { kPrediction, kLastPlace, kSecondTemplate, kSwarm, kFeatures };
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

  /// Whether the template can be tracked: kTooFewData or kDegenerate if not.
  const Outcome& outcome() const { return outcome_; }
  const NullDistribution& chance() const { return chance_; }
  /// Least similarity of a tracked frame; least_similarity_found(): of a template found again.
  double least_similarity() const { return chance_.bound(options_.chance_deviations); }
  double least_similarity_found() const;

  /// Tracks the template in the next frame (CV_8UC1, of any size).
  [[nodiscard]] PlaneTrack track(const Image& image);

 private:
  struct View;
  struct TemplateView {
    PlanarTemplate planar_template;
    std::vector<Eigen::Vector2d> corners_px;
    Eigen::Matrix3d H_key_ref;
    Eigen::Matrix<double, 8, 8> covariance;
  };

  PlanarWarp warp_at(const Eigen::Matrix3d& H_cur_ref) const;
  Outcome judge(const AlignResult& result, const Eigen::Matrix3d& H_cur_ref, double least) const;
  PlaneTrack aligned(const View& view, const Eigen::Matrix3d& H_start, const AlignOptions& options,
                     double least, PlaneTrackSource source) const;
  PlaneTrack follow(const View& view) const;
  PlaneTrack by_second_template(const View& view) const;
  PlaneTrack search(const View& view) const;
  PlaneTrack find(const View& view);
  Outcome backward_check(const View& view, const PlaneTrack& track) const;
  void remember(const View& view, const PlaneTrack& track);
  void add_motion(PlaneTrack& track);

  std::vector<Image> pyramid_ref_;
  std::vector<Eigen::Vector2d> corners_px_;
  PlaneTrackerOptions options_;
  std::optional<Camera> camera_;
  PlanarTemplate template_;
  TemplateFinder finder_;
  Outcome outcome_;
  NullDistribution chance_;
  std::optional<PlaneNormalEstimator> normal_;
  PlaneNormal plane_;  ///< current estimate of the plane
  std::optional<TemplateView> key_;
  int frames_ = 0, key_frame_ = 0;
  int lost_ = 0;  ///< frames since the template was tracked last
  Eigen::Matrix3d H_last_ref_ =
      Eigen::Matrix3d::Identity();  ///< where the template was tracked last
  Eigen::Matrix3d H_last_before_ =
      Eigen::Matrix3d::Identity();  ///< motion from the frame before that
  Eigen::Vector2d image_size_px_;
};

}  // namespace placegraph
