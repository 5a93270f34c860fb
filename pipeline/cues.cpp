#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/cues.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <sstream>

namespace placegraph {
namespace {

struct Named {
  const char* name;
  bool Cues::*cue;
  bool usable;
};
constexpr Named kCues[] = {{"points", &Cues::points, true},
                           {"lines", &Cues::lines, true},
                           {"plane", &Cues::plane, true},
                           {"manhattan", &Cues::manhattan, true},
                           {"direct", &Cues::direct, false}};

std::string usable_names() {
  std::string names;
  for (const Named& named : kCues)
    if (named.usable) names += (names.empty() ? "" : ", ") + std::string(named.name);
  return names;
}

}  // namespace

Cues parse_cues(const std::string& names) {
  Cues cues{false, false, false, false, false};
  std::set<std::string> seen;
  std::istringstream list(names);
  for (std::string name; std::getline(list, name, ',');) {
    const auto known = std::find_if(std::begin(kCues), std::end(kCues),
                                    [&](const Named& named) { return name == named.name; });
    require(known != std::end(kCues), "cues: '" + name + "' is none of " + usable_names());
    require(known->usable,
            "cues: '" + name + "' cannot be used in a run yet; there are " + usable_names());
    require(seen.insert(name).second, "cues: '" + name + "' is named twice");
    cues.*known->cue = true;
  }
  require(cues.points || cues.lines, "cues: points or lines are needed, got '" + names + "'");
  return cues;
}

}  // namespace placegraph
