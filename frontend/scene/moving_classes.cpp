#include <placegraph/frontend/scene/moving_classes.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <sstream>

namespace placegraph {

std::vector<bool> moving_classes(const std::string& names, const SceneModel& model) {
  std::vector<bool> moving(model.classes.size(), false);
  std::istringstream list(names);
  for (std::string name; std::getline(list, name, ',');) {
    const auto found = std::find(model.classes.begin(), model.classes.end(), name);
    require(found != model.classes.end(),
            "moving: '" + name + "' is not a class of the model of urban classes");
    moving[static_cast<std::size_t>(found - model.classes.begin())] = true;
  }
  return moving;
}

}  // namespace placegraph
