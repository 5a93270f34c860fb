#pragma once
#include <placegraph/graph/core/options.h>

#include <string>

namespace [[gnu::visibility("default")]] placegraph {

/// The transformation that is fitted before an estimate is compared with the ground truth.
enum class Alignment {
  kNone,    ///< none: the estimate is compared unchanged
  kOrigin,  ///< the first associated pose is aligned with the ground truth's; nothing is fitted
  kSe3,     ///< rotation and translation by least squares of the positions
  kSim3,    ///< rotation, translation and scale
  kScale,   ///< as kOrigin, and one scale fitted about that first pose
  kYaw,     ///< translation and rotation about the vertical, where gravity is known
};

/// The vertical of the ground truth's world.
enum class Vertical {
  kEstimated,  ///< the axis about which the ground truth turns
  kX,          ///< the world's x
  kY,          ///< the world's y, as in the frame of a camera that looks ahead
  kZ,          ///< the world's z
};

/// The poses that an alignment is fitted to; errors are computed of all poses.
struct AlignmentSpan {
  enum class Unit {
    kAll,      ///< every posed frame
    kFrames,   ///< frames of the ground truth by their number
    kSeconds,  ///< time since the first posed frame
    kPoses,    ///< posed frames by their order
  };
  Unit unit = Unit::kAll;  ///< what begin and end count
  double begin = 0;        ///< first value that belongs to the span
  double end = 1e12;       ///< first value behind it
  void check() const;
};
void visit(OptionVisitor& field, AlignmentSpan& options);

/// Name of an alignment on the command line and in results: "none", "origin", "se3", ...
std::string to_string(Alignment alignment);
/// The span in words: "frames 0:50"; empty for all.
std::string to_string(const AlignmentSpan& span);

}  // namespace placegraph
