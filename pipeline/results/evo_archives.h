#pragma once
#include <placegraph/eval/tables/figure_table.h>
#include <placegraph/io/evo/evo_result.h>

#include <string>

namespace [[gnu::visibility("default")]] placegraph {

/// The position errors of an evaluation as evo_ape makes them a result.
///
/// The title names the alignment in evo's words. It has evo's seven statistics, the errors, and the
/// aligned trajectories; with times also seconds_from_start, timestamps (those of the truth),
/// distances_from_start (of the truth) and distances. `reference` names the ground truth. Throws
/// NoResult if no frame was evaluated.
EvoResult evo_result_of(const EvaluationResult& result, const std::string& reference);

/// The statistics of a result of evo as figures of a table.
///
/// Keys join evo's label and statistic: "APE (m)" and "rmse" are "ape_m_rmse", named "APE rmse".
/// The title is the protocol; `name` is the sequence. The result has no coverage, as evo writes
/// none.
SequenceFigures figures_of_evo(const EvoResult& result, const std::string& name);

}  // namespace placegraph
