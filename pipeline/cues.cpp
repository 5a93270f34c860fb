#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/cues.h>

#include <set>
#include <sstream>

namespace placegraph {

Cues parse_cues(const std::string& names) {
  Cues cues{false, false, false};
  std::set<std::string> seen;
  std::istringstream list(names);
  for (std::string name; std::getline(list, name, ',');) {
    require(seen.insert(name).second, "cues: '" + name + "' is named twice");
    if (name == "points")
      cues.points = true;
    else if (name == "lines")
      cues.lines = true;
    else if (name == "plane")
      cues.plane = true;
    else
      throw ArgumentError("cues: '" + name + "' is none of points, lines, plane");
  }
  require(cues.points || cues.lines, "cues: points or lines are needed, got '" + names + "'");
  return cues;
}

}  // namespace placegraph
