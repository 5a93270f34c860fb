#pragma once
#include <Eigen/Core>
#include <array>
#include <limits>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

struct Camera;
struct LineSegment;
struct SurfaceShares;

constexpr int kEvidenceCount = 15;
/// Their names, in order.
const std::array<const char*, kEvidenceCount>& evidence_names();

/// What one view says of the kind of environment it was taken in, each a number of its own; nan
/// where it was not looked at (no depth, no unit).
struct EnvironmentEvidence {
  std::array<double, kEvidenceCount> values;
  EnvironmentEvidence() { values.fill(std::numeric_limits<double>::quiet_NaN()); }

  /// `sky_above ground_above vertical_above ground_below vertical_below object`.
  void see(const SurfaceShares& shares);
  /// `lines upright level rectangular`: how much straight edge there is, shares of it that are
  /// upright and level in the image, and that point along the axes of the likeliest rectangular
  /// world. Edges [px] of an image of `camera`.
  void see(const std::vector<LineSegment>& segments, const Camera& camera);
  /// `spread tall depth side above`: how much farther the far points are than the near ones, how
  /// high they reach for how far they are; and, where `metric`, how far away, how far to the side
  /// and how high above the camera they are. Points in the camera's frame (y down) and unit;
  /// nothing of fewer than 20.
  void see(const std::vector<Eigen::Vector3d>& points_cam, bool metric);
};

}  // namespace placegraph
