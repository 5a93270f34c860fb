#pragma once
#include <placegraph/eval/gate/record.h>
#include <placegraph/eval/trajectory/result.h>
#include <placegraph/graph/geometry/trajectory.h>

#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// A fingerprint of the poses of a trajectory: 16 hexadecimal digits.
///
/// It is the same for files of other forms and names that hold the same numbers, with any times;
/// numbers count to 1e-9 m, and to 1e-9 in entries of rotations.
std::string truth_fingerprint(const Trajectory& truth);

/// The figures of runs over one sequence, all judged by `truth`: metrics() of each.
///
/// A run without an outcome has no values and a line among the failures. Of one run, the relative
/// figures have the intervals that its errors along the drive allow (intervals_of_drive, which needs
/// the poses); of several, every figure has that of the runs. The noise of the truth is the floor
/// below which a gate counts no difference (noise_floors).
/// Throws ArgumentError without runs, or if their protocols differ.
[[nodiscard]] SequenceRecord record_of(const std::string& name, const Trajectory& truth,
                                         const std::vector<EvaluationResult>& runs);

}  // namespace placegraph
