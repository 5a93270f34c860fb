#include <placegraph/frontend/flow/corners.h>
#include <placegraph/frontend/flow/point_tracker.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>

namespace placegraph {
namespace {

/// Minimum standard deviation of a point whose anchor was found. Chosen.
constexpr double kMinTrackSigma_px = 0.25;
/// Maximum accumulated noise of a track; beyond, the track ends. Chosen.
constexpr double kMaxTrackSigma_px = 1.5;

}  // namespace

PointTracker::PointTracker(const PointTrackerOptions& options) : options_(options) {
  options_.check();
  least_ *= static_cast<float>(kMinTrackSigma_px * kMinTrackSigma_px);
}

void PointTracker::reset() {
  tracks_.clear();
  image_ = Image();
  pyramid_.clear();
}

void PointTracker::keep(const std::vector<bool>& flags) {
  require(flags.size() == tracks_.size(), "PointTracker::keep: one flag per track needed");
  std::size_t kept = 0;
  for (std::size_t i = 0; i < tracks_.size(); ++i)
    if (flags[i]) tracks_[kept++] = tracks_[i];
  tracks_.resize(kept);
}

void PointTracker::track(const Image& image, const std::vector<Eigen::Vector2f>& predicted_px,
                         Search search) {
  require(image.type() == CV_8UC1 && !image.empty(), "PointTracker::track: grey image needed");
  require(image_.empty() || image.size() == image_.size(),
          "PointTracker::track: image size changed");
  require(predicted_px.empty() || predicted_px.size() == tracks_.size(),
          "PointTracker::track: one prediction per track needed");
  std::vector<Image> pyramid;
  cv::buildOpticalFlowPyramid(image, pyramid, cv::Size(options_.window_px, options_.window_px),
                              options_.pyramid_levels - 1);
  if (!tracks_.empty()) {
    const auto found = follow(pyramid, predicted_px, search);
    const float border = 3;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < tracks_.size(); ++i) {
      if (!found[i] || found[i]->x() < border || found[i]->y() < border ||
          found[i]->x() >= image.cols - border || found[i]->y() >= image.rows - border)
        continue;
      PointTrack track = tracks_[i];
      track.px_previous = track.px;
      track.px = *found[i];
      ++track.age;
      tracks_[kept++] = track;
    }
    tracks_.resize(kept);
  }
  image_ = image;
  pyramid_ = std::move(pyramid);
}

/// Positions of the tracks in the new image that pass the forward-backward check.
std::vector<std::optional<Eigen::Vector2f>> PointTracker::follow(
    const std::vector<Image>& pyramid, const std::vector<Eigen::Vector2f>& predicted_px,
    Search search) const {
  std::vector<cv::Point2f> from, guess;
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    from.emplace_back(tracks_[i].px.x(), tracks_[i].px.y());
    const Eigen::Vector2f& g = predicted_px.empty() ? tracks_[i].px : predicted_px[i];
    guess.emplace_back(g.x(), g.y());
  }
  const bool near = search == Search::kNear;
  const cv::Size window(options_.window_px, options_.window_px);
  const cv::TermCriteria stop(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 30, 0.01);
  const auto lucas_kanade = [&](const std::vector<Image>& a, const std::vector<Image>& b,
                                const std::vector<cv::Point2f>& start, int level,
                                std::vector<cv::Point2f>& end) {
    std::vector<unsigned char> status;
    std::vector<float> error;
    cv::calcOpticalFlowPyrLK(a, b, start, end, status, error, window, level, stop,
                             cv::OPTFLOW_USE_INITIAL_FLOW, options_.min_eigenvalue);
    return status;
  };
  const int coarsest = options_.pyramid_levels - 1, finer = std::min(coarsest, 1);
  std::vector<cv::Point2f> to = guess;
  const auto there = lucas_kanade(pyramid_, pyramid, from, near ? finer : coarsest, to);
  // The backward search starts as far off as the prediction was: fine levels are enough, and a
  // point that drifted elsewhere does not return to its start.
  std::vector<cv::Point2f> back = from;
  if (!predicted_px.empty())
    for (std::size_t i = 0; i < back.size(); ++i) back[i] += to[i] - guess[i];
  const int coarsest_back = near ? 0 : predicted_px.empty() ? coarsest : finer;
  const auto home = lucas_kanade(pyramid, pyramid_, to, coarsest_back, back);
  const double limit = options_.max_forward_backward_px * options_.max_forward_backward_px;
  std::vector<std::optional<Eigen::Vector2f>> found(from.size());
  for (std::size_t i = 0; i < from.size(); ++i) {
    const cv::Point2f d = back[i] - from[i];
    if (there[i] && home[i] && d.dot(d) <= limit) found[i] = Eigen::Vector2f(to[i].x, to[i].y);
  }
  return found;
}

