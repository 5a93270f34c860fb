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

/// Number of differing bits.
int hamming_distance(const BinaryDescriptor& a, const BinaryDescriptor& b);

/// Number of bits in which `from` differs from each of `to`; several times as fast as one by one
/// where the machine counts bits.
void hamming_distances(const BinaryDescriptor& from, const std::vector<BinaryDescriptor>& to,
                       std::vector<int>& distances);

/// A described image point of a keyframe; `point_cam` [m], in the keyframe's camera frame, where
/// its depth is known.
struct Feature {
  Eigen::Vector2f px = Eigen::Vector2f::Zero();
  float angle_rad = 0;  ///< orientation of the patch
  int octave = 0;       ///< pyramid level it was found at
  BinaryDescriptor descriptor{};
  std::optional<Eigen::Vector3f> point_cam;
};

/// A point of the scene, as the map keeps it: relative to the keyframe that first saw it.
struct PointLandmark {
  LandmarkId id;
  KeyframeId keyframe;
  Eigen::Vector3d point_cam = Eigen::Vector3d::Zero();  ///< [m], in that keyframe's camera frame
  int observations = 0;
};

}  // namespace placegraph
