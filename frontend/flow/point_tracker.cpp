#include <placegraph/frontend/flow/point_tracker.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>

namespace placegraph {

void PointTrackerOptions::check() const {
  check_ranges(*this);
  require(window_px % 2 == 1, "window_px: must be odd");
}

void visit(OptionVisitor& field, PointTrackerOptions& o) {
  field("max_tracks", o.max_tracks, "points followed at once", {20, 10000});
  field("window_px", o.window_px, "side of the Lucas-Kanade window, odd", {5, 63});
  field("pyramid_levels", o.pyramid_levels, "levels of the image pyramid", {1, 8});
  field("max_forward_backward_px", o.max_forward_backward_px,
        "a track that does not come back to its start this closely is dropped", {0.01, 10});
  field("min_eigenvalue", o.min_eigenvalue,
        "least eigenvalue of the gradient matrix per pixel, grey levels / 255", {0, 1});
  field("cell_px", o.cell_px, "side of the cells over which tracks are balanced", {8, 512});
  field("min_distance_px", o.min_distance_px, "least distance between detected points", {1, 256});
}

PointTracker::PointTracker(const PointTrackerOptions& options) : options_(options) {
  options_.check();
}

void PointTracker::reset() {
  tracks_.clear();
  image_ = Image();
  pyramid_.clear();
}

void PointTracker::keep(const std::vector<bool>& flags) {
  require(flags.size() == tracks_.size(), "PointTracker::keep: one flag a track needed");
  std::size_t kept = 0;
  for (std::size_t i = 0; i < tracks_.size(); ++i)
    if (flags[i]) tracks_[kept++] = tracks_[i];
  tracks_.resize(kept);
}

void PointTracker::track(const Image& image, const std::vector<Eigen::Vector2f>& predicted_px) {
  require(image.type() == CV_8UC1 && !image.empty(), "PointTracker::track: grey image needed");
  require(image_.empty() || image.size() == image_.size(),
          "PointTracker::track: image size changed");
  require(predicted_px.empty() || predicted_px.size() == tracks_.size(),
          "PointTracker::track: one prediction a track needed");
  const cv::Size window(options_.window_px, options_.window_px);
  std::vector<Image> pyramid;
  cv::buildOpticalFlowPyramid(image, pyramid, window, options_.pyramid_levels - 1);
  if (!tracks_.empty()) {
    std::vector<cv::Point2f> from, to;
    for (std::size_t i = 0; i < tracks_.size(); ++i) {
      from.emplace_back(tracks_[i].px.x(), tracks_[i].px.y());
      const Eigen::Vector2f& guess = predicted_px.empty() ? tracks_[i].px : predicted_px[i];
      to.emplace_back(guess.x(), guess.y());
    }
    const cv::TermCriteria stop(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 30, 0.01);
    std::vector<unsigned char> found, found_back;
    std::vector<float> error;
    cv::calcOpticalFlowPyrLK(pyramid_, pyramid, from, to, found, error, window,
                             options_.pyramid_levels - 1, stop, cv::OPTFLOW_USE_INITIAL_FLOW,
                             options_.min_eigenvalue);
    // The way back starts as far off its goal as the prediction was: there the fine levels are
    // enough, and what slid off elsewhere does not come home by itself.
    std::vector<cv::Point2f> back = from;
    int levels_back = options_.pyramid_levels - 1;
    if (!predicted_px.empty()) {
      levels_back = std::min(levels_back, 1);
      for (std::size_t i = 0; i < tracks_.size(); ++i)
        back[i] += to[i] - cv::Point2f(predicted_px[i].x(), predicted_px[i].y());
    }
    cv::calcOpticalFlowPyrLK(pyramid, pyramid_, to, back, found_back, error, window, levels_back,
                             stop, cv::OPTFLOW_USE_INITIAL_FLOW, options_.min_eigenvalue);
    const double limit = options_.max_forward_backward_px * options_.max_forward_backward_px;
    const float border = 3;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < tracks_.size(); ++i) {
      const cv::Point2f d = back[i] - from[i];
      const bool inside = to[i].x >= border && to[i].y >= border && to[i].x < image.cols - border &&
                          to[i].y < image.rows - border;
      if (!found[i] || !found_back[i] || !inside || d.dot(d) > limit) continue;
      PointTrack track = tracks_[i];
      track.px_previous = track.px;
      track.px = Eigen::Vector2f(to[i].x, to[i].y);
      ++track.age;
      tracks_[kept++] = track;
    }
    tracks_.resize(kept);
  }
  image_ = image;
  pyramid_ = std::move(pyramid);
}

void PointTracker::detect(const Image& mask) {
  require(!image_.empty(), "PointTracker::detect: no image yet");
  const int missing = options_.max_tracks - static_cast<int>(tracks_.size());
  if (missing <= 0) return;

  Image strength, local_max;
  cv::cornerMinEigenVal(image_, strength, 5, 3);
  cv::dilate(strength, local_max, Image());
  Image blocked = Image::zeros(image_.size(), CV_8UC1);
  for (const PointTrack& track : tracks_)
    cv::circle(blocked, cv::Point(cvRound(track.px.x()), cvRound(track.px.y())),
               options_.min_distance_px, 255, cv::FILLED);

  // Strongest corners of every cell first, cells in turn: what is even matters more than what is
  // strong.
  struct Corner {
    float strength;
    int u, v;
  };
  const int columns = (image_.cols + options_.cell_px - 1) / options_.cell_px;
  const int rows = (image_.rows + options_.cell_px - 1) / options_.cell_px;
  std::vector<std::vector<Corner>> cells(columns * rows);
  std::vector<int> occupied(columns * rows, 0);
  for (const PointTrack& track : tracks_)
    ++occupied[static_cast<int>(track.px.y()) / options_.cell_px * columns +
               static_cast<int>(track.px.x()) / options_.cell_px];
  constexpr int kBorder = 8;
  const float threshold = static_cast<float>(options_.min_eigenvalue);
  for (int v = kBorder; v < image_.rows - kBorder; ++v) {
    const float* s = strength.ptr<float>(v);
    const float* m = local_max.ptr<float>(v);
    const unsigned char* b = blocked.ptr(v);
    const unsigned char* allowed = mask.empty() ? nullptr : mask.ptr(v);
    for (int u = kBorder; u < image_.cols - kBorder; ++u)
      if (s[u] > threshold && s[u] == m[u] && !b[u] && (!allowed || allowed[u]))
        cells[v / options_.cell_px * columns + u / options_.cell_px].push_back({s[u], u, v});
  }
  for (auto& cell : cells)
    std::stable_sort(cell.begin(), cell.end(),
                     [](const Corner& a, const Corner& b) { return a.strength > b.strength; });

  const int quota = (options_.max_tracks + columns * rows - 1) / (columns * rows);
  std::vector<std::size_t> next(cells.size(), 0);
  int added = 0;
  // First up to each cell's fair share, then wherever corners are left.
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
