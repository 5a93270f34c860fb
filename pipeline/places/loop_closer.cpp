#include <placegraph/frontend/features/depth_lookup.h>
#include <placegraph/frontend/features/triangulation.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/places/loop_closer.h>
#include <placegraph/pipeline/places/loop_probability.h>

#include <algorithm>
#include <cmath>

namespace placegraph {

void LoopOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, LoopOptions& o) {
  field("enabled", o.enabled, "look for revisits");
  field.group("detector", o.detector, "features of a keyframe");
  field.group("database", o.database, "retrieval by visual words");
  field.group("verifier", o.verifier, "geometric verification");
  field("min_frame_gap", o.min_frame_gap, "nearer views are neighbours, not revisits", {1, 1e6});
  field("candidates", o.candidates, "retrieved views that are verified", {1, 100});
  field("min_similarity", o.min_similarity,
        "of a candidate, as a share of the similarity to the last keyframe", {0, 10});
  field("support_window", o.support_window, "keyframes within which a second loop must agree",
        {1, 1000});
  field("support_translation", o.support_translation,
        "disagreement of two loops over the median depth plus the way between them", {0.001, 10});
  field("support_angle_deg", o.support_angle_deg, "disagreement of two loops", {0.01, 180});
  field("drift_translation", o.drift_translation,
        "of the odometry over the median depth plus the way since the match", {0.001, 10});
  field("drift_angle_deg", o.drift_angle_deg, "of the odometry, per median depth of way",
        {0.001, 180});
  field("drift_scale", o.drift_scale, "of the unit of one eye (logarithm), per median depth of way",
        {0, 10});
  field("information_scale", o.information_scale,
        "share of a loop's information that counts: feature noise is correlated", {1e-6, 1});
}

LoopCloser::LoopCloser(const LoopOptions& options, const Calibration& calibration,
                       std::uint64_t seed)
    : options_(options), calibration_(calibration), seed_(seed), database_(options.database, seed) {
  options_.check();
}

LoopCloser::LoopCloser(const LoopOptions& options, const Calibration& calibration,
                       std::uint64_t seed, const Map& map)
    : LoopCloser(options, calibration, seed) {
  for (const Keyframe& keyframe : map.keyframes) {
    require(views_.empty() || views_.back().keyframe < keyframe.id,
            "LoopCloser: the map's keyframes must stand in the order of their ids");
    database_.add(keyframe.id, keyframe.features);
    views_.push_back({keyframe.id, keyframe.frame, keyframe.features, {}});
  }
  records_ = map.loops;
}

const LoopCloser::View* LoopCloser::find_view(std::int64_t keyframe) const {
  const auto view =
      std::lower_bound(views_.begin(), views_.end(), keyframe,
                       [](const View& v, std::int64_t id) { return v.keyframe < id; });
  return view != views_.end() && view->keyframe == keyframe ? &*view : nullptr;
}

void LoopCloser::lift_features(const Frame& frame, std::vector<Feature>& features) const {
  if (!calibration_.depth || frame.depth.empty()) return;
  std::vector<Eigen::Vector2f> px;
  for (const Feature& feature : features) px.push_back(feature.px);
  const auto depths = lookup_depth(frame.depth, calibration_.camera, *calibration_.depth, px);
  for (std::size_t i = 0; i < features.size(); ++i) {
    const auto ray = calibration_.camera.unproject(features[i].px.cast<double>());
    if (depths[i] && ray) features[i].point_cam = (*depths[i] * *ray).cast<float>();
  }
}

