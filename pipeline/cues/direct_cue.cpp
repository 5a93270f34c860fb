#include <placegraph/frontend/flow/grey_pyramid.h>
#include <placegraph/frontend/planes/dominant_surface.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/median.h>
#include <placegraph/pipeline/cues/direct_cue.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

/// Minimum relative standard deviation of a plane's distance: surfaces are uneven. Chosen.
constexpr double kEvennessDistance = 0.005;
/// Minimum standard deviation of a plane's normal. Chosen.
constexpr double kEvenness_deg = 0.1;
/// Standard deviation of a vehicle's pitch and roll about their mean; monocular. Chosen.
constexpr double kNodding_deg = 0.4;
/// Relative standard deviation of the camera height; monocular. Chosen.
constexpr double kSigmaHeight = 0.01;
/// Maximum difference of forward and backward motion, in standard deviations. Chosen.
constexpr double kMaxDisagreement = 5;

using Eigen::Matrix3d;
using Eigen::Vector2f;
using Eigen::Vector3d;

/// Covariance of n / d from the standard deviations of normal and distance.
Matrix3d covariance_of(const Vector3d& g, double sigma_normal_rad, double sigma_log_distance) {
  const Vector3d n = g.normalized();
  const Matrix3d along = n * n.transpose();
  return g.squaredNorm() * (sigma_normal_rad * sigma_normal_rad * (Matrix3d::Identity() - along) +
                            sigma_log_distance * sigma_log_distance * along);
}

/// Step of a regular grid, from its pixels in row order.
double step_of(const std::vector<Vector2f>& px) {
  double step = 64;
  for (std::size_t i = 1; i < px.size(); ++i)
    if (px[i].y() == px[i - 1].y() && px[i].x() > px[i - 1].x())
      step = std::min(step, static_cast<double>(px[i].x() - px[i - 1].x()));
  return step;
}

DirectMotion no_reference() {
  DirectMotion motion;
  motion.outcome = Outcome::failure(Outcome::Code::kTooFewData, "no surface is known");
  return motion;
}

}  // namespace

DirectCue::DirectCue(const DirectCueOptions& options, const Calibration& calibration,
                     const StereoMatcherOptions& stereo, bool several)
    : options_(options),
      calibration_(calibration),
      depth_(calibration, stereo),
      several_(several),
      mono_(calibration.baseline_m <= 0 && !calibration.depth) {
  options_.check();
  reset();
}

void DirectCue::reset() {
  ground_.reset();
  if (calibration_.camera_height_m)
    ground_.emplace(options_.surface, calibration_.camera,
                    Plane{mounting_, *calibration_.camera_height_m});
  mounting_variance_rad2_ = std::pow(kMountingSigma_deg * kRadPerDeg, 2);
  dominant_g_.setZero();
  reference_ = last_reference_ = DirectReference();
}

void DirectCue::see(const Frame& frame) {
  frame_ = frame;
  pyramid_ = grey_pyramid(frame.image, options_.align.levels);
}

DirectMotion DirectCue::align(const MotionGuess& guess) const {
  if (!has_reference()) return no_reference();
  return align_motion(reference_, pyramid_, guess.T_ref_cur, guess);
}

DirectMotion DirectCue::search(const MotionGuess& guess, const Vector6d& sigmas) const {
  if (!has_reference()) return no_reference();
  const SE3 start = search_motion(reference_, pyramid_, guess.T_ref_cur, sigmas, options_.align);
  return align_motion(reference_, pyramid_, start, guess);
}

int DirectCue::grid_step(int count) const {
  const Camera& camera = calibration_.camera;
  return std::max(
      2, static_cast<int>(std::sqrt(static_cast<double>(camera.width) * camera.height / count)));
}

/// The pixel with the largest change along its row, as required for stereo, in every cell of a
/// regular grid.
std::vector<Vector2f> DirectCue::grid(int count) const {
  const Camera& camera = calibration_.camera;
  const int step = grid_step(count);
  const Image& image = pyramid_[0];
  std::vector<Vector2f> px;
  for (int v0 = 1; v0 + step < camera.height; v0 += step)
    for (int u0 = 1; u0 + step < camera.width; u0 += step) {
      float best = -1;
      Vector2f at;
      for (int v = v0; v < v0 + step; v += 2)
        for (int u = u0; u < u0 + step; u += 2) {
          if (!frame_.mask.empty() && !frame_.mask.at<std::uint8_t>(v, u)) continue;
          const float du = image.at<float>(v, u + 1) - image.at<float>(v, u - 1);
          if (std::abs(du) <= best) continue;
          best = std::abs(du);
          at = {static_cast<float>(u), static_cast<float>(v)};
        }
      if (best >= 0) px.push_back(at);
    }
  return px;
}

