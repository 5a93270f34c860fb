#include <placegraph/frontend/lines/line_tracker.h>
#include <placegraph/frontend/segments/segment_merging.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

/// Similarity of both sides of an edge, or of one side if the other has changed.
double similarity(const LineProfileSimilarity& similar) {
  // Correlation that one side must exceed both by. Chosen.
  constexpr double kOneSidePenalty = 0.1;
  return std::max(similar.both, std::max(similar.left, similar.right) - kOneSidePenalty);
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

/// The part of a segment that overlaps with the other.
LineSegment common_part(const LineSegment& segment, const LineSegment& other) {
  const double length = segment.length();
  const double from = std::clamp(segment.position_of(other.start), 0.0, length);
  const double to = std::clamp(segment.position_of(other.end), 0.0, length);
  return {segment.start + from * segment.direction(), segment.start + to * segment.direction()};
}

double share_inside(const LineSegment& segment, const Image& mask) {
  if (mask.empty()) return 1;
  // Points of a segment that are looked up: the cost. Chosen.
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

/// Whether two segments are one edge: same direction, collinear, overlapping.
bool same_edge(const LineSegment& a, const LineSegment& b, double max_distance_px) {
  constexpr double kMaxAngle = 0.05, kLeastOverlap = 0.3;  // [rad]; share of the shorter
  const Eigen::Vector2d along_a = a.vector(), along_b = b.vector();
  const double reach = max_distance_px + 0.5 * (a.length() + b.length());
  if (along_a.dot(along_b) <= 0 || (a.middle() - b.middle()).squaredNorm() > reach * reach)
    return false;
  const Collinearity lie = collinearity(a, b);
  return lie.angle_rad < kMaxAngle && lie.distance_px < max_distance_px &&
         -lie.gap_px > kLeastOverlap * std::min(a.length(), b.length());
}

}  // namespace

LineTracker::LineTracker(const LineTrackerOptions& options) : options_(options) {
  options_.check();
}

void LineTracker::track(const Image& image, const std::vector<LineSegment>& expected) {
  require(!image.empty() && image.type() == CV_8UC1, "LineTracker: grey image needed");
  require(image_.empty() || image.size() == image_.size(), "LineTracker: size of image changed");
  require(expected.empty() || expected.size() == tracks_.size(),
          "LineTracker: one expected segment per track needed");
  const auto strips = std::make_shared<const LineProfileImage>(image);
  const auto refiner = std::make_shared<const EdgeRefiner>(image);
  merged_.clear();
  std::vector<LineTrack> kept;
  if (!tracks_.empty()) {
    const double border = options_.detector.border_px;
    const int coarsest =
        std::max(0, static_cast<int>(std::ceil(std::log2(options_.max_shift_px / 4))));
    const double max_rotation = deg_to_rad(kMaxSegmentRotation_deg);
    for (std::size_t i = 0; i < tracks_.size(); ++i) {
      LineTrack track = tracks_[i];
      const LineSegment& wanted = expected.empty() ? track.edge.segment : expected[i];
      const LineSegment seen = clipped(wanted, image, border);
      if (seen.length() < options_.min_length_px) continue;
      const LineSegment before = part_of(track.edge.segment, wanted, seen);
      const auto flow = follow_segment(*strips_, before, *strips, seen, coarsest);
      if (!flow || std::abs(flow->shift_px) > options_.max_shift_px ||
          similarity(flow->similar) < options_.min_similarity)
        continue;
      const auto edge = refiner->follow(flow->segment, options_.growth);
      if (!edge) continue;
      const LineSegment inside = clipped(edge->segment, image, border);
      if (inside.length() < options_.min_length_px) continue;
      const double ratio = edge->contrast / track.edge.contrast;
      if (std::max(ratio, 1 / ratio) > options_.max_contrast_ratio) continue;
      const double angle =
          std::acos(std::clamp(inside.direction().dot(seen.direction()), -1.0, 1.0));
      if (angle > max_rotation) continue;
      if (!leads_back(track.edge.segment, before, flow->segment, *edge, *strips)) continue;
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
  refiner_ = refiner;
  merge_tracks();
}

/// Whether backward tracking of the measured edge ends on the original edge. Only the measured part
/// is used: the error of a rotation by noise grows beyond it.
bool LineTracker::leads_back(const LineSegment& origin, const LineSegment& before,
                             const LineSegment& aligned, const EdgeSegment& edge,
                             const LineProfileImage& strips) const {
  // Length with a direction, as for the alignment. Chosen.
  constexpr double kLeast_px = 4;
  const LineSegment supported = common_part(aligned, edge.segment);
  if (supported.length() < kLeast_px) return false;
  const LineSegment measured{edge.line.foot(supported.start), edge.line.foot(supported.end)};
  const auto back =
      follow_segment(strips, measured, *strips_, part_of(before, aligned, supported), 0);
  if (!back) return false;
  const auto agrees = [&](const LineSegment& seen) {
    return std::max(std::abs(origin.offset_of(seen.start)), std::abs(origin.offset_of(seen.end))) <=
           options_.max_forward_backward_px;
  };
  if (agrees(back->segment)) return true;
  // If the surroundings move differently, both alignments are wrong, but not the edge.
  const auto again = refiner_->follow(back->segment, {0, options_.growth.max_gap_px});
  return again &&
         agrees({again->line.foot(back->segment.start), again->line.foot(back->segment.end)});
}

/// Merges tracks on one edge: the older one continues, extended to the length of both.
void LineTracker::merge_tracks() {
  std::vector<bool> keep(tracks_.size(), true);
  for (std::size_t j = 1; j < tracks_.size(); ++j)
    for (std::size_t i = 0; i < j && keep[j]; ++i) {
      if (!keep[i]) continue;
      LineTrack &older = tracks_[i], &younger = tracks_[j];
      if (!same_edge(older.edge.segment, younger.edge.segment, kMaxEdgeDistance_px)) continue;
      // The longer of the two measurements is more accurate.
      if (younger.edge.segment.length() > older.edge.segment.length()) older.edge = younger.edge;
      merged_.emplace_back(younger.id, older.id);
      keep[j] = false;
    }
  this->keep(keep);
}

void LineTracker::detect(const Image& mask, const WhereLater& later) {
  const auto share_of_most = [&](double share) { return share * options_.max_tracks; };
  const auto count = [&] { return static_cast<double>(tracks_.size()); };
  if (image_.empty() || count() >= share_of_most(options_.enough_share)) return;
  std::vector<EdgeSegment> fresh, leaving;
  for (const EdgeSegment& edge : detect_segments(image_, options_.detector)) {
    if (edge.segment.length() < options_.min_new_px || share_inside(edge.segment, mask) < 0.5)
      continue;
    const bool stays =
        !later || clipped(later(edge.segment), image_, options_.detector.border_px).length() >=
                      options_.min_length_px;
    (stays ? fresh : leaving).push_back(edge);
  }
  const auto begin = [&](const std::vector<EdgeSegment>& edges, double most) {
    for (const EdgeSegment& edge : edges) {
      if (count() >= most) return;
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
  };
  begin(fresh, share_of_most(1));
  begin(leaving, share_of_most(options_.leaving_share));
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
  refiner_.reset();
}

}  // namespace placegraph
