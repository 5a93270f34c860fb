#include <placegraph/frontend/lines/line_tracker.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

/// Both sides of an edge, or one of them where the other has changed.
double similarity(const StripSimilarity& alike) {
  constexpr double kOneSidePenalty = 0.1;
  return std::max(alike.both, std::max(alike.left, alike.right) - kOneSidePenalty);
}

/// The part of a segment inside the image; without length if there is none.
LineSegment clipped(const LineSegment& segment, const Image& image, double border_px) {
  double from = 0, to = 1;
  const Eigen::Vector2d d = segment.vector();
  const Eigen::Vector2d high(image.cols - 1 - border_px, image.rows - 1 - border_px);
  for (int axis = 0; axis < 2; ++axis) {
    if (std::abs(d[axis]) < 1e-9) {
      if (segment.start[axis] < border_px || segment.start[axis] > high[axis]) return {};
      continue;
    }
    double a = (border_px - segment.start[axis]) / d[axis];
    double b = (high[axis] - segment.start[axis]) / d[axis];
    if (a > b) std::swap(a, b);
    from = std::max(from, a), to = std::min(to, b);
  }
  if (!(from < to)) return {};
  return {segment.start + from * d, segment.start + to * d};
}

/// The same part of the segment it corresponds to.
LineSegment part_of(const LineSegment& whole, const LineSegment& moved, const LineSegment& part) {
  const double length = moved.length();
  const auto at = [&](const Eigen::Vector2d& px) -> Eigen::Vector2d {
    return whole.start + moved.position_of(px) / length * whole.vector();
  };
  return {at(part.start), at(part.end)};
}

double share_inside(const LineSegment& segment, const Image& mask) {
  if (mask.empty()) return 1;
  constexpr int kSamples = 8;
  int inside = 0;
  for (int i = 0; i < kSamples; ++i) {
    const Eigen::Vector2d p = segment.start + (i + 0.5) / kSamples * segment.vector();
    const int u = std::clamp(static_cast<int>(std::lround(p.x())), 0, mask.cols - 1);
    const int v = std::clamp(static_cast<int>(std::lround(p.y())), 0, mask.rows - 1);
    inside += mask.at<std::uint8_t>(v, u) != 0;
  }
  return static_cast<double>(inside) / kSamples;
}

/// Two measurements of one edge: of one sense, on one line, one over the other.
bool same_edge(const LineSegment& a, const LineSegment& b, double max_distance_px) {
  constexpr double kMaxAngle = 0.05, kLeastOverlap = 0.3;  // rad; of the shorter
  const Eigen::Vector2d along_a = a.vector(), along_b = b.vector();
  const double reach = max_distance_px + 0.5 * (a.length() + b.length());
  if (along_a.dot(along_b) <= 0 || (a.middle() - b.middle()).squaredNorm() > reach * reach)
    return false;
  const Collinearity lie = collinearity(a, b);
  return lie.angle_rad < kMaxAngle && lie.distance_px < max_distance_px &&
         -lie.gap_px > kLeastOverlap * std::min(a.length(), b.length());
}

}  // namespace

void LineTrackerOptions::check() const {
  check_ranges(*this);
  detector.check();
  flow.check();
}

void visit(OptionVisitor& field, LineTrackerOptions& o) {
  field.group("detector", o.detector, "where new tracks come from");
  field.group("flow", o.flow, "alignment from frame to frame");
  field("grow_px", o.growth.beyond_px, "an edge may have become longer by, at either end",
        {0, 100});
  field("max_gap_px", o.growth.max_gap_px, "without support, inside one edge", {1, 1000});
  field("max_tracks", o.max_tracks, "lines followed at once", {1, 10000});
  field("enough_share", o.enough_share, "of max_tracks: no new ones are looked for", {0.01, 1});
  field("max_shift_px", o.max_shift_px, "of a segment from where it is expected", {1, 200});
  field("min_new_px", o.min_new_px, "length of an edge that becomes a track", {5, 1000});
  field("min_length_px", o.min_length_px, "shorter pieces die", {5, 1000});
  field("min_similarity", o.min_similarity, "correlation of its surroundings in two frames",
        {-1, 1});
  field("max_forward_backward_px", o.max_forward_backward_px,
        "disagreement with the way back, across", {0.05, 20});
  field("max_contrast_ratio", o.max_contrast_ratio, "between two frames", {1, 100});
}

LineTracker::LineTracker(const LineTrackerOptions& options) : options_(options) {
  options_.check();
}

