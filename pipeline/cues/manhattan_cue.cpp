#include <placegraph/frontend/scene/orientation_map.h>
#include <placegraph/frontend/vanishing/manhattan_frame.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/pipeline/cues/manhattan_cue.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <sstream>

namespace placegraph {
namespace {

double largest_sigma_rad(const Eigen::Matrix3d& covariance) {
  return std::sqrt(Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance).eigenvalues()[2]);
}

Image filled(const std::vector<Eigen::Vector2d>& outline_px, const cv::Size& size) {
  std::vector<cv::Point> corners;
  for (const Eigen::Vector2d& px : outline_px) {
    const Eigen::Vector2d near = px.cwiseMax(-1e5).cwiseMin(1e5);
    corners.emplace_back(static_cast<int>(near[0]), static_cast<int>(near[1]));
  }
  Image inside(size, CV_8UC1, cv::Scalar(0));
  cv::fillConvexPoly(inside, corners, cv::Scalar(255));
  return inside;
}

/// The region in front of the walls: in every column the pixels below the lowest wall.
Image below_walls(const Image& surfaces) {
  Image below(surfaces.size(), CV_8UC1, cv::Scalar(0));
  for (int u = 0; u < surfaces.cols; ++u)
    for (int v = surfaces.rows - 1; v >= 0; --v) {
      const auto surface = static_cast<PlanSurface>(surfaces.at<std::uint8_t>(v, u));
      if (surface == PlanSurface::kWall || surface == PlanSurface::kCeiling) break;
      below.at<std::uint8_t>(v, u) = 255;
    }
  return below;
}

}  // namespace

ManhattanCue::ManhattanCue(const ManhattanCueOptions& options, const Camera& camera,
                           std::uint64_t seed, LogSink log)
    : options_(options),
      camera_(camera),
      seed_(seed),
      log_(std::move(log)),
      manhattan_frames_(options.frames) {
  options_.check();
}

void ManhattanCue::reset() {
  manhattan_frames_.reset();
  view_.clear();
  observation_.reset();
}

/// Segments in pixels of the full image; a pixel of the halved image covers about four.
std::vector<LineSegment> ManhattanCue::detect(const Image& image) const {
  if (image.cols <= options_.max_width_px)
    return segments_of(detect_segments(image, options_.segments));
  Image half;
  cv::resize(image, half, {image.cols / 2, image.rows / 2}, 0, 0, cv::INTER_AREA);
  const Eigen::Array2d scale(static_cast<double>(image.cols) / half.cols,
                             static_cast<double>(image.rows) / half.rows);
  std::vector<LineSegment> segments = segments_of(detect_segments(half, options_.segments));
  for (LineSegment& segment : segments)
    for (Eigen::Vector2d* end : {&segment.start, &segment.end})
      *end = (end->array() + 0.5) * scale - 0.5;
  return segments;
}

/// Tracks near the predicted rotation: a result farther away is no observation of that Manhattan
/// frame.
ManhattanFrame ManhattanCue::track(const std::vector<LineSegment>& segments,
                                   const ManhattanFrames::Expected& manhattan_frame) const {
  const double reach_rad =
      std::min(5 * kRadPerDeg, 1 * kRadPerDeg + 3 * largest_sigma_rad(manhattan_frame.covariance));
  return track_manhattan_frame(segments, camera_, manhattan_frame.R_cam_frame, reach_rad,
                               options_.directions.points.noise, options_.directions.manhattan);
}

std::optional<ManhattanCue::RotationEstimate> ManhattanCue::manhattan_rotation(
    const Image& image, const SO3& R_odom_cam, const SlidingWindow& window,
    KeyframeId keyframe) const {
  const auto expected = manhattan_frames_.expected(window, keyframe);
  if (expected.empty()) return std::nullopt;
  const std::vector<LineSegment> segments = detect(image);
  for (ManhattanFrames::Expected manhattan_frame : expected) {
    const auto R_odom_manhattan = window.manhattan_frame(manhattan_frame.manhattan_frame);
    if (manhattan_frame.manhattan_frame == ManhattanFrames::kMapAxes || !R_odom_manhattan) continue;
    manhattan_frame.R_cam_frame = R_odom_cam.inverse() * *R_odom_manhattan;
    const ManhattanFrame frame = track(segments, manhattan_frame);
    if (!trusted(frame)) continue;
    return RotationEstimate{manhattan_frame.manhattan_frame,
                            nearest_axes(frame.R_cam_manhattan, manhattan_frame.R_cam_frame),
                            manhattan_frames_.honest(frame.covariance).inverse()};
  }
  return std::nullopt;
}

bool ManhattanCue::trusted(const ManhattanFrame& frame) const {
  if (!frame.outcome || frame.rank < 3) return false;
  const ManhattanOptions& o = options_.directions.manhattan;
  int seen = 0;
  for (std::size_t a = 0; a < 3; ++a)
    seen += frame.segments[a] >= o.min_segments && frame.evidence[a] >= o.min_evidence;
  return seen >= 2 && largest_sigma_rad(frame.covariance) < options_.max_sigma_deg * kRadPerDeg;
}

