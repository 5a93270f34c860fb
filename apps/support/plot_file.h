#pragma once
#include <string>

namespace placegraph::apps {

/// Throws ArgumentError unless `path` is empty or ends in .png, .svg or .pdf, and FileError if the
/// module that makes PNG and PDF is needed and missing.
void require_plot_name(const std::string& path);

/// Writes a picture in SVG in the format of the path's ending. Throws FileError.
void write_plot(const std::string& path, const std::string& svg);

/// The same for a picture beside results that are good without it.
/// Warns if the module that makes PNG and PDF is missing.
void write_plot_beside(const std::string& path, const std::string& svg);

}  // namespace placegraph::apps
