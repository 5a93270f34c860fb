#pragma once
#include <placegraph/graph/scene/decision_forest.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// The geometric kind of a surface; kObject is a thing that may move, such as a car.
enum class Surface : std::uint8_t { kSky, kGround, kVertical, kObject };
/// Number of kinds.
constexpr int kSurfaceCount = 4;
/// The name of a kind: "sky", "ground", "vertical" or "object".
const std::string& surface_name(Surface surface);
/// The kind with the given name; nothing for any other text.
std::optional<Surface> surface_of_name(const std::string& name);

/// A class of a labelled data set.
struct SceneClass {
  int id = 0;                      ///< its value in label images
  std::string name;                ///< name in the data set's list of classes
  std::optional<Surface> surface;  ///< nothing for void, which is neither learned nor judged
};

/// Spatial relations between classes: log P(a, b in this relation) / (P(a) P(b)).
/// Tables are class a x class b, row by row; 0 where the relation is as frequent as by chance.
struct RelationTable {
  std::vector<float> above;   ///< a above b
  std::vector<float> beside;  ///< a beside b, symmetric
};

/// A trained model that labels superpixels: two decision forests and a random field.
/// The first forest uses the features of a superpixel, the second one also the predictions of the
/// first one around it; the random field smooths the result.
struct SceneModel {
  /// The labels: geometric surfaces, or the classes of a street.
  enum class Kind : std::uint32_t { kSurfaces, kUrban };
  Kind kind = Kind::kSurfaces;                ///< the kind of labels
  std::vector<std::string> classes;           ///< names, 2 to 64
  std::vector<Surface> surfaces;              ///< surface of each class
  DecisionForest first, second;               ///< both over all classes
  RelationTable relations;                    ///< classes x classes
  float smoothness = 0, relation_weight = 0;  ///< weights of the random field's terms
  float sharpness = 1;  ///< exponent that turns the result's shares into probabilities
  std::string origin;   ///< training set, one line

  /// Number of classes.
  int class_count() const { return static_cast<int>(classes.size()); }
  /// A short description of an inconsistency; nothing if there is none.
  std::optional<std::string> problem() const;
};

}  // namespace placegraph