bool ManhattanCue::take(KeyframeId keyframe, const std::vector<LineSegment>& segments,
                        const ManhattanFrame& frame, SlidingWindow& window) {
  if (!trusted(frame)) return false;
  if (!observation_)
    observation_ = Observation{segments, frame.axis, frame.R_cam_manhattan, frame.covariance};
  const auto manhattan_frame =
      manhattan_frames_.add(keyframe, frame.R_cam_manhattan, frame.covariance, window);
  if (log_) {
    const Eigen::Vector3d w = frame.R_cam_manhattan.log();
    std::ostringstream text;
    text << "directions " << keyframe << " frame "
         << (manhattan_frame ? manhattan_frame->value() : -1) << " rotation " << w.transpose()
         << " sigma_deg " << frame.covariance.diagonal().cwiseSqrt().transpose() / kRadPerDeg;
    log_(LogLevel::kDebug, text.str());
  }
  for (std::size_t i = 0; i < view_.size(); ++i)
    if (manhattan_frame && frame.axis[i] >= 0 && !view_[i].axis)
      view_[i].manhattan_frame = *manhattan_frame, view_[i].axis = frame.axis[i];
  return manhattan_frame.has_value();
}

void ManhattanCue::observe(KeyframeId keyframe, const Image& image,
                           const std::optional<std::vector<LineSegment>>& known,
                           SlidingWindow& window) {
  const std::vector<LineSegment> segments = known ? *known : detect(image);
  view_.clear();
  observation_.reset();
  for (const LineSegment& segment : segments) view_.push_back({segment, {}, {}});
  bool seen = false;
  for (const ManhattanFrames::Expected& manhattan_frame :
       manhattan_frames_.expected(window, keyframe)) {
    if (take(keyframe, segments, track(segments, manhattan_frame), window)) seen = true;
    if (seen) break;
  }
  if (seen) return;
  Random random(seed_, "Manhattan frames", {keyframe.value()});
  const SceneDirections scene =
      find_scene_directions(segments, camera_, options_.directions, random);
  for (const ManhattanFrame& frame : scene.frames) take(keyframe, segments, frame, window);
}

GroundMask ManhattanCue::ground(const std::vector<Eigen::Vector2d>& outline_px) const {
  if (!observation_ || outline_px.size() < 3) return {};
  const OrientationMap map = compute_orientation_map(observation_->segments, observation_->axis,
                                                     camera_, observation_->R_cam_manhattan);
  if (!map.outcome) return {};
  const Image surfaces = indoor_surfaces(map, camera_, observation_->R_cam_manhattan);
  const Image walls = surfaces == static_cast<int>(PlanSurface::kWall),
              floor = surfaces == static_cast<int>(PlanSurface::kFloor);
  const Image outline = filled(outline_px, surfaces.size());
  const auto in_outline = [&](const Image& part) { return cv::countNonZero(outline & part); };
  constexpr double kStanding = 0.2, kShown = 0.2;  // shares of the assumed ground
  const double all = cv::countNonZero(outline);
  if (all == 0 || in_outline(walls) < kStanding * all) return {};
  if (in_outline(floor) < kShown * all) return {below_walls(surfaces), std::nullopt};
  // Standard deviation of the vertical: rotations about the other axes.
  Eigen::Vector3d tilts = observation_->covariance.diagonal();
  tilts[map.vertical_axis] = 0;
  const Eigen::Vector3d vertical = observation_->R_cam_manhattan.matrix().col(map.vertical_axis);
  return {floor, vertical.y() < 0 ? Eigen::Vector3d(-vertical) : vertical,
          std::sqrt(tilts.maxCoeff())};
}

SE3 with_manhattan_rotation(const SE3& T_odom_cam, const Matrix6d& information,
                            const std::optional<ManhattanCue::RotationEstimate>& manhattan_rotation,
                            const SlidingWindow& window) {
  const auto R_odom_manhattan = manhattan_rotation
                                    ? window.manhattan_frame(manhattan_rotation->manhattan_frame)
                                    : std::nullopt;
  if (!R_odom_manhattan) return T_odom_cam;
  const SO3 R_odom_cam = *R_odom_manhattan * manhattan_rotation->R_cam_frame.inverse();
  // The heading's covariance is in R_cam_frame's right tangent; that of R_odom_cam is rotated.
  const Eigen::Matrix3d R = manhattan_rotation->R_cam_frame.matrix();
  const Eigen::Matrix3d weight = R * manhattan_rotation->information * R.transpose();
  Matrix6d H = information;
  H.bottomRightCorner<3, 3>() += weight;
  Vector6d g = Vector6d::Zero();
  g.tail<3>() = weight * (T_odom_cam.rotation().inverse() * R_odom_cam).log();
  const Vector6d step = H.ldlt().solve(g);
  return step.allFinite() ? T_odom_cam.plus(step) : T_odom_cam;
}

}  // namespace placegraph
