#include <fmt/format.h>
#include <placegraph/pipeline/overlays/static_overlay.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace placegraph {
namespace {

/// Displacement of most moving points that completes an episode. Chosen.
constexpr double kMinMotion_px = 8;
// Number of frames from one comparison of the patches to the next. Chosen.
constexpr int kInterval = 2;

/// Growth of the mask that is worth a restart. Chosen.
constexpr double kGrown = 1.2;

/// A region that is larger could be the world, seen by a camera at rest in front of a moving
/// object.
constexpr double kLargestShare = 0.6;

int reduction_of(const Camera& camera) {
  // Larger images are reduced: the cost. Chosen.
  constexpr int kWidth_px = 1280;
  return std::max(1, (camera.width + kWidth_px - 1) / kWidth_px);
}

PointTrackerOptions tracker_options(const Camera& camera) {
  PointTrackerOptions tracker;
  tracker.max_tracks = 250;
  tracker.window_px = 13;
  tracker.max_forward_backward_px = 0.5;
  const double pixels = static_cast<double>(camera.width) * camera.height;
  const double spacing = std::sqrt(pixels / tracker.max_tracks) / reduction_of(camera);
  tracker.cell_px = std::max(16, static_cast<int>(spacing));
  tracker.min_distance_px = std::max(4, static_cast<int>(spacing / 3));
  tracker.max_anchor_shift_px = 0;
  return tracker;
}

int area_px(const Image& region) { return cv::countNonZero(region); }

}  // namespace

Image both_masks(const Image& a, const Image& b) {
  if (a.empty() || b.empty()) return a.empty() ? b : a;
  return a & b;
}

StaticOverlay::StaticOverlay(const StaticOverlayOptions& options, const Camera& camera,
                             std::uint64_t seed)
    : options_(options),
      camera_(camera),
      seed_(seed),
      patches_(camera),
      reduction_(reduction_of(camera)),
      tracker_(tracker_options(camera)) {}

bool StaticOverlay::add(const Frame& frame) {
  const bool compares = frames_++ % kInterval == 0;
  if (!px_ref_.empty()) track(frame);
  if (!compares) return false;
  const Image used = both_masks(frame.mask, mask_);
  patches_.compare(frame.image, used);
  const bool spots = patches_.moving() && watch_spots(frame.image, used);
  if (!px_ref_.empty()) return go_on(frame, used) || spots;
  if (!patches_.suspects() || patches_.comparisons() < next_) return spots;
  track(frame);
  begin(used);
  return spots;
}

/// Adds an image of the moving camera, of which `used` is not masked yet; returns whether the mask
/// has grown.
bool StaticOverlay::watch_spots(const Image& image, const Image& used) {
  spots_.add(image);
  if (spots_.images() < next_spots_) return false;
  next_spots_ *= 2;
  Image region = spots_.region();
  if (region.empty()) return false;
  const int masked = used.empty() ? 0 : static_cast<int>(used.total()) - area_px(used);
  if (!used.empty()) region &= used;
  return area_px(region) > (kGrown - 1) * masked && cover(region);
}

/// Goes on with an episode after a comparison; returns whether the mask has grown.
bool StaticOverlay::go_on(const Frame& frame, const Image& used) {
  // Comparisons of an episode, points that must move, episodes without a result, and comparisons
  // until the next search. Chosen.
  constexpr int kLongest = 15, kFewest = 20, kMostWithoutResult = 3, kPause = 20;
  const auto& tracks = tracker_.tracks();
  const auto moving = std::ranges::count_if(
      tracks, [&](const PointTrack& t) { return moved_px(t) >= kMinMotion_px; });
  const auto others = std::ranges::count_if(
      tracks, [&](const PointTrack& t) { return moved_px(t) >= kStanding_px; });
  const bool complete = moving >= std::max<std::ptrdiff_t>(kFewest, others / 2);
  if (!complete && patches_.comparisons() - begun_ < kLongest && std::ssize(tracks) >= kFewest)
    return false;
  const bool found = complete && judge(frame.id);
  without_result_ = found ? 0 : without_result_ + 1;
  if (without_result_ >= kMostWithoutResult) {
    tracker_.reset();
    px_ref_.clear();
    next_ = patches_.comparisons() + kPause;
    return false;
  }
  begin(used);
  return found && take_region();
}

void StaticOverlay::track(const Frame& frame) {
  tracker_.track(reduced(frame.image, cv::INTER_AREA));
  ++tracked_images_;
}

