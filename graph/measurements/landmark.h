#pragma once
#include <placegraph/graph/core/ids.h>

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// 256 bits of a binary descriptor (ORB, BRIEF).
using BinaryDescriptor = std::array<std::uint64_t, 4>;

/// Number of differing bits, 0 to 256.
int hamming_distance(const BinaryDescriptor& a, const BinaryDescriptor& b);

/// Writes the number of bits in which `from` differs from each of `to` to `distances`.
/// Several times as fast as single calls if the processor has an instruction that counts bits.
void hamming_distances(const BinaryDescriptor& from, const std::vector<BinaryDescriptor>& to,
                       std::vector<int>& distances);

/// An image point of a keyframe with its descriptor and, where known, its position.
struct Feature {
  Eigen::Vector2f px = Eigen::Vector2f::Zero();  ///< position in the full-size image [px]
  float angle_rad = 0;                           ///< orientation of the patch
  int octave = 0;                                ///< pyramid level of the detection
  BinaryDescriptor descriptor{};                 ///< descriptor of the patch
  /// Position in the keyframe's camera frame, at the keyframe's scale; nothing if the depth is
  /// unknown.
  std::optional<Eigen::Vector3f> point_cam;
};

/// Where a keyframe's image shows a landmark.
struct LandmarkObservation {
  LandmarkId landmark;                           ///< the landmark
  Eigen::Vector2f px = Eigen::Vector2f::Zero();  ///< position in the undistorted image [px]
  int camera = 0;                                ///< 0: the (left) camera
};

/// A point of the scene, stored relative to its anchor keyframe.
struct PointLandmark {
  LandmarkId id;        ///< id of the point and of its track
  KeyframeId keyframe;  ///< the anchor keyframe
  /// Position in the anchor keyframe's camera frame, at that keyframe's scale.
  Eigen::Vector3d point_cam = Eigen::Vector3d::Zero();
  int observations = 0;  ///< number of keyframes that observed it in its last window
  /// Covariance of `point_cam` given the poses of the keyframes, by all observations of the window
  /// that it left last; nothing if they do not determine the point.
  std::optional<Eigen::Matrix3d> covariance = {};
  /// Red, green and blue of its image in a keyframe, equal in a grey one; nothing if unknown.
  std::optional<std::array<std::uint8_t, 3>> rgb = {};
};

}  // namespace placegraph