void LineTracker::track(const Image& image, const std::vector<LineSegment>& expected) {
  require(!image.empty() && image.type() == CV_8UC1, "LineTracker: grey image needed");
  require(image_.empty() || image.size() == image_.size(), "LineTracker: size of image changed");
  require(expected.empty() || expected.size() == tracks_.size(),
          "LineTracker: one expected segment a track needed");
  const auto strips = std::make_shared<const StripImage>(image);
  merged_.clear();
  std::vector<LineTrack> kept;
  if (!tracks_.empty()) {
    const EdgeRefiner refiner(image, options_.detector.refinement);
    const double border = options_.detector.border_px;
    const int coarsest =
        std::max(0, static_cast<int>(std::ceil(std::log2(options_.max_shift_px / 4))));
    const double max_turn = options_.flow.max_turn_deg * M_PI / 180;
    for (std::size_t i = 0; i < tracks_.size(); ++i) {
      LineTrack track = tracks_[i];
      const LineSegment& wanted = expected.empty() ? track.edge.segment : expected[i];
      const LineSegment seen = clipped(wanted, image, border);
      if (seen.length() < options_.min_length_px) continue;
      const LineSegment before = part_of(track.edge.segment, wanted, seen);
      const auto flow = follow_segment(*strips_, before, *strips, seen, coarsest, options_.flow);
      if (!flow || std::abs(flow->shift_px) > options_.max_shift_px ||
          similarity(flow->alike) < options_.min_similarity)
        continue;
      const auto edge = refiner.follow(flow->segment, options_.growth);
      if (!edge) continue;
      const LineSegment inside = clipped(edge->segment, image, border);
      if (inside.length() < options_.min_length_px) continue;
      const double ratio = edge->contrast / track.edge.contrast;
      if (std::max(ratio, 1 / ratio) > options_.max_contrast_ratio) continue;
      const double turn =
          std::acos(std::clamp(inside.direction().dot(seen.direction()), -1.0, 1.0));
      if (turn > max_turn) continue;
      // The way back, from the edge as it was measured, must end on the edge it came from.
      const LineSegment measured{edge->line.foot(flow->segment.start),
                                 edge->line.foot(flow->segment.end)};
      const auto back = follow_segment(*strips, measured, *strips_, before, 0, options_.flow);
      if (!back || std::max(std::abs(track.edge.segment.offset_of(back->segment.start)),
                            std::abs(track.edge.segment.offset_of(back->segment.end))) >
                       options_.max_forward_backward_px)
        continue;
      track.previous = track.edge.segment;
      track.edge = *edge;
      track.edge.segment = inside;
      ++track.age;
      kept.push_back(track);
    }
  }
  tracks_ = std::move(kept);
  image_ = image;
  strips_ = strips;
  merge_tracks();
}

/// The older of two tracks on one edge goes on, as long as both together reach.
void LineTracker::merge_tracks() {
  std::vector<bool> keep(tracks_.size(), true);
  for (std::size_t j = 1; j < tracks_.size(); ++j)
    for (std::size_t i = 0; i < j && keep[j]; ++i) {
      if (!keep[i]) continue;
      LineTrack &older = tracks_[i], &younger = tracks_[j];
      const double gate = options_.detector.merging.max_distance_px;
      if (!same_edge(older.edge.segment, younger.edge.segment, gate)) continue;
      // The longer of the two measurements is the better one.
      if (younger.edge.segment.length() > older.edge.segment.length()) older.edge = younger.edge;
      merged_.emplace_back(younger.id, older.id);
      keep[j] = false;
    }
  this->keep(keep);
}

void LineTracker::detect(const Image& mask) {
  if (image_.empty() ||
      static_cast<double>(tracks_.size()) >= options_.enough_share * options_.max_tracks)
    return;
  for (const EdgeSegment& edge : detect_segments(image_, options_.detector)) {
    if (static_cast<int>(tracks_.size()) >= options_.max_tracks) break;
    if (edge.segment.length() < options_.min_new_px || share_inside(edge.segment, mask) < 0.5)
      continue;
    const bool covered = std::any_of(tracks_.begin(), tracks_.end(), [&](const LineTrack& track) {
      return same_edge(track.edge.segment, edge.segment, 2);
    });
    if (covered) continue;
    LineTrack track;
    track.id = next_id_++;
    track.edge = edge;
    track.previous = edge.segment;
    tracks_.push_back(track);
  }
}

void LineTracker::keep(const std::vector<bool>& flags) {
  require(flags.size() == tracks_.size(), "LineTracker: one flag a track needed");
  std::size_t n = 0;
  for (std::size_t i = 0; i < tracks_.size(); ++i)
    if (flags[i]) tracks_[n++] = tracks_[i];
  tracks_.resize(n);
}

void LineTracker::reset() {
  tracks_.clear();
  merged_.clear();
  image_ = Image();
  strips_.reset();
}

}  // namespace placegraph
