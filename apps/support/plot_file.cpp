#include "apps/support/plot_file.h"

#include <placegraph/eval/drawing/picture_bytes.h>
#include <placegraph/graph/core/error.h>

#include "apps/support/output.h"

namespace placegraph::apps {

void require_plot_name(const std::string& path) {
  require(path.empty() || is_plot_name(path), path + ": a plot ends in .png, .svg or .pdf");
  if (!path.empty() && !path.ends_with(".svg")) require_drawings(path);
}

void write_plot(const std::string& path, const std::string& svg) {
  write_file(path, picture_bytes(svg, path));
}

void write_plot_beside(const std::string& path, const std::string& svg) {
  std::string bytes;
  try {
    bytes = picture_bytes(svg, path);
  } catch (const FileError& error) {
    return warn(error.what());
  }
  write_file(path, bytes);
}

}  // namespace placegraph::apps
