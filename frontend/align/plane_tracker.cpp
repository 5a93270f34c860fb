#include <placegraph/frontend/align/aligner.h>
#include <placegraph/frontend/align/alignment_covariance.h>
#include <placegraph/frontend/align/null_distribution.h>
#include <placegraph/frontend/align/plane_tracker.h>
#include <placegraph/frontend/flow/grey_pyramid.h>
#include <placegraph/frontend/planes/plane_normal.h>
#include <placegraph/frontend/planes/template_finder.h>
#include <placegraph/graph/core/error.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

using Code = Outcome::Code;
using Eigen::Matrix3d;
using Eigen::Vector2d;

/// Signed area of a quadrilateral; nothing if it is not convex.
std::optional<double> convex_area(const std::vector<Vector2d>& corners) {
  double area = 0, least = 0, greatest = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vector2d &a = corners[i], &b = corners[(i + 1) % 4], &c = corners[(i + 2) % 4];
    const Vector2d in = b - a, out = c - b;
    const double cross = in.x() * out.y() - in.y() * out.x();
    least = i == 0 ? cross : std::min(least, cross);
    greatest = i == 0 ? cross : std::max(greatest, cross);
    area += a.x() * b.y() - a.y() * b.x();
  }
  if (!std::isfinite(area) || !(least * greatest > 0)) return std::nullopt;
  return area / 2;
}

/// Corners mapped by a homography; empty if one is mapped beyond the horizon.
std::vector<Vector2d> mapped(const Matrix3d& H, const std::vector<Vector2d>& corners) {
  std::vector<Vector2d> there;
  for (const Vector2d& corner : corners) {
    const auto px = map_pixel(H, corner);
    if (!px) return {};
    there.push_back(*px);
  }
  return there;
}

/// Area of the image of convex corners [px^2]; 0 if no camera can see them so.
double seen_area_px(const Matrix3d& H, const std::vector<Vector2d>& corners) {
  const std::vector<Vector2d> there = mapped(H, corners);
  if (there.empty()) return 0;
  const auto from = convex_area(corners), to = convex_area(there);
  return from && to && *from * *to > 0 ? std::abs(*to) : 0;
}

/// Covariance of the corners mapped by a warp.
Eigen::Matrix<double, 8, 8> covariance_of(const PlanarWarp& warp,
                                          const std::vector<Vector2d>& corners,
                                          const Eigen::MatrixXd& covariance) {
  Eigen::MatrixXd J(8, warp.dof());
  for (int c = 0; c < 4; ++c)
    J.middleRows<2>(2 * c) = warp.pixel_jacobian(corners[static_cast<std::size_t>(c)]);
  return J * covariance * J.transpose();
}

/// d(H px) / d px.
Eigen::Matrix2d slope_at(const Matrix3d& H, const Vector2d& px) {
  const Eigen::Vector3d q = H * px.homogeneous();
  Eigen::Matrix<double, 2, 3> by_q;
  by_q << 1 / q.z(), 0, -q.x() / (q.z() * q.z()), 0, 1 / q.z(), -q.y() / (q.z() * q.z());
  return by_q * H.leftCols<2>();
}

AlignOptions swarm_of(AlignOptions options) {
  options.optimizer = AlignOptimizer::kSwarmEsm;
  return options;
}

PlaneTrack lost(const Outcome& why, PlaneTrackSource source) {
  PlaneTrack track;
  track.outcome = why;
  track.source = source;
  return track;
}

}  // namespace

const std::vector<std::string>& plane_track_source_names() {
  static const std::vector<std::string> names = {"prediction", "last_place", "second_template",
                                                 "swarm", "features"};
  return names;
}

