#pragma once
#include <placegraph/frontend/internal/vanishing/vanishing_model.h>
#include <placegraph/frontend/lines/line_options.h>
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/internal/core/random.h>

namespace placegraph {

/// A direction in which edges of the scene point.
struct VanishingPoint {
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();  ///< unit, camera frame, z >= 0
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of the direction; zero along it
  int segments = 0;                                      ///< that point there
  double evidence = 0;  ///< what the description length would gain without it [nats]
};

struct VanishingPoints {
  Outcome outcome;
  std::vector<VanishingPoint> points;  ///< most evidence first
  std::vector<int> labels;             ///< per segment, an index into points or -1
  VanishingNoise noise;                ///< as it was estimated
};

/// The vanishing points of an image's segments, their number unknown: pairs of segments propose
/// directions, which compete for all segments (VanishingModel) as long as the description length
/// falls, found one by one with fresh proposals among what is unexplained (as in Barath & Matas
/// 2019, "Progressive-X"), each of largest likelihood at the noise of the image. Deterministic for
/// a given `random`. Outcomes: too few data (under min_segments), no consensus (no point is worth
/// its cost: labels are all -1). Errors are VanishingEvidence's.
[[nodiscard]] VanishingPoints find_vanishing_points(const std::vector<LineSegment>& segments,
                                                    const Camera& camera,
                                                    const VanishingPointOptions& options,
                                                    Random& random);

/// The same on evidence that was made ready, whose noise is estimated on the way. The labels are of
/// lines of the evidence.
[[nodiscard]] VanishingPoints find_vanishing_points(VanishingEvidence& evidence,
                                                    const VanishingPointOptions& options,
                                                    Random& random);

/// A model's directions as vanishing points, most evidence first; `order` receives the number of
/// each in the model.
VanishingPoints vanishing_points(const VanishingEvidence& evidence, const VanishingModel& model,
                                 std::vector<int>& order);

}  // namespace placegraph
