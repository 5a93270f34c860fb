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
/// Several times as fast as one by one where the processor counts bits.
void hamming_distances(const BinaryDescriptor& from, const std::vector<BinaryDescriptor>& to,
                       std::vector<int>& distances);

/// An image point of a keyframe with its descriptor and, where known, its position.
struct Feature {
  Eigen::Vector2f px = Eigen::Vector2f::Zero();  ///< in the full-size image
  float angle_rad = 0;                           ///< orientation of the patch
  int octave = 0;                                ///< pyramid level that it was found at
  BinaryDescriptor descriptor{};                 ///< of the patch
  /// In the keyframe's camera frame and unit of length; nothing where the depth is not known.
  std::optional<Eigen::Vector3f> point_cam;
};

/// A point of the scene as the map keeps it: relative to the keyframe that it is anchored at.
struct PointLandmark {
  LandmarkId id;        ///< of the point and of its track
  KeyframeId keyframe;  ///< the keyframe whose frame `point_cam` is in
  /// In that keyframe's camera frame and unit of length.
  Eigen::Vector3d point_cam = Eigen::Vector3d::Zero();
  int observations = 0;  ///< keyframes that observed it
};

}  // namespace placegraph