void LoopCloser::add_view(std::int64_t keyframe, const Frame& frame,
                          const std::optional<SE3>& T_previous_this,
                          std::vector<LineFeature> lines) {
  View view{keyframe, frame.id, detect_features(frame.image, options_.detector, frame.mask),
            std::move(lines)};
  lift_features(frame, view.features);
  std::vector<LineSegment> segments;
  for (const LineFeature& line : view.lines) segments.push_back(line.segment);
  const auto descriptors = describe_segments(frame.image, segments);
  for (std::size_t i = 0; i < view.lines.size(); ++i) view.lines[i].descriptor = descriptors[i];
  if (T_previous_this && !views_.empty() && !calibration_.depth) {
    // Depth by parallax between neighbours: the same way for one eye and for two.
    constexpr double kBandPx = 2.0, kMinParallaxRad = deg_to_rad(0.7);
    std::vector<Feature>& previous = views_.back().features;
    const SE3 T_this_previous = T_previous_this->inverse();
    for (const FeatureMatch& m :
         match_epipolar(calibration_.camera, previous, view.features, *T_previous_this, kBandPx,
                        options_.verifier.matcher)) {
      const auto point = triangulate(calibration_.camera,
                                     {{SE3(), previous[m.a].px.cast<double>()},
                                      {*T_previous_this, view.features[m.b].px.cast<double>()}},
                                     kMinParallaxRad, kBandPx);
      if (!point.outcome) continue;
      if (!previous[m.a].point_cam) previous[m.a].point_cam = point.point_ref.cast<float>();
      view.features[m.b].point_cam = (T_this_previous * point.point_ref).cast<float>();
    }
  }
  database_.add(keyframe, view.features);
  views_.push_back(std::move(view));
}

bool LoopCloser::agree(const Loop& a, const Loop& b, const MotionBetween& odometry,
                       double median_depth_m) const {
  const auto queries = odometry(a.query, b.query);
  const auto matches = odometry(a.match, b.match);
  if (!queries || !matches) return false;
  const Sim3 predicted = Sim3(matches->T_a_b.inverse()) * a.S_match_query() * Sim3(queries->T_a_b);
  // In the query's unit, as the median depth is.
  const Sim3 difference = predicted.inverse() * b.S_match_query();
  const double way = queries->way + matches->way / predicted.scale();
  return difference.translation().norm() < options_.support_translation * (median_depth_m + way) &&
         difference.rotation().log().norm() < deg_to_rad(options_.support_angle_deg) &&
         std::abs(std::log(difference.scale())) < options_.verifier.max_scale_error;
}

/// How far off two keyframes may be, `distance` apart, by errors that no covariance knows, which
/// grow with the way between them; a wrong heading bends the way itself.
LoopCloser::Drift LoopCloser::drift_over(double way, double distance, double median_depth_m) const {
  const double depths = way / median_depth_m;
  Drift drift;
  drift.angle_rad =
      std::min(std::numbers::pi,
               deg_to_rad((options_.support_angle_deg + options_.drift_angle_deg * depths)));
  drift.length =
      options_.drift_translation * (median_depth_m + way) + drift.angle_rad * 0.5 * distance;
  drift.log_scale = options_.verifier.max_scale_error + options_.drift_scale * depths;
  return drift;
}

/// Whether the odometry can have drifted from the loop to where it says it is.
bool LoopCloser::within_drift(const Loop& loop, const MotionBetween& odometry,
                              double median_depth_m, bool free_scale) const {
  const auto tracked = odometry(loop.match, loop.query);
  if (!tracked) return true;
  const SE3 difference = tracked->T_a_b.inverse() * loop.T_match_query;
  Drift most = drift_over(tracked->way, tracked->T_a_b.translation().norm(), median_depth_m);
  if (free_scale) {
    if (std::abs(std::log(loop.scale_match_query)) > most.log_scale) return false;
    // A unit that changed underway leaves a round trip open by a share of the way.
    most.length += std::abs(std::expm1(std::log(loop.scale_match_query))) * tracked->way;
  }
  return difference.translation().norm() <= most.length &&
         difference.rotation().log().norm() <= most.angle_rad;
}

