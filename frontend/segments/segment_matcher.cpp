#include <placegraph/frontend/segments/local_motion.h>
#include <placegraph/frontend/segments/segment_matcher.h>
#include <placegraph/frontend/segments/segment_profile.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/error.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

namespace placegraph {
namespace {

constexpr double kOneSidePenalty = 0.1;  // least advantage of a match on one side only
constexpr double kDistanceCost = 0.3;    // reduction of the score at the edge of the gate
constexpr double kDoubtCost = 0.005;     // per px by which the gate is wider than gate_px
constexpr double kPartCost = 0.1;        // if only a small part of the longer segment is shared
// Widest gate, margin of the border, and angle and distance of pieces of one edge. Chosen.
constexpr double kMaxGatePx = 40;
constexpr double kBorderPx = 3.5;
constexpr double kOnePieceAngleRad = 0.07, kOnePiecePx = 2.5;

struct View {
  const std::vector<LineSegment>& segments;
  LineProfileImage image;
  std::vector<bool> scene;  ///< false for segments on the border of the image
};

/// A view whose segments on the border of the image, which are not lines of the scene, are marked.
View view_of(const Image& image, const std::vector<LineSegment>& segments) {
  View view{segments, LineProfileImage(image), std::vector<bool>(segments.size(), true)};
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const Eigen::Vector2d low = segments[i].start.cwiseMax(segments[i].end);
    const Eigen::Vector2d high = Eigen::Vector2d(image.cols - 1, image.rows - 1) -
                                 segments[i].start.cwiseMin(segments[i].end);
    view.scene[i] = std::min(low.minCoeff(), high.minCoeff()) > kBorderPx;
  }
  return view;
}

/// Predicted segment in b of a segment of a.
struct Expectation {
  LocalMotion motion;
  LineSegment segment;  ///< segment of a, moved by `motion`
  double gate_px = 0;
};

std::optional<Expectation> expect(const LocalMotionField& field, const LineSegment& a,
                                  double gate_px, int without = -1) {
  const std::optional<LocalMotion> motion = field.around(a, without);
  if (!motion) return std::nullopt;
  Expectation expected;
  expected.motion = *motion;
  expected.segment = {(*motion)(a.start), (*motion)(a.end)};
  if (expected.segment.length() < 1) return std::nullopt;
  expected.gate_px =
      std::min(kMaxGatePx, gate_px + 2 * motion->rms_px + 0.08 * motion->distance_px);
  return expected;
}

/// The common part of a segment of a and one of b, and the distance of b's from the prediction.
struct Overlap {
  LineSegment a, b;  ///< the shared parts, from one scene point to the other
  double share = 0;  ///< share of the shorter segment
  double share_of_longer = 0;
  double distance_px = 0;
  double rotation_rad = 0;  ///< from the expected direction to b's
};

/// Position along b's line of a point of a: the intersection with its epipolar line, if well
/// conditioned, else the foot of the predicted point.
double position_along(const LineSegment& b, const Eigen::Vector2d& px_a,
                      const Eigen::Vector2d& expected, const Eigen::Matrix3d& F_b_a,
                      double gate_px) {
  // 20 degrees: nearer to the epipolar line the crossing is not determined. Chosen.
  constexpr double kLeastSine = 0.35;
  const double foot = b.position_of(expected);
  const Eigen::Vector3d epipolar = F_b_a * px_a.homogeneous();
  const Eigen::Vector2d n = epipolar.head<2>(), d = b.direction();
  if (!(std::abs(n.dot(d)) > kLeastSine * n.norm())) return foot;
  const double crossing = -(n.dot(b.start) + epipolar.z()) / n.dot(d);
  return std::abs(crossing - foot) < 2 * gate_px ? crossing : foot;
}

std::optional<Overlap> overlap(const LineSegment& a, const Expectation& expected,
                               const LineSegment& segment_b, const Eigen::Matrix3d& F_b_a,
                               const SegmentMatcherOptions& options) {
  LineSegment b = segment_b;
  if (b.vector().dot(expected.segment.vector()) < 0) std::swap(b.start, b.end);
  const Eigen::Vector2d direction = b.direction(), wanted = expected.segment.direction();
  Overlap result;
  result.rotation_rad =
      std::atan2(wanted.x() * direction.y() - wanted.y() * direction.x(), wanted.dot(direction));
  if (std::abs(result.rotation_rad) > deg_to_rad(options.max_angle_deg)) return std::nullopt;
  const double from = position_along(b, a.start, expected.segment.start, F_b_a, expected.gate_px);
  const double to = position_along(b, a.end, expected.segment.end, F_b_a, expected.gate_px);
  if (to - from < 1) return std::nullopt;
  const double begin = std::max(0.0, from), end = std::min(b.length(), to);
  result.share = (end - begin) / std::min(b.length(), to - from);
  result.share_of_longer = (end - begin) / std::max(b.length(), to - from);
  if (!(result.share >= options.min_overlap) || end - begin < 4) return std::nullopt;
  result.b = {b.start + begin * direction, b.start + end * direction};
  const auto of_a = [&](double t) -> Eigen::Vector2d {
    return a.start + (t - from) / (to - from) * a.vector();
  };
  result.a = {of_a(begin), of_a(end)};
  const double first = b.offset_of(expected.motion(result.a.start));
  const double last = b.offset_of(expected.motion(result.a.end));
  // A line with another direction intersects the predicted one: its ends must also be near.
  result.distance_px = std::sqrt((first * first + first * last + last * last) / 3);
  if (result.distance_px > expected.gate_px) return std::nullopt;
  return result;
}

double score_of(const Overlap& shared, const Expectation& expected, const View& a, const View& b,
                const SegmentMatcherOptions& options) {
  const double scale = std::sqrt(expected.motion.A.determinant());
  const double step_a = std::max(1.0, 1 / scale);
  const Eigen::Vector2d across_a = step_a * shared.a.normal();
  const Eigen::Vector2d across_b =
      Eigen::Rotation2Dd(shared.rotation_rad) * (expected.motion.A * across_a);
  const LineProfileSimilarity strips =
      compare_strips(a.image, {shared.a.start, shared.a.end, across_a}, b.image,
                     {shared.b.start, shared.b.end, across_b}, options.strip_px);
  const double similarity =
      std::max(strips.both, std::max(strips.left, strips.right) - kOneSidePenalty);
  const double away = shared.distance_px / expected.gate_px;
  return similarity - kDistanceCost * away * away -
         kDoubtCost * (expected.gate_px - options.gate_px) -
         kPartCost * (1 - shared.share_of_longer);
}

std::vector<SegmentMatch> score_candidates(const View& a, const View& b,
                                           const LocalMotionField& field,
                                           const Eigen::Matrix3d& F_b_a,
                                           const SegmentMatcherOptions& options) {
  std::vector<SegmentMatch> candidates;
  for (int i = 0; i < static_cast<int>(a.segments.size()); ++i) {
    if (!a.scene[i]) continue;
    const auto expected = expect(field, a.segments[i], options.gate_px);
    if (!expected) continue;
    for (int j = 0; j < static_cast<int>(b.segments.size()); ++j) {
      if (!b.scene[j]) continue;
      const auto shared = overlap(a.segments[i], *expected, b.segments[j], F_b_a, options);
      if (!shared) continue;
      const double score = score_of(*shared, *expected, a, b, options);
      if (score > options.min_score - options.min_lead) candidates.push_back({i, j, score});
    }
  }
  return candidates;
}

/// Whether two segments may be pieces of one edge.
bool one_edge(const LineSegment& a, const LineSegment& b) {
  const Collinearity lie = collinearity(a, b);
  return lie.angle_rad < kOnePieceAngleRad && lie.distance_px < kOnePiecePx;
}

/// Candidates with a sufficient lead over their rivals. A rival has one of the two segments and
/// another one that is not a piece of the same edge; it is ignored if it has a better partner
/// elsewhere.
std::vector<SegmentMatch> unrivalled(const std::vector<SegmentMatch>& candidates, const View& a,
                                     const View& b, const SegmentMatcherOptions& options) {
  std::vector<std::vector<int>> of_a(a.segments.size()), of_b(b.segments.size());
  std::vector<double> best_a(a.segments.size(), -1), best_b(b.segments.size(), -1);
  for (int c = 0; c < static_cast<int>(candidates.size()); ++c) {
    const SegmentMatch& m = candidates[c];
    of_a[m.a].push_back(c), of_b[m.b].push_back(c);
    best_a[m.a] = std::max(best_a[m.a], m.score), best_b[m.b] = std::max(best_b[m.b], m.score);
  }
  const auto beaten = [&](const SegmentMatch& m, const SegmentMatch& rival, double rival_best) {
    if (rival.score > m.score) return true;
    const bool taken = rival_best > rival.score + options.min_lead;
    return !taken && rival.score > m.score - options.min_lead;
  };
  std::vector<SegmentMatch> kept;
  for (const SegmentMatch& m : candidates) {
    bool keep = m.score >= options.min_score;
    for (int c : of_a[m.a]) {
      const SegmentMatch& rival = candidates[c];
      if (keep && rival.b != m.b && !one_edge(b.segments[rival.b], b.segments[m.b]))
        keep = !beaten(m, rival, best_b[rival.b]);
    }
    for (int c : of_b[m.b]) {
      const SegmentMatch& rival = candidates[c];
      if (keep && rival.a != m.a && !one_edge(a.segments[rival.a], a.segments[m.a]))
        keep = !beaten(m, rival, best_a[rival.a]);
    }
    if (keep) kept.push_back(m);
  }
  return kept;
}

std::vector<SegmentPair> pairs_of(const std::vector<SegmentMatch>& matches, const View& a,
                                  const View& b) {
  std::vector<SegmentPair> pairs;
  for (const SegmentMatch& m : matches) pairs.push_back({a.segments[m.a], b.segments[m.b]});
  return pairs;
}

/// Matches whose positions are predicted by the points and all other matches.
std::vector<SegmentMatch> confirmed(const std::vector<SegmentMatch>& matches,
                                    const std::vector<PointPair>& points, const View& a,
                                    const View& b, const Eigen::Matrix3d& F_b_a,
                                    const SegmentMatcherOptions& options) {
  const LocalMotionField field(points, pairs_of(matches, a, b));
  std::vector<SegmentMatch> kept;
  for (int i = 0; i < static_cast<int>(matches.size()); ++i) {
    const LineSegment& segment = a.segments[matches[i].a];
    const auto expected = expect(field, segment, options.gate_px, i);
    if (expected && overlap(segment, *expected, b.segments[matches[i].b], F_b_a, options))
      kept.push_back(matches[i]);
  }
  return kept;
}

}  // namespace

void SegmentMatcherOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, SegmentMatcherOptions& o) {
  field.group("points", o.points, "points of the epipolar geometry");
  field("max_angle_deg", o.max_angle_deg,
        "maximum angle between a segment and its predicted line [deg]", {1, 60});
  field("gate_px", o.gate_px,
        "maximum distance from the prediction for near, consistent evidence [px]", {0.5, 40});
  field("min_overlap", o.min_overlap, "minimum share of the shorter segment that the other covers",
        {0, 1});
  field("min_score", o.min_score,
        "minimum correlation of the strips minus the cost of the distance", {0, 1});
  field("min_lead", o.min_lead, "minimum lead of the best score over that of the best rival",
        {0, 1});
  field("strip_px", o.strip_px, "half the width of the compared strips [px]", {3, 50});
  field("rounds", o.rounds, "rounds; the matches of each are evidence for the next", {1, 10});
}

SegmentMatches match_segments(const Image& image_a, const std::vector<LineSegment>& a,
                              const Image& image_b, const std::vector<LineSegment>& b,
                              const SegmentMatcherOptions& options) {
  options.check();
  for (const auto* segments : {&a, &b})
    for (const LineSegment& segment : *segments)
      require(segment.length() > 0, "match_segments: a segment has no length");
  SegmentMatches result;
  const WideMatches wide = match_wide(image_a, image_b, options.points);
  result.points = static_cast<int>(wide.pairs.size());
  if (!wide.outcome) {
    result.outcome = wide.outcome;
    return result;
  }
  const View view_a = view_of(image_a, a), view_b = view_of(image_b, b);
  for (int round = 0; round < options.rounds; ++round) {
    const LocalMotionField field(wide.pairs, pairs_of(result.matches, view_a, view_b));
    const auto candidates = score_candidates(view_a, view_b, field, wide.F_b_a, options);
    result.matches = confirmed(unrivalled(candidates, view_a, view_b, options), wide.pairs, view_a,
                               view_b, wide.F_b_a, options);
  }
  result.outcome = Outcome::ok();
  return result;
}

}  // namespace placegraph
