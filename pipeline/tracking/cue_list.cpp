#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/tracking/cue_list.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <sstream>

namespace placegraph {
namespace {

struct Named {
  const char* name;
  bool Cues::*cue;
};
constexpr Named kCues[] = {{"points", &Cues::points},
                           {"lines", &Cues::lines},
                           {"plane", &Cues::plane},
                           {"manhattan", &Cues::manhattan},
                           {"direct", &Cues::direct}};

std::string all_names() {
  std::string names;
  for (const Named& named : kCues) names += (names.empty() ? "" : ", ") + std::string(named.name);
  return names;
}

}  // namespace

Cues parse_cues(const std::string& names) {
  Cues cues{false, false, false, false, false};
  std::set<std::string> seen;
  std::istringstream list(names + ",");
  for (std::string name; std::getline(list, name, ',');) {
    // Spaces after commas are accepted: "points, lines".
    name.erase(0, name.find_first_not_of(' '));
    const auto known = std::find_if(std::begin(kCues), std::end(kCues),
                                    [&](const Named& named) { return name == named.name; });
    require(known != std::end(kCues), "cues: '" + name + "' is none of " + all_names());
    require(seen.insert(name).second, "cues: '" + name + "' is named twice");
    cues.*known->cue = true;
  }
  require(cues.points || cues.lines || cues.without_features(),
          "cues: one of points, lines, plane, direct is needed, got '" + names + "'");
  return cues;
}

bool metric_from_start(const Cues& cues, const Calibration& calibration) {
  return calibration.baseline_m > 0 || calibration.depth ||
         (cues.without_features() && calibration.camera_height_m);
}

}  // namespace placegraph
