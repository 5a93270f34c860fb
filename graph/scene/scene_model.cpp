#include <placegraph/graph/scene/scene_model.h>

#include <array>
#include <cmath>

namespace placegraph {
namespace {

const std::array<std::string, kSurfaceCount> kSurfaceNames = {"sky", "ground", "vertical",
                                                              "object"};

}  // namespace

const std::string& surface_name(Surface surface) {
  return kSurfaceNames[static_cast<std::size_t>(surface)];
}

std::optional<Surface> surface_of_name(const std::string& name) {
  for (std::size_t i = 0; i < kSurfaceNames.size(); ++i)
    if (kSurfaceNames[i] == name) return static_cast<Surface>(i);
  return std::nullopt;
}

std::optional<std::string> SceneModel::problem() const {
  const std::size_t n = classes.size();
  if (n < 2 || n > 64 || surfaces.size() != n) return "classes and their surfaces do not agree";
  for (const DecisionForest* forest : {&first, &second}) {
    if (forest->classes != class_count()) return "a forest has another number of classes";
    if (const auto problem = forest->problem()) return problem;
  }
  if (relations.above.size() != n * n || relations.beside.size() != n * n)
    return "a table of relations has the wrong size";
  for (const std::vector<float>* table : {&relations.above, &relations.beside})
    for (const float value : *table)
      if (!std::isfinite(value)) return "a relation is not finite";
  const auto within = [](float value, float most) { return value >= 0 && value <= most; };
  if (!within(smoothness, 100) || !within(relation_weight, 100) || !within(sharpness, 100) ||
      sharpness == 0)
    return "weights are out of range";
  return std::nullopt;
}

}  // namespace placegraph
