#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/chi_squared.h>
#include <placegraph/pipeline/cues/plane_cue.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

namespace placegraph {
namespace {

constexpr std::size_t kMostPoints = 400;  ///< maximum number of stored points of a landmark

/// Gate that chance exceeds with a probability of one in a hundred.
double plane_gate() {
  static const double value = chi_squared_quantile(0.99, 3);
  return value;
}

double plane_chi2(const Plane3& a, const Plane3& b, const Eigen::Matrix3d& covariance) {
  const Eigen::Vector3d e = a.minus(b);
  return e.dot(covariance.llt().solve(e));
}

/// The normal of a plane, directed to the side of `viewpoint`.
Eigen::Vector3d toward(const Plane3& plane, const Eigen::Vector3d& viewpoint) {
  return plane.distance_to(viewpoint) < 0 ? Eigen::Vector3d(-plane.normal()) : plane.normal();
}

/// Maximum distance of two points in one place: the spacing of cells of the image.
double reach_m(const Eigen::Vector3d& p_cam) { return 0.08 * p_cam.norm(); }

bool near_one(const Eigen::Vector3d& p, const std::vector<Eigen::Vector3d>& others, double reach) {
  return std::any_of(others.begin(), others.end(), [&](const Eigen::Vector3d& other) {
    return (p - other).squaredNorm() < reach * reach;
  });
}

std::vector<Eigen::Vector3d> thinned(const std::vector<Eigen::Vector3d>& points,
                                     std::size_t count) {
  if (points.size() <= count) return points;
  std::vector<Eigen::Vector3d> result;
  for (std::size_t k = 0; k < count; ++k) result.push_back(points[k * points.size() / count]);
  return result;
}

/// The share of the points of the smaller set that are within the larger one.
double overlap(const std::vector<Eigen::Vector3d>& points_cam,
               const std::vector<Eigen::Vector3d>& others_cam) {
  // Points of a set that are compared: the cost. Chosen.
  constexpr std::size_t kSamples = 150;
  const auto share = [](const std::vector<Eigen::Vector3d>& a,
                        const std::vector<Eigen::Vector3d>& b) {
    double count = 0;
    for (const Eigen::Vector3d& p : a) count += near_one(p, b, reach_m(p));
    return count / static_cast<double>(a.size());
  };
  const auto a = thinned(points_cam, kSamples), b = thinned(others_cam, kMostPoints);
  return std::max(share(a, b), share(b, a));
}

std::vector<Eigen::Vector3d> moved(const SE3& T_new_old, const std::vector<Eigen::Vector3d>& old) {
  std::vector<Eigen::Vector3d> result;
  for (const Eigen::Vector3d& p : old) result.push_back(T_new_old * p);
  return result;
}

}  // namespace

Eigen::Matrix3d PlaneCue::drift(const Plane3& plane_cam) const {
  return plane_information(plane_cam, std::max(1e-6, options_.drift_deg * kRadPerDeg),
                           std::max(1e-6, options_.drift_m))
      .inverse();
}

/// All pairs of planes and landmarks that agree, the best first.
std::vector<PlaneCue::Match> PlaneCue::matches(KeyframeId keyframe,
                                               const std::vector<DepthPlane>& seen,
                                               const SlidingWindow& window) const {
  std::vector<Match> result;
  const SE3 T_map_cam = window.pose(keyframe), T_cam_map = T_map_cam.inverse();
  for (const auto& [id, landmark] : landmarks_) {
    const auto covariance = plane_covariance(window, id, keyframe);
    if (!covariance) continue;
    const Plane3 expected = transform_to(T_map_cam, *window.plane(id));
    const std::vector<Eigen::Vector3d> points_cam = moved(T_cam_map, landmark.points_map);
    for (std::size_t k = 0; k < seen.size(); ++k) {
      const Eigen::Vector3d n = toward(seen[k].plane_cam, Eigen::Vector3d::Zero());
      if (n.dot(T_cam_map.rotation() * landmark.toward_map) < 0) continue;
      const double distance = plane_chi2(
          seen[k].plane_cam, expected, *covariance + seen[k].covariance + drift(seen[k].plane_cam));
      if (!(distance < plane_gate())) continue;
      const double share = overlap(seen[k].points_cam, points_cam);
      if (share < options_.min_overlap) continue;
      // A larger overlap makes a match more probable.
      const double cells =
          share * static_cast<double>(std::min(points_cam.size(), seen[k].points_cam.size()));
      result.push_back({distance, share, distance - 2 * std::log(1 + cells), k, id});
    }
  }
  std::stable_sort(result.begin(), result.end(),
                   [](const Match& a, const Match& b) { return a.score < b.score; });
  return result;
}

void PlaneCue::see(KeyframeId keyframe, const DepthPlane& plane, PlaneId id,
                   SlidingWindow& window) {
  add_plane_observation(
      window, {keyframe, id, plane.plane_cam, (options_.correlation * plane.covariance).inverse()});
  Landmark& landmark = landmarks_.at(id);
  landmark.last_seen = std::max(landmark.last_seen, keyframe);
  const SE3 T_map_cam = window.pose(keyframe);
  landmark.toward_map = toward(*window.plane(id), T_map_cam.translation());
  for (const Eigen::Vector3d& p_cam : thinned(plane.points_cam, kMostPoints)) {
    const Eigen::Vector3d p_map = T_map_cam * p_cam;
    if (!near_one(p_map, landmark.points_map, 0.5 * reach_m(p_cam)))
      landmark.points_map.push_back(p_map);
  }
  // The oldest points are removed first.
  if (landmark.points_map.size() > kMostPoints)
    landmark.points_map.erase(landmark.points_map.begin(),
                              landmark.points_map.end() - static_cast<std::ptrdiff_t>(kMostPoints));
}

/// The candidate with which a plane of the newest keyframe agrees best.
std::optional<std::size_t> PlaneCue::partner(KeyframeId keyframe, const DepthPlane& plane,
                                             const SlidingWindow& window) const {
  double least = plane_gate();
  std::optional<std::size_t> best;
  const Eigen::Vector3d n = toward(plane.plane_cam, Eigen::Vector3d::Zero());
  for (std::size_t k = 0; k < candidates_.size(); ++k) {
    const DepthPlane& before = candidates_[k].plane;
    if (candidates_[k].keyframe == keyframe) continue;
    const auto motion = relative_covariance(window, candidates_[k].keyframe, keyframe);
    if (!motion) continue;
    const SE3 T_before_now = window.pose(candidates_[k].keyframe).inverse() * window.pose(keyframe);
    Eigen::Matrix<double, 3, 6> J_pose;
    Eigen::Matrix3d J_plane;
    const Plane3 expected = transform_to(T_before_now, before.plane_cam, &J_pose, &J_plane);
    if ((T_before_now.rotation() * n).dot(toward(before.plane_cam, Eigen::Vector3d::Zero())) < 0)
      continue;
    const Eigen::Matrix3d covariance = J_plane * before.covariance * J_plane.transpose() +
                                       J_pose * *motion * J_pose.transpose() + plane.covariance +
                                       drift(plane.plane_cam);
    const double distance = plane_chi2(plane.plane_cam, expected, covariance);
    if (distance < least &&
        overlap(plane.points_cam, moved(T_before_now.inverse(), before.points_cam)) >=
            options_.min_overlap)
      best = k, least = distance;
  }
  return best;
}

/// Makes a landmark of two planes that agree.
PlaneId PlaneCue::begin(const Candidate& before, const Candidate& now, SlidingWindow& window) {
  const PlaneId id = next_++;
  window.add_plane(id, transform_to(window.pose(now.keyframe).inverse(), now.plane.plane_cam));
  window.keep(plane_variable(id));
  landmarks_[id] = {};
  see(before.keyframe, before.plane, id, window);
  see(now.keyframe, now.plane, id, window);
  return id;
}

void PlaneCue::forget(KeyframeId keyframe, SlidingWindow& window) {
  while (!landmarks_.empty()) {
    const auto longest = std::min_element(
        landmarks_.begin(), landmarks_.end(),
        [](const auto& a, const auto& b) { return a.second.last_seen < b.second.last_seen; });
    if (static_cast<int>(landmarks_.size()) <= options_.max_landmarks &&
        keyframe.value() - longest->second.last_seen.value() <= options_.patience)
      return;
    window.keep(plane_variable(longest->first), false);
    landmarks_.erase(longest);
  }
}

/// Assigns each landmark to the plane with which it agrees best. A plane gets none if it agrees
/// about equally well with a landmark of the same place that is observed by no other plane, or if
/// another plane agrees about equally well with its landmark, unless that plane observes another
/// one.
std::vector<std::optional<PlaneId>> PlaneCue::assign(const std::vector<Match>& all,
                                                     std::size_t count) {
  constexpr double kClearly = 6;    // difference of plane_chi2 that distinguishes two landmarks
  constexpr double kUndecided = 2;  // difference of scores below which two planes are ambiguous
  std::vector<const Match*> chosen(count, nullptr);
  std::set<PlaneId> taken;
  for (const Match& match : all)
    if (!chosen[match.seen] && taken.insert(match.landmark).second) chosen[match.seen] = &match;
  std::vector<std::optional<PlaneId>> result(count);
  for (std::size_t k = 0; k < count; ++k)
    if (chosen[k]) result[k] = chosen[k]->landmark;
  for (const Match& other : all) {
    const Match* const mine = chosen[other.seen];
    if (mine && !taken.contains(other.landmark) && other.chi2 < mine->chi2 + kClearly &&
        other.overlap > 0.5 * mine->overlap)
      result[other.seen].reset();
    if (mine) continue;
    const auto rival = std::find_if(chosen.begin(), chosen.end(), [&](const Match* m) {
      return m && m->landmark == other.landmark;
    });
    if (rival != chosen.end() && other.score < (*rival)->score + kUndecided)
      result[(*rival)->seen].reset();
  }
  return result;
}

std::vector<std::optional<PlaneId>> PlaneCue::add(KeyframeId keyframe,
                                                  const std::vector<DepthPlane>& seen,
                                                  SlidingWindow& window) {
  const KeyframeId oldest = window.keyframes().front();
  std::erase_if(candidates_, [&](const Candidate& w) { return w.keyframe < oldest; });
  // All queries to the window precede all changes of it.
  const std::vector<Match> all = matches(keyframe, seen, window);
  std::vector<std::optional<PlaneId>> result = assign(all, seen.size());
  std::vector<char> known(seen.size(), 0);
  for (const Match& match : all) known[match.seen] = 1;
  std::vector<std::optional<std::size_t>> partners(seen.size());
  for (std::size_t k = 0; k < seen.size(); ++k)
    if (!known[k]) partners[k] = partner(keyframe, seen[k], window);
  std::vector<Candidate> still;
  std::set<std::size_t> begun;
  for (std::size_t k = 0; k < seen.size(); ++k) {
    if (result[k]) {
      see(keyframe, seen[k], *result[k], window);
    } else if (partners[k] && begun.insert(*partners[k]).second) {
      result[k] = begin(candidates_[*partners[k]], {keyframe, seen[k]}, window);
    } else if (!known[k]) {
      still.push_back({keyframe, seen[k]});
    }
  }
  std::vector<Candidate> before;
  for (std::size_t k = 0; k < candidates_.size(); ++k)
    if (!begun.contains(k)) before.push_back(std::move(candidates_[k]));
  candidates_ = std::move(before);
  candidates_.insert(candidates_.end(), still.begin(), still.end());
  forget(keyframe, window);
  if (log_) {
    std::ostringstream text;
    text << "planes " << keyframe << ":";
    for (std::size_t k = 0; k < seen.size(); ++k) {
      text << " " << seen[k].points_cam.size() << " cells ";
      if (result[k])
        text << "of " << *result[k];
      else
        text << (known[k] ? "ambiguous" : "new");
    }
    log_(LogLevel::kDebug, text.str());
  }
  return result;
}

void PlaneCue::prune(SlidingWindow& window) {
  // Deviation of an observation that does not fit, and the number of them with which a landmark
  // remains. Chosen.
  constexpr double kSigmas = 4;
  constexpr int kMostMisfits = 2;
  if (window.keyframes().empty()) return;
  const KeyframeId newest = window.keyframes().back();
  for (const WindowFactor& seen : plane_observations(window)) {
    const KeyframeId keyframe = seen.variables[0].keyframe();
    const PlaneId plane = seen.variables[1].plane();
    const auto landmark = landmarks_.find(plane);
    if (keyframe != newest || landmark == landmarks_.end()) continue;
    if (residual_sigmas(window, seen)->norm() < kSigmas) {
      landmark->second.misfits = 0;
      continue;
    }
    window.remove(seen);
    if (++landmark->second.misfits <= kMostMisfits) continue;
    window.remove_plane(plane);
    landmarks_.erase(landmark);
  }
}

std::vector<PlaneId> PlaneCue::landmarks() const {
  std::vector<PlaneId> ids;
  for (const auto& [id, landmark] : landmarks_) ids.push_back(id);
  return ids;
}

void PlaneCue::reset() {
  landmarks_.clear();
  candidates_.clear();
  next_ = PlaneId(1);
}

}  // namespace placegraph
