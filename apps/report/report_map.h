#pragma once
#include <placegraph/graph/map.h>

#include <nlohmann/json_fwd.hpp>

namespace placegraph {
struct Calibration;
}

namespace placegraph::apps {

/// Keyframes with their thumbnails and the image points of the landmarks that most of them see.
/// `calibration`: of their images; null: unknown, and then without image points.
nlohmann::json describe_keyframes(const Map& map, const Calibration* calibration);

/// Positions, colours and standard deviations (MapGeometry) of the landmarks of all components,
/// each in the frame of its component.
nlohmann::json describe_landmarks(const Map& map);

nlohmann::json describe_places(const PlaceGraph& graph);
nlohmann::json describe_constraints(const PlaceGraph& graph);
nlohmann::json describe_loops(const std::vector<LoopRecord>& loops);
nlohmann::json describe_components_for_report(const Map& map);

}  // namespace placegraph::apps
