#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/elements.h>
#include <placegraph/pipeline/tracking/cue_list.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <sstream>

namespace placegraph {
namespace {

struct Named {
  const char* name;
  bool Elements::*element;
};
constexpr Named kElements[] = {{"motion", &Elements::motion},
                               {"spatial", &Elements::spatial},
                               {"geometry", &Elements::geometry},
                               {"context", &Elements::context},
                               {"semantics", &Elements::semantics}};

std::string all_names() {
  std::string names;
  for (const Named& named : kElements)
    names += (names.empty() ? "" : ", ") + std::string(named.name);
  return names;
}

}  // namespace

Elements parse_elements(const std::string& names) {
  Elements elements;
  std::set<std::string> seen;
  std::istringstream list(names + ",");
  for (std::string name; std::getline(list, name, ',');) {
    name.erase(0, name.find_first_not_of(' '));
    const auto known = std::find_if(std::begin(kElements), std::end(kElements),
                                    [&](const Named& named) { return name == named.name; });
    require(known != std::end(kElements), "elements: '" + name + "' is none of " + all_names());
    require(seen.insert(name).second, "elements: '" + name + "' is named twice");
    elements.*known->element = true;
  }
  require(
      elements.motion,
      "elements: motion is needed, because no other element estimates the camera's motion; got '" +
          names + "'");
  return elements;
}

void set_elements(const Elements& elements, RunOptions& options) {
  options.slam.loops.enabled = elements.spatial;
  options.slam.odometry.cues = elements.geometry ? "points,lines,plane,manhattan" : "points";
  options.scene.geometry = elements.geometry;
  options.slam.context.enabled = elements.context;
  options.slam.semantics.enabled = options.scene.semantics = elements.semantics;
}

void enable_manhattan_and_planes(RunOptions& options) {
  OdometryOptions& odometry = options.slam.odometry;
  const Cues cues = parse_cues(odometry.cues);
  if (cues.points && !cues.manhattan) odometry.cues += ",manhattan";
  odometry.planes.enabled = true;
}

}  // namespace placegraph