SurfacePatch DirectCue::patch(const Vector3d& g, const Matrix3d& covariance,
                              std::vector<Vector2f> px, double reach_px) const {
  SurfacePatch patch;
  patch.g_ref = g;
  patch.g_covariance = covariance + covariance_of(g, kEvenness_deg * kRadPerDeg, kEvennessDistance);
  patch.support_px = std::move(px);
  patch.reach_px = reach_px;
  return patch;
}

/// Ground for a stereo camera of unknown height: the plane below that contains most depths of the
/// lower image.
void DirectCue::find_ground(const RectificationError& rectification, Random& random) {
  // A ground that is tilted by more, 23 degrees, is none. Chosen.
  constexpr double kMostTilt_rad = 0.4;
  const Camera& camera = calibration_.camera;
  std::vector<Vector2f> px;
  for (const Vector2f& p : grid(2 * options_.depths))
    if (p.y() > camera.cy + 0.15 * camera.height &&
        std::abs(p.x() - camera.cx) < 0.35 * camera.width)
      px.push_back(p);
  std::vector<MeasuredInverseDepth> known;
  for (const auto& depth : depth_.measure(frame_, rectification, px))
    if (depth) known.push_back(*depth);
  const InverseDepthPlane plane = fit_inverse_depth_plane(known, options_.planes, random);
  if (!plane.outcome || 3 * plane.inliers.size() < known.size() ||
      plane.plane_cam.normal.y() < std::cos(kMostTilt_rad))
    return;

  ground_.emplace(options_.surface, camera, plane.plane_cam);
}

Image DirectCue::mask_of_ground() const {
  if (ground_mask_.empty() || frame_.mask.empty())
    return ground_mask_.empty() ? frame_.mask : ground_mask_;
  return frame_.mask & ground_mask_;
}

/// The ground from its filter; for a monocular camera, from the known height and the estimated
/// normal.
std::vector<SurfacePatch> DirectCue::ground(const SE3& T_last_cur,
                                            const RectificationError& rectification,
                                            Random& random) {
  if (!ground_ && calibration_.baseline_m > 0) find_ground(rectification, random);
  if (!ground_) return {};
  if (mono_) {
    const Vector3d g = mounting_ / *calibration_.camera_height_m;
    const double sigma_rad =
        std::hypot(std::sqrt(mounting_variance_rad2_), kNodding_deg * kRadPerDeg);
    std::vector<Vector2f> px = ground_->pixels_of(SurfaceRegion::kAhead, mask_of_ground());
    const double reach = 0.5 * step_of(px);
    return {patch(g, covariance_of(g, sigma_rad, kSigmaHeight), std::move(px), reach)};
  }
  SurfaceAppearance appearance = ground_->update(
      [&](const std::vector<Vector2f>& px, const std::vector<double>& expected) {
        return depth_.measure(frame_, rectification, px,
                              depth_.disparities_px(px, expected, rectification));
      },
      T_last_cur.inverse(), mask_of_ground(), random);
  if (!appearance.outcome) return {};
  const Vector3d g = appearance.plane_cam.normal / appearance.plane_cam.distance_m;
  // The whole region except pixels off the surface: there may be usable intensities where no depth
  // was measured.
  std::vector<Vector2f> px = ground_->pixels_of(appearance.region, mask_of_ground());
  const double step = step_of(px);
  std::erase_if(px, [&](const Vector2f& p) {
    return std::any_of(appearance.off_px.begin(), appearance.off_px.end(),
                       [&](const Vector2f& off) { return (off - p).norm() < step; });
  });
  return {patch(g, covariance_of(g, appearance.sigma_normal_rad, appearance.sigma_log_distance),
                std::move(px), 0.5 * step)};
}

