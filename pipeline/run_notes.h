#pragma once
#include <placegraph/pipeline/run.h>

#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Notes on the data of the sequence, on its images and on the options.
std::vector<DataNote> notes_of(const Dataset& dataset, const RunOptions& options);

/// Notes on doubts about the scale of the estimated motion.
std::vector<DataNote> notes_of_motion(const RunResult& run, const Trajectory& optimized);

}  // namespace placegraph
