#pragma once
#include <placegraph/frontend/vanishing/scene_directions.h>
#include <placegraph/frontend/vanishing/vanishing_options.h>
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/core/random.h>
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/geometry/line_segment.h>

#include <Eigen/Core>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

class VanishingEvidence;
class VanishingModel;

/// Finds the vanishing points of an image's segments; their number is unknown.
///
/// Pairs of segments propose directions, which compete for all segments (VanishingModel) as long as
/// the description length decreases. They are found one by one with new proposals among the
/// unexplained segments (as in Barath & Matas 2019, "Progressive-X"), each of largest likelihood at
/// the noise of the image. Deterministic for a given `random`. Outcomes: too few data (under
/// min_segments), no consensus (no point reduces the cost: labels are all -1). Errors are those of
/// VanishingEvidence.
[[nodiscard]] VanishingPoints find_vanishing_points(const std::vector<LineSegment>& segments,
                                                    const Camera& camera,
                                                    const VanishingPointOptions& options,
                                                    Random& random);

/// Finds the vanishing points of prepared evidence and estimates its noise. The labels are those of
/// lines of the evidence.
[[nodiscard]] VanishingPoints find_vanishing_points(VanishingEvidence& evidence,
                                                    const VanishingPointOptions& options,
                                                    Random& random);

/// Converts a model's directions to vanishing points, most evidence first; `order` receives the
/// index of each in the model.
VanishingPoints vanishing_points(const VanishingEvidence& evidence, const VanishingModel& model,
                                 std::vector<int>& order);

}  // namespace placegraph