/// The state of a tracker.
struct PlaneTracker::Impl {
  Impl(const Image& image_ref, const std::vector<Eigen::Vector2d>& corners_px,
       const PlaneTrackerOptions& options, const std::optional<Camera>& camera,
       const std::optional<Eigen::Vector3d>& normal_ref);
  double least_similarity() const { return chance_.bound(options_.chance_deviations); }
  double least_similarity_found() const;
  PlaneTrack track(const Image& image);

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

struct PlaneTracker::Impl::View {
  const Image& image;
  std::vector<Image> pyramid;
};

PlaneTracker::Impl::Impl(const Image& image_ref, const std::vector<Vector2d>& corners_px,
                         const PlaneTrackerOptions& options, const std::optional<Camera>& camera,
                         const std::optional<Eigen::Vector3d>& normal_ref)
    : pyramid_ref_(grey_pyramid(image_ref, options.levels)),
      corners_px_(corners_px),
      options_(options),
      camera_(camera),
      template_(image_ref, corners_px, options.levels, options.max_samples),
      finder_(image_ref, corners_px, options.finder),
      image_size_px_(image_ref.cols, image_ref.rows) {
  options.check();
  require(corners_px.size() == 4 && convex_area(corners_px),
          "plane tracker: four corners of a convex quadrilateral needed");
  require(camera || (options.model == PlaneModel::kHomography && !normal_ref),
          "plane tracker: this model needs a camera");
  if (normal_ref) {
    require(std::abs(normal_ref->norm() - 1) < 1e-6, "plane tracker: normal not of unit length");
    plane_.outcome = Outcome::ok();
    plane_.normal_ref = *normal_ref;
  } else if (camera) {
    normal_.emplace(camera->K(), corners_px, options.normal);
    plane_ = normal_->estimate();
  }
  const int samples = static_cast<int>(template_.levels()[0].samples.size());
  if (samples < options.align.min_samples) {
    outcome_ =
        Outcome::failure(Code::kTooFewData, "a template of " + std::to_string(samples) + " pixels");
    return;
  }
  const double promised_px = promised_corner_sigma_px(
      template_, 0, template_.homography(Matrix3d::Identity()), 2 * std::sqrt(10.0));
  if (!(promised_px <= options.align.max_sigma_px)) {
    outcome_ = Outcome::failure(Code::kDegenerate, "the template has too little texture");
    return;
  }
  chance_ = null_distribution(image_ref, corners_px, template_, swarm_of(options.align),
                              options.chance_trials);
  outcome_ = Outcome::ok();
}

double PlaneTracker::Impl::least_similarity_found() const {
  return std::max(least_similarity(), chance_.rival + options_.rival_margin);
}

/// Warp of the model's family once the plane's normal is known, else a homography.
PlanarWarp PlaneTracker::Impl::warp_at(const Matrix3d& H_cur_ref) const {
  if (options_.model == PlaneModel::kHomography || !plane_.outcome)
    return template_.homography(H_cur_ref);
  const Plane plane{plane_.normal_ref, 1};
  if (options_.model == PlaneModel::kSe3Plane)
    return PlanarWarp::rigid_motion(camera_->K(), SE3(), plane).at(H_cur_ref);
  return PlanarWarp::planar_motion(camera_->K(), SE2(), plane).at(H_cur_ref);
}

Outcome PlaneTracker::Impl::judge(const AlignResult& result, const Matrix3d& H_cur_ref,
                                  double least) const {
  if (!result.outcome) return result.outcome;
  const double area_px = seen_area_px(H_cur_ref, corners_px_);
  if (area_px < options_.min_area_px)
    return Outcome::failure(Code::kInconsistent, "implausible or very small image of the template");
  if (lost_ == 0) {
    const double change = area_px / seen_area_px(H_last_ref_, corners_px_);
    if (std::max(change, 1 / change) > options_.max_area_change)
      return Outcome::failure(Code::kInconsistent,
                              "area changed by a factor of " + std::to_string(change));
  }
  if (result.robust_similarity < least)
    return Outcome::failure(Code::kInconsistent, "similarity " +
                                                     std::to_string(result.robust_similarity) +
                                                     ", " + std::to_string(least) + " needed");
  return Outcome::ok();
}

/// The first template aligned from a start.
PlaneTrack PlaneTracker::Impl::aligned(const View& view, const Matrix3d& H_start,
                                       const AlignOptions& options, double least,
                                       PlaneTrackSource source) const {
  const AlignResult result = align(template_, view.pyramid, warp_at(H_start), options);
  PlaneTrack track;
  track.source = source;
  track.outcome = judge(result, result.warp.H_cur_ref(), least);
  track.similarity = result.agreement;
  track.robust_similarity = result.robust_similarity;
  track.visible_share = result.visible_share;
  track.inlier_share = result.inlier_share;
  if (!track.outcome) return track;
  track.H_cur_ref = result.warp.H_cur_ref();
  track.corners_px = mapped(track.H_cur_ref, corners_px_);
  track.covariance = covariance_of(result.warp, corners_px_, result.covariance);
  return track;
}

/// Aligns from the predicted position, then from the last position.
PlaneTrack PlaneTracker::Impl::follow(const View& view) const {
  const Matrix3d H_predicted = H_last_before_ * H_last_ref_;
  const double area_px = seen_area_px(H_last_ref_, corners_px_);
  const double change = seen_area_px(H_predicted, corners_px_) / area_px;
  const bool plausible = std::max(change, 1 / change) < std::sqrt(options_.max_area_change);
  if (plausible) {
    const PlaneTrack track = aligned(view, H_predicted, options_.align, least_similarity(),
                                     PlaneTrackSource::kPrediction);
    if (track.outcome || template_.corner_distance_px(H_predicted, H_last_ref_) < 1) return track;
  }
  return aligned(view, H_last_ref_, options_.align, least_similarity(),
                 PlaneTrackSource::kLastPlace);
}

/// Aligns with the second template; from there with the first, whose result has priority.
PlaneTrack PlaneTracker::Impl::by_second_template(const View& view) const {
  const auto source = PlaneTrackSource::kSecondTemplate;
  if (!key_) return lost(Outcome::failure(Code::kTooFewData, "no second template"), source);
  const Matrix3d H_ref_key = key_->H_key_ref.inverse();
  const AlignResult result =
      align(key_->planar_template, view.pyramid,
            key_->planar_template.homography(H_last_ref_ * H_ref_key), options_.align);
  const Matrix3d H_cur_key = result.warp.H_cur_ref(), H_cur_ref = H_cur_key * key_->H_key_ref;
  const Outcome outcome = judge(result, H_cur_ref, least_similarity());
  if (!outcome) return lost(outcome, source);
  PlaneTrack track = aligned(view, H_cur_ref, options_.align, least_similarity(), source);
  if (track.outcome) return track;
  track.outcome = Outcome::ok();
  track.H_cur_ref = H_cur_ref;
  track.corners_px = mapped(H_cur_ref, corners_px_);
  track.covariance = covariance_of(result.warp, key_->corners_px, result.covariance);
  Eigen::Matrix<double, 8, 8> slope = Eigen::Matrix<double, 8, 8>::Zero();
  for (int c = 0; c < 4; ++c)
    slope.block<2, 2>(2 * c, 2 * c) =
        slope_at(H_cur_key, key_->corners_px[static_cast<std::size_t>(c)]);
  track.covariance += slope * key_->covariance * slope.transpose();
  track.similarity = result.agreement;
  track.robust_similarity = result.robust_similarity;
  track.visible_share = result.visible_share;
  track.inlier_share = result.inlier_share;
  return track;
}

/// Searches about the last position; the range grows with the number of lost frames.
PlaneTrack PlaneTracker::Impl::search(const View& view) const {
  AlignOptions options = swarm_of(options_.align);
  const double widest = image_size_px_.norm() / template_.diagonal_px();
  options.search_sigma = options_.search_sigma;
  options.search_shift_sigma = std::min({options_.search_shift * (1 + 0.5 * lost_), widest, 10.0});
  options.swarm.seed += static_cast<std::uint64_t>(frames_);
  PlaneTrack track =
      aligned(view, H_last_ref_, options, least_similarity_found(), PlaneTrackSource::kSwarm);
  if (track.outcome) track.outcome = backward_check(view, track);
  return track;
}

/// Searches the whole image by point features.
PlaneTrack PlaneTracker::Impl::find(const View& view) {
  PlaneTrack track = lost(Outcome::failure(Code::kNoConsensus, "not found by features either"),
                          PlaneTrackSource::kFeatures);
  Random random(options_.align.swarm.seed, "template", {frames_});
  for (const FoundPlace& place : finder_.find(view.image, random)) {
    if (seen_area_px(place.H_cur_ref, corners_px_) < options_.min_area_px) continue;
    PlaneTrack there = aligned(view, place.H_cur_ref, options_.align, least_similarity_found(),
                               PlaneTrackSource::kFeatures);
    if (there.outcome) there.outcome = backward_check(view, there);
    if (there.outcome) return there;
    track = there;
  }
  return track;
}

/// Aligns the patch found in this frame with the first image, from a start a few pixels off; it
/// must end at the template's corners.
Outcome PlaneTracker::Impl::backward_check(const View& view, const PlaneTrack& track) const {
  // Distance at which the search back begins. Chosen.
  constexpr double kBesidePx = 3;
  const PlanarTemplate seen(view.image, track.corners_px, options_.levels, options_.max_samples);
  const Matrix3d H_ref_cur = track.H_cur_ref.inverse();
  Matrix3d beside = Matrix3d::Identity();
  beside(0, 2) = kBesidePx;
  const AlignResult back =
      align(seen, pyramid_ref_, seen.homography(beside * H_ref_cur), options_.align);
  if (!back.outcome) return back.outcome;
  double apart_px = 0;
  for (std::size_t c = 0; c < 4; ++c) {
    const auto there = map_pixel(back.warp.H_cur_ref(), track.corners_px[c]);
    apart_px = there ? std::max(apart_px, (*there - corners_px_[c]).norm()) : 1e9;
  }
  if (apart_px > std::max(options_.back_px, 3 * back.corner_sigma_px))
    return Outcome::failure(Code::kInconsistent,
                            "the backward alignment ends " + std::to_string(apart_px) + " px off");
  return Outcome::ok();
}

void PlaneTracker::Impl::remember(const View& view, const PlaneTrack& track) {
  if (!track.outcome) {
    ++lost_;
    H_last_before_ = Matrix3d::Identity();
    return;
  }
  H_last_before_ =
      lost_ == 0 ? Matrix3d(track.H_cur_ref * H_last_ref_.inverse()) : Matrix3d::Identity();
  H_last_ref_ = track.H_cur_ref;
  lost_ = 0;
  const bool whole =
      track.visible_share > 0.95 && track.robust_similarity >= options_.key_similarity;
  const bool due = !key_ || frames_ - key_frame_ >= options_.key_interval;
  if (!whole || !due || track.source == PlaneTrackSource::kSecondTemplate) return;
  key_.emplace(TemplateView{
      PlanarTemplate(view.image, track.corners_px, options_.levels, options_.max_samples),
      track.corners_px, track.H_cur_ref, track.covariance});
  key_frame_ = frames_;
}

void PlaneTracker::Impl::add_motion(PlaneTrack& track) {
  if (!camera_ || !track.outcome) return;
  if (normal_ && normal_->add(track.H_cur_ref)) plane_ = normal_->estimate();
  track.normal_outcome = plane_.outcome;
  track.normal_ref = plane_.normal_ref;
  track.normal_sigma_rad = plane_.sigma_rad;
  if (plane_.outcome)
    track.T_cur_ref = motion_from_homography(camera_->K(), track.H_cur_ref, plane_.normal_ref);
}

PlaneTrack PlaneTracker::Impl::track(const Image& image) {
  if (!outcome_) return lost(outcome_, PlaneTrackSource::kPrediction);
  const View view{image, grey_pyramid(image, options_.levels)};
  PlaneTrack track = follow(view);
  const Outcome why = track.outcome;
  if (!track.outcome) track = by_second_template(view);
  if (!track.outcome) track = search(view);
  if (!track.outcome) track = find(view);
  if (!track.outcome) track = lost(why, track.source);
  remember(view, track);
  add_motion(track);
  ++frames_;
  return track;
}

PlaneTracker::PlaneTracker(const Image& image_ref, const std::vector<Vector2d>& corners_px,
                           const PlaneTrackerOptions& options, const std::optional<Camera>& camera,
                           const std::optional<Eigen::Vector3d>& normal_ref)
    : impl_(std::make_unique<Impl>(image_ref, corners_px, options, camera, normal_ref)) {}
PlaneTracker::~PlaneTracker() = default;
PlaneTracker::PlaneTracker(PlaneTracker&&) noexcept = default;
PlaneTracker& PlaneTracker::operator=(PlaneTracker&&) noexcept = default;
const Outcome& PlaneTracker::outcome() const { return impl_->outcome_; }
double PlaneTracker::least_similarity() const { return impl_->least_similarity(); }
double PlaneTracker::least_similarity_found() const { return impl_->least_similarity_found(); }
PlaneTrack PlaneTracker::track(const Image& image) { return impl_->track(image); }

}  // namespace placegraph
