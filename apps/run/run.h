#pragma once
#include "apps/run/run_options.h"
#include "apps/run/run_report.h"

namespace placegraph::apps {

/// `placegraph run`: runs a sequence, or resumes an unfinished run, and writes the results.
/// Progress, events, log messages and warnings go to stderr as `asked.verbosity` admits. SIGINT,
/// SIGTERM and SIGHUP end the run after the present frame; its results are written all the same.
/// Throws ArgumentError, FileError.
RunReport run(const RunArguments& asked);

}  // namespace placegraph::apps