/// Depths over the whole image.
std::vector<KnownPixel> DirectCue::search_around(const RectificationError& rectification) const {
  const std::vector<Vector2f> px = grid(options_.depths);
  const auto depths = depth_.measure(frame_, rectification, px);
  std::vector<KnownPixel> known;
  for (std::size_t i = 0; i < px.size(); ++i)
    if (depths[i]) known.push_back({px[i], *depths[i]});
  return known;
}

/// Planes in known depths, found sequentially, those with most pixels first.
std::vector<SurfacePatch> DirectCue::planes(std::vector<KnownPixel> rest, double reach_px,
                                            Random& random) const {
  const double all = static_cast<double>(rest.size());
  std::vector<SurfacePatch> found;
  while (static_cast<int>(found.size()) < options_.max_planes) {
    std::vector<MeasuredInverseDepth> depths;
    for (const KnownPixel& known : rest) depths.push_back(known.depth);
    const InverseDepthPlane plane = fit_inverse_depth_plane(depths, options_.planes, random);
    if (static_cast<double>(plane.inliers.size()) < options_.min_plane_share * all ||
        plane.inliers.empty())
      break;
    std::vector<Vector2f> on;
    for (const int i : plane.inliers) on.push_back(rest[static_cast<std::size_t>(i)].px);
    for (auto i = plane.inliers.rbegin(); i != plane.inliers.rend(); ++i)
      rest.erase(rest.begin() + *i);
    // A plane that remains underdetermined, as of distant points, is dropped, but its pixels stay
    // removed so that they do not disturb the others.
    if (plane.outcome)
      found.push_back(patch(plane.g_cam, plane.covariance, std::move(on), reach_px));
  }
  return found;
}

/// Stereo refinement: planes are corrected until the right image agrees with the left one, where
/// depths of single pixels were not measured.
void DirectCue::refine(std::vector<SurfacePatch>& patches,
                       const RectificationError& rectification) const {
  constexpr double kPixelsSimilar = 8;  // number of neighbours that count as one
  if (calibration_.baseline_m <= 0 || frame_.right.empty()) return;
  const double known = 1e12;
  const MotionGuess left_to_right{SE3(SO3(), Vector3d(calibration_.baseline_m, 0, 0)),
                                  known * Matrix6d::Identity()};
  const DirectReference reference(pyramid_, calibration_.camera, patches, options_.align);
  const DirectMotion seen =
      align_motion(reference, grey_pyramid(frame_.right, options_.align.levels),
                   left_to_right.T_ref_cur, left_to_right);
  if (!seen.outcome) return;
  // The rectification error is itself a plane of disparities.
  const double px_per_inverse = calibration_.camera.fx * calibration_.baseline_m;
  const Vector3d off(rectification.by_x_px, rectification.by_y_px, rectification.offset_px);
  for (std::size_t k = 0; k < patches.size(); ++k) {
    if (seen.planes[k].inlier_share < 0.5) continue;
    const Vector3d g = seen.planes[k].g_ref - off / px_per_inverse;
    patches[k] = patch(g, kPixelsSimilar * seen.planes[k].g_covariance,
                       std::move(patches[k].support_px), patches[k].reach_px);
  }
}

bool DirectCue::become_reference(const SE3& T_last_cur, const RectificationError& rectification,
                                 const std::vector<KnownPixel>& landmarks, Random& random) {
  std::vector<SurfacePatch> patches = ground(T_last_cur, rectification, random);
  if (several_ || patches.empty()) {
    // Pixels around a landmark that have its depth. Chosen, as the distance of tracked points.
    constexpr double kAroundLandmark_px = 10;
    auto others =
        mono_ ? planes(landmarks, kAroundLandmark_px, random)
              : planes(search_around(rectification), 0.5 * grid_step(options_.depths), random);
    if (!several_ && !others.empty()) {
      // The surface that was used before, while it has at least half as many pixels as the largest.
      const Plane before{dominant_g_.normalized(), 1 / std::max(1e-9, dominant_g_.norm())};
      const Plane here = transform(T_last_cur.inverse(), before);
      const Vector3d g = here.normal / here.distance_m;
      auto best = others.begin();
      for (auto it = others.begin(); it != others.end(); ++it)
        if ((it->g_ref - g).norm() < 0.1 * g.norm() &&
            2 * it->support_px.size() > others.front().support_px.size())
          best = it;
      std::rotate(others.begin(), best, best + 1);
      // One surface where it dominates; otherwise as many as are needed to dominate together.
      constexpr double kDominates = 0.6;
      double all = 0, taken = 0;
      for (const SurfacePatch& other : others) all += static_cast<double>(other.support_px.size());
      std::size_t count = 0;
      while (taken < kDominates * all)
        taken += static_cast<double>(others[count++].support_px.size());
      others.resize(count);
    }
    patches.insert(patches.end(), others.begin(), others.end());
  }
  if (patches.empty()) return false;
  last_reference_ = std::move(reference_);
  last_pyramid_ = std::move(reference_pyramid_);
  dominant_g_ = patches.front().g_ref;
  refine(patches, rectification);
  reference_ = DirectReference(pyramid_, calibration_.camera, std::move(patches), options_.align);
  reference_pyramid_ = pyramid_;
  return true;
}

