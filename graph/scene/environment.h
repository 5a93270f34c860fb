#pragma once
#include <placegraph/graph/place_graph.h>

#include <cstdint>
#include <optional>
#include <string>

namespace [[gnu::visibility("default")]] placegraph {

/// The kind of surroundings a place is in.
enum class Environment : std::uint8_t {
  kStreet,    ///< outdoors, between buildings
  kRoad,      ///< outdoors, nearly without buildings
  kCorridor,  ///< indoors, walls close to both sides
  kRoom,      ///< indoors, a few metres to the walls
  kHall       ///< indoors, high and wide
};
constexpr int kEnvironmentCount = 5;
/// "street", "road", "corridor", "room", "hall".
const std::string& environment_name(Environment kind);
std::optional<Environment> environment_of_name(const std::string& name);

/// What may be taken for granted in an environment.
struct Assumptions {
  /// The camera stands at its known height above a ground that fills the view before it.
  bool ground_height = true;
  /// Edges keep to the axes of a rectangular world.
  bool manhattan_world = true;
  /// What was learned from streets says what surfaces are: sky, ground, things that may move.
  bool street_surfaces = true;
};
Assumptions assumptions_of(Environment kind);

/// A place's label says its kind as "environment:street"; other labels stay.
void label_environment(Place& place, Environment kind);
std::optional<Environment> environment_of(const Place& place);

}  // namespace placegraph
