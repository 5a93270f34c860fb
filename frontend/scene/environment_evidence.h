#pragma once
#include <Eigen/Core>
#include <array>
#include <limits>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

struct Camera;
struct LineSegment;
struct SurfaceShares;

/// Number of values in EnvironmentEvidence.
constexpr int kEvidenceCount = 15;
/// Names of the values in EnvironmentEvidence, in their order: "sky_above", ...
const std::array<const char*, kEvidenceCount>& evidence_names();

/// Features of one image by which the kind of environment is classified.
///
/// Each `see` sets some of the values; the others stay nan (without depth or metric scale).
struct EnvironmentEvidence {
  std::array<double, kEvidenceCount> values;  ///< values, in the order of evidence_names()
  /// Sets all values to nan: nothing has been measured yet.
  EnvironmentEvidence() { values.fill(std::numeric_limits<double>::quiet_NaN()); }

  /// Sets the shares of surfaces in the upper and lower half of the image.
  ///
  /// `sky_above ground_above vertical_above ground_below vertical_below object`, 0 to 1.
  void see(const SurfaceShares& shares);
  /// Sets the statistics of the straight edges [px] in an image of `camera`.
  ///
  /// `lines upright level rectangular`: log10 of their length over that of image width and height,
  /// and the shares of it that are upright in the image, level in the image, and along the axes of
  /// the most evident Manhattan frame. The shares stay nan for fewer than 10 edges.
  void see(const std::vector<LineSegment>& segments, const Camera& camera);
  /// Sets the statistics of points in the camera frame (y down); nothing for fewer than 20.
  ///
  /// `spread tall`: log10 of the far over the near depths, and height over depth. If `metric` is
  /// set, also `depth side above`: log10 of depth, distance to the side and height above the camera
  /// [m].
  void see(const std::vector<Eigen::Vector3d>& points_cam, bool metric);
};

}  // namespace placegraph
