#include "apps/image/planes/planarity_file.h"

#include <placegraph/io/files/text_file.h>

namespace placegraph::apps {

PlanarityModel read_planarity(const std::string& path) {
  TextFile file(path);
  std::string text;
  for (std::string_view line; file.next(line);) text.append(line).append("\n");
  return parse_planarity(text, path);
}

}  // namespace placegraph::apps
