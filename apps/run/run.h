#pragma once
#include <placegraph/graph/core/log.h>

#include "apps/run/run_options.h"
#include "apps/run/run_report.h"

namespace placegraph::apps {

/// `placegraph run`: runs the sequence, or goes on with a run that was broken off, and writes the
/// results into their folder. Messages go to `log`, progress and warnings to stderr. Throws
/// ArgumentError, FileError.
RunReport run(const RunArguments& asked, const LogSink& log = {});

}  // namespace placegraph::apps
