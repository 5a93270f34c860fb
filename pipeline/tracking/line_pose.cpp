#include <placegraph/pipeline/tracking/line_pose.h>

namespace placegraph {
namespace {

/// Tries initial poses, each with the lines in their original state, and keeps the best result.
struct LineSearch {
  const LineCue before;
  LineCue& lines;
  const Image& image;
  const SlidingWindow& window;
  double median_depth;
  Random& random;
  PoseFromLines best = {};

  void from(const PoseGuess& guess) {
    LineCue trial = before;
    trial.track(image, window, guess.T_ref_cam, median_depth);
    const PoseFromLines seen = trial.pose(window, guess, random);
    if (best.outcome && (!seen.outcome || seen.inliers.size() <= best.inliers.size())) return;
    best = seen;
    lines = std::move(trial);
  }
};

/// Search without a pose from points.
void search_by_motion(LineSearch& search, const MotionModel& motion) {
  constexpr MotionModel::Uncertainty kMoving{0.03, 0.5, 0.05}, kUnknown{0.08, 0, 0.05};
  // Share of the lines followed before below which the search is repeated. Chosen.
  constexpr double kFewFound = 0.7;
  PoseGuess guess{
      motion.predicted(),
      motion.information(motion.velocity_known() ? kMoving : kUnknown, search.median_depth)};
  search.from(guess);
  if (!motion.velocity_known())
    for (const double share : {0.04, 0.08, 0.16, -0.04, -0.08}) {
      guess.T_ref_cam =
          motion.predicted() * SE3(SO3(), Eigen::Vector3d(0, 0, share * search.median_depth));
      search.from(guess);
    }
  // The lines found so far provide the pose for finding the others.
  if (search.best.outcome &&
      search.lines.followed(search.window) < kFewFound * search.before.followed(search.window)) {
    guess.T_ref_cam = search.best.T_ref_cam;
    search.from(guess);
  }
}

}  // namespace

PoseFromLines pose_with_lines(LineCue& lines, const Image& image, const SlidingWindow& window,
                              const MotionModel& motion, const Pose3d2dResult& points,
                              double median_depth, Random& random) {
  LineSearch search{lines, lines, image, window, median_depth, random};
  if (points.outcome)
    search.from({points.T_ref_cam, points.information});
  else
    search_by_motion(search, motion);
  PoseFromLines best = std::move(search.best);
  if (!best.outcome && points.outcome) {
    best.outcome = points.outcome;
    best.T_ref_cam = points.T_ref_cam;
    best.information = points.information;
  }
  if (best.outcome) lines.accept(window, best.T_ref_cam);
  return best;
}

}  // namespace placegraph
