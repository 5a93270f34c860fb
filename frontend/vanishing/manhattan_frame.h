#pragma once
#include <placegraph/frontend/vanishing/scene_directions.h>
#include <placegraph/frontend/vanishing/vanishing_options.h>
#include <placegraph/frontend/vanishing/vanishing_points.h>
#include <placegraph/graph/geometry/so3.h>

#include <array>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Finds the Manhattan frames of the evidence's segments, most evident first.
///
/// Empty if no two orthogonal directions have enough segments. Candidates: two orthogonal vanishing
/// points, or one and a segment that passes through another (METHODS: three-line minimal sets).
/// Each is refined on SO(3) by reweighted Gauss-Newton over all segments that its axes win, with
/// the axes' own deviations from right angles integrated out under a variance of largest
/// likelihood. A further frame must have an axis that no previous frame has. `axis` is per line of
/// the evidence.
[[nodiscard]] std::vector<ManhattanFrame> find_manhattan_frames(const VanishingEvidence& evidence,
                                                                const VanishingPoints& points,
                                                                const ManhattanOptions& options);

/// Estimates the most evident Manhattan frame of an image's segments. Errors are those of
/// VanishingEvidence.
[[nodiscard]] ManhattanFrame estimate_manhattan_frame(const std::vector<LineSegment>& segments,
                                                      const Camera& camera,
                                                      const VanishingPointOptions& points,
                                                      const ManhattanOptions& options,
                                                      Random& random);

/// Estimates the frame near a predicted one with standard deviation `sigma_rad` about every axis.
///
/// The prediction limits the search and is not part of the information: directions that the
/// segments do not determine stay as predicted, without information. Errors are those of
/// VanishingEvidence.
[[nodiscard]] ManhattanFrame track_manhattan_frame(const std::vector<LineSegment>& segments,
                                                   const Camera& camera,
                                                   const SO3& R_cam_manhattan_predicted,
                                                   double sigma_rad, const VanishingNoise& noise,
                                                   const ManhattanOptions& options);

/// The one of the 24 frames along the same axes that is nearest to `like`.
SO3 nearest_axes(const SO3& R_cam_manhattan, const SO3& like);

}  // namespace placegraph
