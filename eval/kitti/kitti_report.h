#pragma once
#include <placegraph/eval/kitti/kitti_result.h>

#include <string>

namespace [[gnu::visibility("default")]] placegraph {

/// Writes a benchmark for people: figures of every sequence, their means, what was checked.
///
/// One system has its tables per length and per speed too; several stand beside each other, a row
/// for each sequence. Every fault and every warning has a line.
std::string to_text(const KittiBenchmark& benchmark);

/// Writes a benchmark as a JSON object with the list `systems`.
///
/// Each has name, outcome, its mean (t_rel_percent, r_rel_deg_per_100m, r_rel_deg_per_m, segments,
/// per_length, per_speed), sequences, faults and warnings; null where there is no figure.
std::string to_json(const KittiBenchmark& benchmark);

/// Writes the figures as CSV, a row for each sequence of each system, and one for its mean.
///
/// Columns: system, sequence ("mean" for all), frames, path_m, segments, t_rel_percent,
/// r_rel_deg_per_100m; without a figure the last two are empty.
std::string to_csv(const KittiBenchmark& benchmark);

}  // namespace placegraph
