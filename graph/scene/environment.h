#pragma once
#include <placegraph/graph/place_graph.h>

#include <cstdint>
#include <optional>
#include <string>

namespace [[gnu::visibility("default")]] placegraph {

/// The kind of surroundings of a place.
enum class Environment : std::uint8_t {
  kStreet,    ///< outdoors, between buildings
  kRoad,      ///< outdoors, nearly without buildings
  kCorridor,  ///< indoors, walls close to both sides
  kRoom,      ///< indoors, a few metres to the walls
  kHall       ///< indoors, high and wide
};
/// Number of kinds.
constexpr int kEnvironmentCount = 5;
/// The name of a kind: "street", "road", "corridor", "room" or "hall".
const std::string& environment_name(Environment kind);
/// The kind with the given name; nothing for any other text.
std::optional<Environment> environment_of_name(const std::string& name);

/// The assumptions that an estimator may make in an environment.
struct Assumptions {
  /// The camera is at its known height above a ground plane that fills the image ahead of it.
  bool ground_height = true;
  /// Edges are parallel to the axes of a Manhattan frame.
  bool manhattan_frame = true;
  /// A labelling trained on streets recognizes the surfaces: sky, ground, objects that may move.
  bool street_surfaces = true;
};
/// The assumptions that hold in an environment; outdoors, for example, no Manhattan frame.
Assumptions assumptions_of(Environment kind);

/// Labels a place with its environment, as in "environment:street".
/// An earlier label of this form is replaced; other labels stay.
void label_environment(Place& place, Environment kind);
/// The environment in the label of a place; nothing without such a label.
std::optional<Environment> environment_of(const Place& place);

}  // namespace placegraph
