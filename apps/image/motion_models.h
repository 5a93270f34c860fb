#pragma once
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/core/random.h>
#include <placegraph/graph/geometry/camera.h>
#include "apps/support/match_file.h"

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace placegraph::apps {

/// Names of the models: auto, essential, homography, rotation, gravity, circular, 3d2d, 3d3d.
const std::vector<std::string>& motion_model_names();

struct MotionModelOptions {
  std::string gravity;  ///< downward direction in the first camera [and in the second],
                        ///< "x,y,z[,x,y,z]"; empty: unknown
  std::optional<double>
      threshold_px;                ///< largest error of an inlier; each model has its own default
  std::optional<int> min_inliers;  ///< smallest number of inliers; each model has its own default
  double noise_m = 0.01;           ///< standard deviation of each coordinate, for two point clouds
};

/// Result of every model: the motion between two views.
struct MotionEstimate {
  Outcome outcome;
  std::string model;  ///< model that explains the views; empty: the requested one
  int matches = 0;    ///< number of matches in the file
  std::optional<SE3> T_ref_cur;
  std::optional<SO3> R_ref_cur;            ///< also set if the translation is unobservable
  bool metric = false;                     ///< if false, the translation has length 1
  Matrix6d covariance = Matrix6d::Zero();  ///< right tangent
  bool knows_covariance = true;
  std::vector<int> inliers;  ///< indices of matches
  std::vector<SE3> rivals;   ///< other motions that explain the matches equally well
  nlohmann::ordered_json evidence = nlohmann::ordered_json::object();  ///< statistics of the model
};

/// Motion of a camera by the model `name`: auto, essential, homography or rotation.
/// Throws ArgumentError for options out of range, as all of these functions do.
MotionEstimate motion_by_two_views(const std::string& name, const MotionModelOptions& asked,
                                   const Camera& camera, const MatchFile& file, Random& random);
/// Motion from three points and both verticals.
/// Throws ArgumentError if `gravity` has another form.
MotionEstimate motion_by_gravity(const MotionModelOptions& asked, const Camera& camera,
                                 const MatchFile& file, Random& random);
/// Motion of a car on a circle; `gravity` levels its camera if it is given.
MotionEstimate motion_by_circle(const MotionModelOptions& asked, const Camera& camera,
                                const MatchFile& file);
/// Pose of a camera from points with known positions [m].
MotionEstimate motion_by_seen_points(const MotionModelOptions& asked, const Camera& camera,
                                     const SeenPointFile& file, Random& random);
/// Motion from points with known positions [m] in both views.
MotionEstimate motion_by_clouds(const MotionModelOptions& asked, const PointPairFile& file,
                                Random& random);

}  // namespace placegraph::apps