/// Whether the map, as sure as it is of itself, can have its places where the loop says: squared
/// Mahalanobis distance by the marginal covariance of the two, the loop's own, and what may have
/// drifted along the shortest way that the map knows between them, loops included.
bool LoopCloser::within_covariance(const Loop& loop, const KnownMotions& known,
                                   double median_depth_m) const {
  constexpr double kChi2 = 22.46;  // 6 degrees of freedom, 99.9 %
  constexpr double kSigmas = 3;    // what drifts at most, in standard deviations
  const auto predicted = known.map ? known.map(loop.match, loop.query) : std::nullopt;
  if (!predicted) return true;
  const Vector7d error = (predicted->S_a_b.inverse() * loop.S_match_query()).log();
  const Drift most =
      drift_over(predicted->way, predicted->S_a_b.translation().norm(), median_depth_m);
  Vector6d drift;
  drift << Eigen::Vector3d::Constant(most.length), Eigen::Vector3d::Constant(most.angle_rad);
  const bool free_scale = loop.information(6, 6) > 0;
  if (free_scale &&
      std::abs(error[6]) > most.log_scale + kSigmas * std::sqrt(predicted->covariance(6, 6)))
    return false;
  Matrix7d information = loop.information;
  if (!free_scale) information(6, 6) = 1;
  const Eigen::LLT<Matrix7d> factor(information);
  if (factor.info() != Eigen::Success) return true;  // the loop leaves a direction open
  Matrix6d covariance = predicted->covariance.topLeftCorner<6, 6>();
  covariance += factor.solve(Matrix7d::Identity()).topLeftCorner<6, 6>();
  covariance.diagonal() += (drift / kSigmas).cwiseAbs2();
  return error.head<6>().dot(covariance.ldlt().solve(error.head<6>())) < kChi2;
}

/// Whether the two can be so near to each other, by what the odometry may have drifted, that a
/// verified loop would be within_drift: from afar there is nothing to look at.
bool LoopCloser::within_reach(const View& query, const View& match, const MotionBetween& odometry,
                              double median_depth_m) const {
  const auto tracked = odometry(match.keyframe, query.keyframe);
  if (!tracked) return true;
  double farthest = 0;
  for (const Feature& feature : match.features)
    if (feature.point_cam) farthest = std::max<double>(farthest, feature.point_cam->z());
  const double distance = tracked->T_a_b.translation().norm();
  return distance <= options_.verifier.max_baseline_depths * farthest +
                         drift_over(tracked->way, distance, median_depth_m).length;
}

/// Of a candidate of the newest view, which is `likeness` times as like it as the keyframe before.
LoopRecord LoopCloser::judge(const PlaceCandidate& candidate, double likeness,
                             const KnownMotions& known, double median_depth_m) {
  LoopRecord record;
  record.query_frame = views_.back().frame;
  record.match_frame = find_view(candidate.id)->frame;
  record.likeness = likeness;
  record.stage = "retrieval";
  if (likeness >= options_.min_similarity) verify(record, candidate.id, known, median_depth_m);
  record.probability = loop_probability(record);
  return record;
}

/// Verifies a candidate of the newest view; a loop that passes is appended to pending_.
void LoopCloser::verify(LoopRecord& record, std::int64_t candidate, const KnownMotions& known,
                        double median_depth_m) {
  const View& query = views_.back();
  const View& match = *find_view(candidate);
  Random random(seed_, static_cast<std::uint64_t>(query.frame) << 20 | candidate);
  const bool free_scale = known.units_differ && known.units_differ(candidate, query.keyframe);
  record.stage = "drift";
  if (!free_scale && !within_reach(query, match, known.odometry, median_depth_m)) return;
  record.stage = "geometry";
  const LoopVerification verified =
      verify_loop(calibration_.camera, query.for_verification(), match.for_verification(),
                  options_.verifier, random, free_scale);
  record.inliers = verified.inliers;
  record.lines = verified.lines;
  record.model = verified.model;
  if (!verified.outcome) return;
  record.stage = "drift";
  record.T_match_query = verified.T_match_query;
  const Loop loop{query.keyframe, match.keyframe, verified.T_match_query,
                  options_.information_scale * verified.information, verified.scale_match_query};
  if (!within_drift(loop, known.odometry, median_depth_m, free_scale)) return;
  record.stage = "covariance";
  if (!within_covariance(loop, known, median_depth_m)) return;
  record.stage = "support";
  pending_.push_back({loop, records_.size(), views_.size(), false});
}

