#pragma once
#include <placegraph/graph/scene/decision_forest.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// What a surface of a scene is, geometrically.
enum class Surface : std::uint8_t { kSky, kGround, kVertical, kObject };
constexpr int kSurfaceCount = 4;
/// "sky", "ground", "vertical", "object".
const std::string& surface_name(Surface surface);
std::optional<Surface> surface_of_name(const std::string& name);

/// A class of a labelled set: its number in label images, and nothing as surface where it is void.
struct SceneClass {
  int id = 0;
  std::string name;
  std::optional<Surface> surface;
};

/// How classes lie to each other: log P(a, b in this relation) / (P(a) P(b)), a x b, row by row;
/// 0 where it is chance.
struct RelationTable {
  std::vector<float> above;   ///< a above b
  std::vector<float> beside;  ///< symmetric
};

/// A trained labelling of superpixels: a forest on what they show, a second one that sees the first
/// one's answers around too, and a random field.
struct SceneModel {
  enum class Kind : std::uint32_t { kSurfaces, kUrban };
  Kind kind = Kind::kSurfaces;
  std::vector<std::string> classes;
  std::vector<Surface> surfaces;  ///< of each class
  DecisionForest first, second;
  RelationTable relations;
  float smoothness = 0, relation_weight = 0;  ///< of the random field
  float sharpness = 1;                        ///< exponent that makes its shares probabilities
  /// What they were learned from, one line.
  std::string origin;

  int class_count() const { return static_cast<int>(classes.size()); }
  /// What is inconsistent in it, if anything.
  std::optional<std::string> problem() const;
};

}  // namespace placegraph
