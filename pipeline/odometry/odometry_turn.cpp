#include <fmt/format.h>
#include <placegraph/pipeline/odometry/odometry.h>

// A single eye that turns on the spot: nothing that comes into view can be placed, but the way it
// turns is seen.

namespace placegraph {

/// Of the tracks since they were seen at `px_before`; nothing if they say that way was made.
std::optional<OdometryUpdate::Turn> Odometry::turn_since(
    const std::map<std::int64_t, Eigen::Vector2d>& px_before, Random& random) const {
  if (metric_from_start() || !cues_.points) return std::nullopt;
  std::vector<Eigen::Vector2d> px_ref, px_cur;
  for (const PointTrack& track : tracker_.tracks())
    if (const auto before = px_before.find(track.id); before != px_before.end()) {
      px_ref.push_back(before->second);
      px_cur.push_back(track.px.cast<double>());
    }
  const Rotation2d2dResult turn =
      estimate_rotation_2d2d(calibration_.camera, px_ref, px_cur, options_.turn, random);
  if (!turn.outcome) return std::nullopt;
  return OdometryUpdate::Turn{turn.R_ref_cur, turn.covariance};
}

/// The second view is still to come; until then a frame stands where its turn puts it.
OdometryUpdate Odometry::wait_turning(const Frame& frame, Random& random) {
  OdometryUpdate update;
  update.turn = turn_since(views_.front().px, random);
  if (!update.turn) return update;
  turned_.emplace_back(frame.id, T_odom_start_ * SE3(update.turn->R_before_cam, {0, 0, 0}));
  // However long it stands: these views are posed, and few judges are enough.
  constexpr std::size_t kMostViews = 64;
  if (views_.size() > kMostViews) {
    std::set<std::int64_t> posed;
    for (const auto& turned : turned_) posed.insert(turned.first);
    std::size_t k = 0;
    std::erase_if(views_, [&](const View& v) { return k++ % 2 == 1 && posed.contains(v.frame); });
  }
  return update;
}

/// Too few points have survived since the reference: this frame takes its place.
OdometryUpdate Odometry::replace_reference(const Frame& frame, const std::optional<SE3>& T_known,
                                           const std::optional<OdometryUpdate::Turn>& turn) {
  const std::string reason =
      cues_.points
          ? fmt::format("{} points of the first view are left, {} needed to tell the motion",
                        tracker_.tracks().size(), 2 * options_.initializer.min_points)
          : "too few lines of the first view are left before others told the motion";
  started_ = false;
  tracker_.reset();
  if (in_known_map_ && !T_known && !turn) {
    OdometryUpdate lost;
    lost.state = TrackingState::kLost;
    lost.reason = reason;
    return lost;
  }
  if (turn)
    turned_.emplace_back(reference_frame_.id, T_odom_start_);
  else
    turned_.clear();  // they hung on what is left behind
  if (T_known) {
    T_odom_start_ = *T_known;
  } else if (turn) {
    T_odom_start_ = T_odom_start_ * SE3(turn->R_before_cam, Eigen::Vector3d::Zero());
    guesses_unit_ = guesses_unit_ || in_known_map_;  // out of the view of what would tell it
    in_known_map_ = false;
  } else {
    T_odom_start_ = T_odom_restart_;
  }
  OdometryUpdate update = begin(frame);
  update.turn = turn;
  if (update.reason.empty()) update.reason = reason;
  if (!update.reference) {  // nothing to go on from: what comes next stands anywhere
    update.turn.reset();
    turned_.clear();
    T_odom_start_ = T_odom_restart_;
  }
  return update;
}

}  // namespace placegraph