DirectMotion DirectCue::confirm(const DirectMotion& forward) const {
  if (!has_reference() || last_pyramid_.empty()) return forward;
  const MotionGuess guess{forward.T_ref_cur.inverse()};
  const DirectMotion back = align_motion(reference_, last_pyramid_, guess.T_ref_cur, guess);
  if (!back.outcome) return forward;
  const SE3 T_ref_cur = back.T_ref_cur.inverse();
  const Matrix6d A = back.T_ref_cur.adjoint();
  const Matrix6d covariance = A * back.covariance * A.transpose();
  const Vector6d off = (forward.T_ref_cur.inverse() * T_ref_cur).log();
  DirectMotion both = forward;
  const double chi2 = off.dot((forward.covariance + covariance).ldlt().solve(off));
  if (!(chi2 < 6 * kMaxDisagreement * kMaxDisagreement)) {
    both.outcome =
        Outcome::failure(Outcome::Code::kInconsistent,
                         "forward and backward motion differ, chi2 " + std::to_string(chi2));
    both.covariance += off * off.transpose() + covariance;
    return both;
  }
  // Both alignments use the same intensities, so that they count as one, but with different planes:
  // their difference shows the error caused by the planes.
  constexpr double kMisled = 0.5;
  const Matrix6d weight = covariance.ldlt().solve(Matrix6d::Identity());
  const Matrix6d sum = forward.covariance.ldlt().solve(Matrix6d::Identity()) + weight;
  const Eigen::LDLT<Matrix6d> solver(sum);
  both.T_ref_cur = forward.T_ref_cur.plus(Vector6d(solver.solve(weight * off)));
  const Matrix6d one = solver.solve(2 * Matrix6d::Identity());
  both.covariance =
      std::max(1.0, chi2 / 6) * 0.5 * (one + one.transpose()) + kMisled * off * off.transpose();
  return both;
}

void DirectCue::learn(const DirectMotion& motion) {
  if (!mono_ || !motion.outcome || motion.planes.empty() || !ground_) return;
  const auto& seen = motion.planes.front();
  const double nodding = std::pow(kNodding_deg * kRadPerDeg, 2);
  const double before = mounting_variance_rad2_ + nodding;
  const double gain = mounting_variance_rad2_ / before;
  const double after = std::pow(sigma_normal_rad(seen.g_ref, seen.g_covariance), 2);
  // Random walk of the mounting from keyframe to keyframe. Chosen.
  constexpr double kDrift_rad = 5e-4;
  mounting_ = (mounting_ + gain * (seen.g_ref.normalized() - mounting_)).normalized();
  mounting_variance_rad2_ += kDrift_rad * kDrift_rad - gain * gain * std::max(0.0, before - after);
  ground_.emplace(options_.surface, calibration_.camera,
                  Plane{mounting_, *calibration_.camera_height_m});
}

double DirectCue::median_depth_m() const {
  std::vector<double> depths;
  for (const SurfacePatch& patch : reference_.patches())
    for (const Vector2f& p : patch.support_px)
      if (const auto ray = calibration_.camera.unproject(p.cast<double>()))
        depths.push_back(1 / std::max(1e-3, patch.g_ref.dot(*ray)));
  return depths.empty() ? 10 : median_of(depths);
}

std::vector<FrameView::SurfacePixel> DirectCue::view(const DirectMotion& motion) const {
  std::vector<FrameView::SurfacePixel> pixels;
  for (const DirectMotion::Seen& seen : motion.seen)
    pixels.push_back({seen.px_cur, seen.residual_sigmas});
  return pixels;
}

}  // namespace placegraph
