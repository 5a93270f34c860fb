#pragma once
#include <placegraph/eval/internal/plots/plot.h>

#include <string>

namespace placegraph::apps {

/// Throws ArgumentError unless `path` is empty or ends in .png or .svg.
void require_plot_name(const std::string& path);

/// Writes a figure in the format of its extension. Throws FileError.
void write_plot(const std::string& path, const Plot& plot);

}  // namespace placegraph::apps
