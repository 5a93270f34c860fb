#include <placegraph/frontend/cloud_planes/planarity_model.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

namespace placegraph {

std::string to_text(const PlanarityModel& model) {
  const auto number = [](double value) {
    char text[32];
    const auto end = std::to_chars(text, text + sizeof text, value).ptr;
    return std::string(text, end);
  };
  std::string text = "planarity " + std::to_string(kPlanarityFeatures) + '\n';
  for (const PlanarityModel::Stump& stump : model.stumps)
    text += std::string(planarity_feature_names()[static_cast<std::size_t>(stump.feature)]) + ' ' +
            number(stump.threshold) + ' ' + number(stump.below) + ' ' + number(stump.above) + '\n';
  return text;
}

PlanarityModel parse_planarity(const std::string& text, const std::string& path) {
  const auto& names = planarity_feature_names();
  std::istringstream stream(text);
  PlanarityModel model;
  int number = 0;
  for (std::string line; std::getline(stream, line);) {
    ++number;
    if (line.empty() || line[0] == '#') continue;
    std::istringstream fields(line);
    fields.imbue(std::locale::classic());
    std::string name, rest;
    PlanarityModel::Stump stump;
    int features = 0;
    fields >> name;
    if (name == "planarity" && fields >> features) {
      if (features != kPlanarityFeatures)
        throw FileError(path, number,
                        std::to_string(features) + " features, this program has " +
                            std::to_string(kPlanarityFeatures));
      continue;
    }
    const auto known = std::find(names.begin(), names.end(), name);
    if (known == names.end() || !(fields >> stump.threshold >> stump.below >> stump.above) ||
        fields >> rest || !std::isfinite(stump.threshold + stump.below + stump.above))
      throw FileError(path, number, "a stump is: feature threshold below above");
    stump.feature = static_cast<int>(known - names.begin());
    model.stumps.push_back(stump);
  }
  return model;
}

}  // namespace placegraph
