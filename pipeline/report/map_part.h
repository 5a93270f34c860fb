#pragma once
#include <placegraph/graph/map.h>

#include <algorithm>
#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <optional>

namespace placegraph {
struct Calibration;
}

namespace placegraph::report {

/// Which landmarks of a map a report has: all of them, or every n-th of very many, with the least n
/// that leaves few enough.
class LandmarkRows {
 public:
  /// Landmarks beyond this number are left out evenly: no screen shows more.
  static constexpr std::size_t kMost = 200'000;

  explicit LandmarkRows(std::size_t landmarks)
      : step_(std::max<std::size_t>((landmarks + kMost - 1) / kMost, 1)) {}

  /// Distance of the positions in the map of landmarks in two rows that follow each other.
  std::size_t step() const { return step_; }
  /// Row of the landmark at a position in the map; nothing if it is left out.
  std::optional<std::size_t> row_of(std::size_t position) const {
    if (position % step_ != 0) return std::nullopt;
    return position / step_;
  }

 private:
  std::size_t step_;
};

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

}  // namespace placegraph::report
