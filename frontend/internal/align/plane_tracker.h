#pragma once
#include <placegraph/frontend/internal/align/aligner.h>
#include <placegraph/frontend/internal/align/null_distribution.h>
#include <placegraph/frontend/internal/align/template_finder.h>
#include <placegraph/frontend/internal/planes/plane_normal.h>

#include <optional>

namespace placegraph {

/// How the template may move; all but the first need a camera.
enum class PlaneModel {
  kHomography,  ///< 8 degrees of freedom
  kSe3Plane,    ///< a rigid motion before the plane, whose normal must be known first
  kSe2Plane,    ///< a motion along it
};
const std::vector<std::string>& plane_model_names();

struct PlaneTrackerOptions {
  /// Of the template from frame to frame. What a corner out of view is uncertain by is told by the
  /// covariance and is no loss as long as max_sigma_px bounds it.
  AlignOptions align = [] {
    AlignOptions options;
    options.max_sigma_px = 8;
    return options;
  }();
  PlaneModel model = PlaneModel::kHomography;
  int levels = 4;                ///< of the pyramid
  int max_samples = 3000;        ///< of a level
  int chance_trials = 12;        ///< pictures that calibrate what chance reaches
  double chance_deviations = 4;  ///< how far above chance the likeness has to be
  double rival_margin = 0.1;     ///< and, once lost, above what the template's own image repeats
  double max_area_change = 2;    ///< of the template's image from frame to frame, either way
  double min_area_px = 100;      ///< of the template's image
  double search_sigma = 0.06;  ///< of the corners where a lost template is looked for, in diagonals
  double search_shift = 0.3;   ///< of all corners together, in diagonals; grows by half of it with
                               ///< every further lost frame, up to the image's size
  double back_px = 2;          ///< forward and backward alignment agree to this once found again
  TemplateFinderOptions finder;
  double key_similarity = 0.85;  ///< of a view that becomes the second template, at least
  int key_interval = 5;          ///< frames from one to the next at least
  PlaneNormalOptions normal;
  void check() const;
};
void visit(OptionVisitor& field, PlaneTrackerOptions& options);

/// How a template was found in a frame.
enum class PlaneTrackSource { kPrediction, kLastPlace, kSecondTemplate, kSwarm, kFeatures };
const std::vector<std::string>& plane_track_source_names();

/// What is known of a frame. Unless `outcome` is ok the template is lost there and nothing but the
/// outcome counts: it says why.
struct PlaneTrack {
  Outcome outcome;
  PlaneTrackSource source = PlaneTrackSource::kPrediction;
  Eigen::Matrix3d H_cur_ref = Eigen::Matrix3d::Identity();
  std::vector<Eigen::Vector2d> corners_px;  ///< of the template, in the order they were given
  /// Of the four corners, [px^2], 2x2 blocks in their order: of the homography, whose eight degrees
  /// of freedom they are.
  Eigen::Matrix<double, 8, 8> covariance = Eigen::Matrix<double, 8, 8>::Zero();
  double similarity = 0;  ///< weighted correlation with the template where it is not occluded
  double robust_similarity = 0;  ///< robust_similarity: an occluded part counts as an error
  double visible_share = 0;      ///< of the template, in the image
  double inlier_share = 0;       ///< of what is in the image
  /// With a camera, once the views have told the plane's normal: the motion in units of the plane's
  /// distance, n^T X_ref = 1.
  std::optional<SE3> T_cur_ref;
  Outcome normal_outcome;  ///< not attempted without a camera
  Eigen::Vector3d normal_ref = Eigen::Vector3d::UnitZ();
  double normal_sigma_rad = 0;
};

/// Follows a planar region of one image through a sequence (direct alignment; Paper III of the
/// thesis the project builds on). Each frame is aligned with the first image, from the motion
/// predicted by the last two, so that nothing drifts. It counts as tracked where the likeness is
/// above what chance reaches (null_distribution), the template's image is a convex quadrilateral of
/// the same sense whose area changed by no leap, and the alignment's own gates hold. Where the
/// first image no longer resembles what is seen, a second template helps, cut from a recent frame
/// in which the first was confirmed: errors chain over one link at most (compare Matthews, Ishikawa
/// & Baker 2004, "The template update problem"). What is lost is looked for about its last place by
/// a swarm, then anywhere by point features, and taken back only if it also exceeds what the
/// template's own image repeats elsewhere and the way back agrees.
class PlaneTracker {
 public:
  /// `corners_px`: the quadrilateral, four corners in order around it, in `image_ref` (CV_8UC1).
  /// Throws ArgumentError if it is not convex, for options out of range, or for a model that needs
  /// a camera without one. `normal_ref`: of the plane, of unit length, where it is known.
  PlaneTracker(const Image& image_ref, const std::vector<Eigen::Vector2d>& corners_px,
               const PlaneTrackerOptions& options, const std::optional<Camera>& camera = {},
               const std::optional<Eigen::Vector3d>& normal_ref = {});

  /// Whether the template can be tracked at all: kTooFewData or kDegenerate if not.
  const Outcome& outcome() const { return outcome_; }
  const NullDistribution& chance() const { return chance_; }
  /// The likeness a frame must show, and one in which the template is found again.
  double least_similarity() const { return chance_.bound(options_.chance_deviations); }
  double least_similarity_found() const;

  /// The next frame; of any size, CV_8UC1.
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
  Outcome the_way_back(const View& view, const PlaneTrack& track) const;
  void remember(const View& view, const PlaneTrack& track);
  void add_motion(PlaneTrack& track);

  std::vector<Image> pyramid_ref_;
  std::vector<Eigen::Vector2d> corners_px_;
  PlaneTrackerOptions options_;
  std::optional<Camera> camera_;
  PlanarTemplate template_;
  TemplateFinder finder_;
  Random random_{1};
  Outcome outcome_;
  NullDistribution chance_;
  std::optional<PlaneNormalEstimator> normal_;
  PlaneNormal plane_;  ///< as far as it is known
  std::optional<TemplateView> key_;
  int frames_ = 0, key_frame_ = 0;
  int lost_ = 0;                                                 ///< frames since it was tracked
  Eigen::Matrix3d H_last_ref_ = Eigen::Matrix3d::Identity();     ///< where it was tracked last
  Eigen::Matrix3d H_last_before_ = Eigen::Matrix3d::Identity();  ///< from the frame before that
  Eigen::Vector2d image_size_px_;
};

}  // namespace placegraph