void PointTracker::anchor() {
  if (!(options_.max_anchor_shift_px > 0)) return;
  const auto step = static_cast<float>(options_.sigma_px * options_.sigma_px);
  const double most = 2 * kMaxTrackSigma_px * kMaxTrackSigma_px;
  std::size_t kept = 0;
  for (PointTrack& track : tracks_) {
    std::optional<AnchoredPatch::Place> place;
    if (track.anchor)
      place = track.anchor->find(pyramid_, {track.px, track.A},
                                 static_cast<float>(options_.max_anchor_shift_px),
                                 static_cast<float>(options_.min_anchor_correlation));
    if (place) {
      track.px = place->px;
      track.A = place->A;
      track.covariance = track.template_covariance + place->covariance + least_;
    } else {
      track.covariance += step * Eigen::Matrix2f::Identity();
      if (track.covariance.trace() > most) continue;
    }
    if (!place || !AnchoredPatch::is_comparable(track.A)) {
      // The new anchor is taken at the estimated position of the old one.
      track.template_covariance = track.covariance;
      take_template(track);
    }
    tracks_[kept++] = track;
  }
  tracks_.resize(kept);
}

void PointTracker::take_template(PointTrack& track) const {
  track.A.setIdentity();
  track.anchor.reset();
  if (const auto patch = AnchoredPatch::take(image_, track.px))
    track.anchor = std::make_shared<const AnchoredPatch>(*patch);
}

void PointTracker::detect(const Image& mask) {
  require(!image_.empty(), "PointTracker::detect: no image yet");
  const int missing = options_.max_tracks - static_cast<int>(tracks_.size());
  if (missing <= 0) return;

  Image blocked = Image::zeros(image_.size(), CV_8UC1);
  for (const PointTrack& track : tracks_)
    cv::circle(blocked, cv::Point(cvRound(track.px.x()), cvRound(track.px.y())),
               options_.min_distance_px, 255, cv::FILLED);

  // Strongest corners of every cell first, cells in turn: even coverage has priority over strength.
  const int columns = (image_.cols + options_.cell_px - 1) / options_.cell_px;
  const int rows = (image_.rows + options_.cell_px - 1) / options_.cell_px;
  std::vector<std::vector<Corner>> cells(columns * rows);
  std::vector<int> occupied(columns * rows, 0);
  for (const PointTrack& track : tracks_)
    ++occupied[static_cast<int>(track.px.y()) / options_.cell_px * columns +
               static_cast<int>(track.px.x()) / options_.cell_px];
  // Pixels along the border without new points. Chosen.
  constexpr int kBorder = 8;
  for (const Corner& corner : find_corners(image_, options_.min_eigenvalue, kBorder, blocked, mask))
    cells[corner.v / options_.cell_px * columns + corner.u / options_.cell_px].push_back(corner);
  for (auto& cell : cells)
    std::stable_sort(cell.begin(), cell.end(),
                     [](const Corner& a, const Corner& b) { return a.strength > b.strength; });

  const int quota = (options_.max_tracks + columns * rows - 1) / (columns * rows);
  std::vector<std::size_t> next(cells.size(), 0);
  int added = 0;
  // First up to each cell's equal share, then the remaining corners of all cells.
  for (int round = 1; round <= 4 * quota && added < missing; ++round) {
    for (std::size_t c = 0; c < cells.size() && added < missing; ++c) {
      if (occupied[c] >= round) continue;
      for (; next[c] < cells[c].size(); ++next[c]) {
        const Corner& corner = cells[c][next[c]];
        if (blocked.at<unsigned char>(corner.v, corner.u)) continue;
        cv::circle(blocked, cv::Point(corner.u, corner.v), options_.min_distance_px, 255,
                   cv::FILLED);
        PointTrack track;
        track.id = next_id_++;
        track.px = track.px_previous = Eigen::Vector2f(corner.u, corner.v);
        track.covariance *= static_cast<float>(options_.sigma_px * options_.sigma_px);
        if (options_.max_anchor_shift_px > 0) {
          take_template(track);
          if (track.anchor) track.covariance = least_;
        }
        tracks_.push_back(track);
        ++added;
        ++occupied[c];
        ++next[c];
        break;
      }
    }
  }
}

}  // namespace placegraph
