#include "apps/support/plot_file.h"

#include <placegraph/graph/core/error.h>

#include "apps/support/output.h"

namespace placegraph::apps {

void require_plot_name(const std::string& path) {
  require(path.empty() || path.ends_with(".png") || path.ends_with(".svg"),
          path + ": a plot ends in .png or .svg");
}

void write_plot(const std::string& path, const Plot& plot) {
  write_file(path, path.ends_with(".svg") ? to_svg(plot) : to_png(plot));
}

}  // namespace placegraph::apps