void LoopCloser::accept(Pending& pending, std::vector<Loop>& accepted) {
  if (pending.accepted) return;
  pending.accepted = true;
  LoopRecord& record = records_[pending.record];
  record.accepted = true;
  record.stage = "accepted";
  record.probability = loop_probability(record);
  accepted.push_back(pending.loop);
}

std::vector<Loop> LoopCloser::find_loops(const KnownMotions& known, double median_depth_m) {
  std::vector<Loop> accepted;
  const View& query = views_.back();
  const double similarity_to_last =
      views_.size() < 2 ? 0
                        : database_.similarity(query.features, views_[views_.size() - 2].keyframe);
  const auto candidates =
      database_.query(query.features, options_.candidates, [&](std::int64_t id) {
        return query.frame - find_view(id)->frame >= options_.min_frame_gap;
      });
  for (const PlaceCandidate& candidate : candidates) {
    // Without a keyframe before there is nothing that likeness could be a share of.
    const double likeness = similarity_to_last > 0 ? candidate.score / similarity_to_last : 1;
    records_.push_back(judge(candidate, likeness, known, median_depth_m));
    if (records_.back().stage == "retrieval") break;  // the rest is less similar still
    if (records_.back().stage != "support") continue;
    Pending& found = pending_.back();
    for (Pending& other : pending_) {
      if (other.loop.query == found.loop.query ||
          !agree(other.loop, found.loop, known.odometry, median_depth_m))
        continue;
      accept(other, accepted);
      accept(found, accepted);
    }
    break;
  }
  while (!pending_.empty() &&
         views_.size() - pending_.front().view >= static_cast<std::size_t>(options_.support_window))
    pending_.pop_front();
  return accepted;
}

std::optional<Loop> LoopCloser::relocalize(const Frame& frame, std::size_t last_views) const {
  std::vector<std::int64_t> tries;
  for (std::size_t back = 1; back <= last_views && back <= views_.size(); ++back)
    tries.push_back(views_[views_.size() - back].keyframe);
  return relocalize(frame, std::move(tries));
}

std::optional<Loop> LoopCloser::relocalize(const Frame& frame,
                                           std::vector<std::int64_t> tries) const {
  if (views_.empty()) return std::nullopt;
  std::vector<Feature> features = detect_features(frame.image, options_.detector, frame.mask);
  lift_features(frame, features);
  for (const PlaceCandidate& c :
       database_.query(features, options_.candidates, [](std::int64_t) { return true; }))
    if (std::find(tries.begin(), tries.end(), c.id) == tries.end()) tries.push_back(c.id);
  for (const std::int64_t id : tries) {
    Random random(seed_, static_cast<std::uint64_t>(frame.id) << 20 | id);
    const LoopVerification verified =
        verify_loop(calibration_.camera, features, find_view(id)->for_verification(),
                    options_.verifier, random);
    // No second loop stands beside this one: two views and a few depths are not enough.
    if (verified.outcome && verified.model == LoopModel::kPoints3d2d)
      return Loop{-1, id, verified.T_match_query,
                  options_.information_scale * verified.information};
  }
  return std::nullopt;
}

void LoopCloser::rescale(double factor, std::int64_t first_keyframe) {
  for (View& view : views_) {
    if (view.keyframe < first_keyframe) continue;
    for (Feature& feature : view.features)
      if (feature.point_cam) *feature.point_cam *= static_cast<float>(factor);
    for (LineFeature& line : view.lines)
      if (line.line_cam)
        line.line_cam = Line3::from_direction(factor * line.line_cam->nearest_point(),
                                              line.line_cam->direction());
  }
  // Loops measured in the old unit may not meet those of the new one.
  pending_.clear();
  for (LoopRecord& record : records_)
    for (const View& view : views_)
      if (view.keyframe >= first_keyframe && view.frame == record.match_frame)
        record.T_match_query = record.T_match_query.scaled(factor);
}

}  // namespace placegraph
