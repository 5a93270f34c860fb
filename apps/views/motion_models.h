#pragma once
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/internal/core/random.h>
#include <placegraph/io/internal/measurements/match_file.h>

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace placegraph::apps {

/// auto, essential, homography, rotation, gravity, circular, 3d2d, 3d3d.
const std::vector<std::string>& motion_model_names();

struct MotionModelOptions {
  std::string gravity;                 ///< "x,y,z[,x,y,z]": downwards in the first camera [and in
                                       ///< the second]; empty: not known
  std::optional<double> threshold_px;  ///< of inliers; each model has its own otherwise
  std::optional<int> min_inliers;      ///< fewer allow no answer; likewise
  double noise_m = 0.01;               ///< of each coordinate, for two clouds of points
};

/// What every model tells of the motion between two views.
struct MotionEstimate {
  Outcome outcome;
  std::string model;  ///< that explains the views; empty: the one that was asked for
  int matches = 0;    ///< that were read
  std::optional<SE3> T_ref_cur;
  std::optional<SO3> R_ref_cur;            ///< also where the translation is not seen
  bool metric = false;                     ///< else the translation has length 1
  Matrix6d covariance = Matrix6d::Zero();  ///< right tangent
  bool knows_covariance = true;
  std::vector<int> inliers;  ///< indices of matches
  std::vector<SE3> rivals;   ///< other motions that explain the matches as well
  nlohmann::ordered_json evidence = nlohmann::ordered_json::object();  ///< figures of the model
};

/// The motion of a camera by the model `name`: auto, essential, homography or rotation. Throws
/// ArgumentError for options out of range, as all of these do.
MotionEstimate motion_by_two_views(const std::string& name, const MotionModelOptions& asked,
                                   const Camera& camera, const MatchFile& file, Random& random);
/// By three points and both verticals. Throws ArgumentError if `gravity` is of another form.
MotionEstimate motion_by_gravity(const MotionModelOptions& asked, const Camera& camera,
                                 const MatchFile& file, Random& random);
/// Of a car, on a circle, its camera levelled by `gravity` where that is given.
MotionEstimate motion_by_circle(const MotionModelOptions& asked, const Camera& camera,
                                const MatchFile& file);
/// By points of known place [m]: the pose of the camera that sees them.
MotionEstimate motion_by_seen_points(const MotionModelOptions& asked, const Camera& camera,
                                     const SeenPointFile& file, Random& random);
/// By points of known place [m] in both views.
MotionEstimate motion_by_clouds(const MotionModelOptions& asked, const PointPairFile& file,
                                Random& random);

}  // namespace placegraph::apps
