#include <fmt/format.h>
#include <placegraph/frontend/flow/point_tracker.h>
#include <placegraph/pipeline/health/flow_check.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace placegraph {
namespace {

/// Corners of images of at most this width: the cost does not depend on that of the camera.
constexpr int kWidth_px = 480;

Image reduced(const Image& image) {
  if (image.cols <= kWidth_px || image.empty()) return image;
  Image small;
  const double scale = static_cast<double>(kWidth_px) / image.cols;
  cv::resize(image, small, {}, scale, scale, cv::INTER_AREA);
  return small;
}

std::vector<PixelDisplacement> displacements(const Frame& ref, const Frame& cur) {
  PointTrackerOptions options;
  options.max_tracks = 100;
  options.max_anchor_shift_px = 0;
  options.cell_px = 40;
  PointTracker tracker(options);
  const Image from = reduced(ref.image);
  tracker.track(from);
  Image mask = ref.mask;
  if (!mask.empty() && mask.size() != from.size())
    cv::resize(ref.mask, mask, from.size(), 0, 0, cv::INTER_NEAREST);
  tracker.detect(mask);
  tracker.track(reduced(cur.image));
  const double scale = static_cast<double>(ref.image.cols) / from.cols;
  const auto full = [&](const Eigen::Vector2f& px) -> Eigen::Vector2d {
    return scale * (px.cast<double>().array() + 0.5) - 0.5;
  };
  std::vector<PixelDisplacement> found;
  for (const PointTrack& track : tracker.tracks())
    found.push_back({full(track.px_previous), full(track.px)});
  return found;
}

}  // namespace

std::optional<double> distance_to_half_line(const Camera& camera, const SE3& T_ref_cur,
                                            const PixelDisplacement& displacement) {
  const auto ray = camera.unproject(displacement.px_ref);
  if (!ray) return std::nullopt;
  const Eigen::Matrix3d R_cur_ref = T_ref_cur.rotation().matrix().transpose();
  const Eigen::Vector3d far = R_cur_ref * *ray, epipole = -(R_cur_ref * T_ref_cur.translation());
  const auto start = camera.project(far);
  if (!start) return std::nullopt;
  // The point far + s epipole, s >= 0, is at the depth 1 / s along the ray.
  const Eigen::Vector2d focal(camera.fx, camera.fy);
  const Eigen::Vector2d along =
      focal.cwiseProduct(epipole.head<2>() * far.z() - far.head<2>() * epipole.z());
  const Eigen::Vector2d moved = displacement.px_cur - *start;
  const double length = along.norm();
  if (!(length > 0)) return moved.norm();
  double share = std::max(0.0, moved.dot(along) / length);
  if (epipole.z() > 0)
    if (const auto end = camera.project(epipole)) share = std::min(share, (*end - *start).norm());
  return (moved - share / length * along).norm();
}

FlowCheck::FlowCheck(const Calibration& calibration) : camera_(calibration.camera) {}

void FlowCheck::add(const Frame& frame, const std::optional<SE3>& T_map_cam) {
  // Motion over two frames is compared, once in four frames. Chosen: the cost.
  constexpr int kFramesAPair = 4, kFramesBetween = 2;
  ++frames_since_pair_;
  if (frames_since_pair_ == kFramesAPair - kFramesBetween) {
    before_ = frame;
    T_map_before_ = T_map_cam;
  }
  if (frames_since_pair_ < kFramesAPair) return;
  frames_since_pair_ = 0;
  if (T_map_cam && T_map_before_)
    if (const auto share = share_contradicting(frame, *T_map_cam)) add(frame.id, *share);
  before_ = {};
}

std::optional<double> FlowCheck::share_contradicting(const Frame& frame,
                                                     const SE3& T_map_cam) const {
  // Displacements that are judged. Chosen.
  constexpr std::size_t kFewest = 20;
  // Displacement that contradicts the motion, the larger of both. Chosen by the faults of group
  // "fixed" (tests/faults/README.md).
  constexpr double kLeast_rad = 0.008, kLeast_px = 2.5;
  const SE3 T_ref_cur = T_map_before_->inverse() * T_map_cam;
  const double scale = std::max(1.0, static_cast<double>(frame.image.cols) / kWidth_px);
  const double limit_px = std::max(kLeast_px * scale, kLeast_rad * camera_.fx);
  std::size_t judged = 0, contradicting = 0;
  for (const PixelDisplacement& displacement : displacements(before_, frame))
    if (const auto distance_px = distance_to_half_line(camera_, T_ref_cur, displacement)) {
      ++judged;
      if (*distance_px > limit_px) ++contradicting;
    }
  if (judged < kFewest) return std::nullopt;
  return static_cast<double>(contradicting) / static_cast<double>(judged);
}

std::optional<DataNote> FlowCheck::note() const {
  // Two pairs in a row: a car that passes, or a mirror, contradicts in one.
  constexpr double kMost = 0.4;
  std::vector<const Pair*> odd;
  for (std::size_t i = 1; i < pairs_.size(); ++i)
    if (std::min(pairs_[i - 1].contradicting, pairs_[i].contradicting) > kMost) {
      if (odd.empty() || odd.back() != &pairs_[i - 1]) odd.push_back(&pairs_[i - 1]);
      odd.push_back(&pairs_[i]);
    }
  if (odd.empty()) return std::nullopt;
  return DataNote{fmt::format("between the frames {} and {} over {:.0f} % of the image contradicts "
                              "the motion of the camera, in {} of {} comparisons",
                              odd.front()->frame.value(), odd.back()->frame.value(), 100 * kMost,
                              odd.size(), pairs_.size()),
                  false, NoteCause::kDrift,
                  "look for what moves through the view there; --mask leaves it out"};
}

}  // namespace placegraph
