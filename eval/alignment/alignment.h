#pragma once
#include <placegraph/eval/alignment/alignment_options.h>
#include <placegraph/eval/association/frame_pair.h>
#include <placegraph/eval/alignment/umeyama.h>

#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Fits the alignment of the given kind to the pairs of a span that have an estimate.
///
/// `vertical_axis`: unit vector in the truth's world, needed by kYaw alone. `doubts` of the result
/// name what the positions do not determine: a line, a mirror image, few poses. Outcomes:
/// kTooFewData (no pair in the span; fewer than three for kSe3 and kSim3, than two for kScale and
/// kYaw); kDegenerate as umeyama, for kScale if the estimate never moves or the fitted scale is not
/// positive, for kScale and kSim3 if the two motions have too little in common to show a scale, and
/// for kYaw if the positions move along the vertical alone.
[[nodiscard]] AlignmentResult align(const std::vector<FramePair>& pairs, Alignment alignment,
                                    const AlignmentSpan& over = {},
                                    const Eigen::Vector3d& vertical_axis =
                                        Eigen::Vector3d::UnitZ());

}  // namespace placegraph
