#pragma once
#include <placegraph/graph/core/log.h>

#include <string>

namespace placegraph {

/// Writes a picture in SVG in the format of the path's ending, beside results that are good without
/// it: `log` takes a warning if the module that makes PNG and PDF is missing.
void write_plot_beside(const std::string& path, const std::string& svg, const LogSink& log);

}  // namespace placegraph