/// Begins an episode with the newest image.
void StaticOverlay::begin(const Image& mask) {
  tracker_.detect(reduced(both_masks(patches_.elsewhere(), mask), cv::INTER_NEAREST));
  px_ref_.clear();
  for (const PointTrack& track : tracker_.tracks()) px_ref_[track.id] = full(track.px);
  begun_ = patches_.comparisons();
}

/// Judges the patches that stood still in the episode by the motion of the points.
bool StaticOverlay::judge(FrameId frame) {
  std::vector<Eigen::Vector2d> px_ref, px_cur;
  for (const PointTrack& track : tracker_.tracks()) {
    if (moved_px(track) < kStanding_px) continue;
    px_ref.push_back(px_ref_.at(track.id));
    px_cur.push_back(full(track.px));
  }
  Random random(seed_, "static overlay", {frame.value()});
  const auto motion = ImageMotion::estimate(camera_, px_ref, px_cur, random);
  return motion && patches_.judge(*motion, begun_);
}

/// The region is taken once it grows no more: a mask of a part of an overlay would leave the rest
/// to the map.
bool StaticOverlay::take_region() {
  constexpr double kSettled = 1.1;  // growth of a region that is settled; chosen
  Image region = patches_.proven_cells();
  const int cells = area_px(region), before = last_cells_;
  last_cells_ = cells;
  if (cells == 0 || cells > kSettled * before) return false;
  cv::resize(region, region, {camera_.width, camera_.height}, 0, 0, cv::INTER_NEAREST);
  const cv::Size cell(camera_.width / StandingPatches::kColumns,
                      camera_.height / StandingPatches::kRows);
  cv::dilate(region, region, cv::getStructuringElement(cv::MORPH_RECT, cell));
  return cover(region);
}

/// Adds a region to the mask, if it is worth a restart; returns whether it is.
bool StaticOverlay::cover(const Image& region) {
  const Image mask = both_masks(mask_, 255 - region);
  const int pixels = camera_.width * camera_.height;
  const int masked = pixels - area_px(mask);
  const int masked_before = mask_.empty() ? 0 : pixels - area_px(mask_);
  if (masked <= kGrown * masked_before || masked > kLargestShare * pixels) return false;
  mask_ = mask;
  return true;
}

Image StaticOverlay::reduced(const Image& image, int interpolation) const {
  if (reduction_ == 1 || image.empty()) return image;
  Image small;
  cv::resize(image, small, {image.cols / reduction_, image.rows / reduction_}, 0, 0, interpolation);
  return small;
}

/// Pixel of the full image.
Eigen::Vector2d StaticOverlay::full(const Eigen::Vector2f& px) const {
  const double shift = 0.5 * (reduction_ - 1);
  return (reduction_ * px.cast<double>()).array() + shift;
}

double StaticOverlay::moved_px(const PointTrack& track) const {
  const auto ref = px_ref_.find(track.id);
  return ref == px_ref_.end() ? 0 : (full(track.px) - ref->second).norm();
}

Frame StaticOverlay::apply(const Frame& frame) const {
  if (mask_.empty()) return frame;
  Frame masked = frame;
  masked.mask = both_masks(frame.mask, mask_);
  return masked;
}

bool StaticOverlay::has_captured(const FrameView& view) const {
  int landmarks = 0, masked = 0;
  for (const FrameView::Track& track : view.tracks) {
    if (!track.px_projected) continue;
    ++landmarks;
    const cv::Point at(cvRound(track.px.x()), cvRound(track.px.y()));
    if (at.inside({0, 0, mask_.cols, mask_.rows})) masked += mask_.at<std::uint8_t>(at) == 0;
  }
  return 2 * masked > landmarks;
}

std::string StaticOverlay::text() const {
  const Image region = 255 - mask_;
  const cv::Rect box = cv::boundingRect(region);
  return fmt::format(
      "a region of {:.0f} % of the image (within columns {} to {} and rows {} to {}) is fixed to "
      "the camera",
      std::ceil(100.0 * area_px(region) / (camera_.width * camera_.height)), box.x,
      box.x + box.width - 1, box.y, box.y + box.height - 1);
}

std::optional<DataNote> StaticOverlay::note() const {
  if (mask_.empty()) return std::nullopt;
  return DataNote{
      text() + ": it was masked", false, NoteCause::kStaticOverlay,
      "check the lens for dirt, the images for a time stamp or the bonnet; a mask of your own "
      "(`run --mask`) is exact"};
}

}  // namespace placegraph
