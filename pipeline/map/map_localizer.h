#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/image/frame.h>
#include <placegraph/io/map/stored_map.h>
#include <placegraph/pipeline/map/map_options.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Where an image was taken, or why that is not said.
struct Localization {
  bool placed = false;
  std::optional<PlaceId> place;  ///< of the map, as the next two; the best guess if refused
  std::optional<KeyframeId> keyframe;
  std::optional<FrameId> frame;
  double probability = 0;
  /// The test that decided: "geometry" and "appearance" of placed ones; of others "blank" (there is
  /// nothing to compare), "calibration" (the map's views do not tell how wrong answers look),
  /// "appearance" (not sure enough), "geometry" (the features contradict).
  std::string stage;
  std::optional<SE3> T_map_cam;  ///< if geometry verified it
  std::string without_pose;      ///< why it is placed without a pose; empty if it is not
};

/// Places images in a saved map: by the likeness of whole views, with a probability that the map
/// itself calibrates (RecognitionOdds), and by features against points of known depth.
class MapLocalizer {
 public:
  /// Throws ArgumentError for a map of fewer than ten views, or whose views cannot be compared.
  MapLocalizer(const LocalizerOptions& options, StoredMap stored);
  ~MapLocalizer();
  MapLocalizer(MapLocalizer&&) noexcept;
  MapLocalizer& operator=(MapLocalizer&&) noexcept;

  /// Images one by one, or consecutive ones of one drive, each with the evidence of those around
  /// it. `frames`: grey image as by the map's camera (others are placed without a pose),
  /// and `colour` where the map's views have colour (ArgumentError). Called with each index once.
  using Frames = std::function<Frame(std::size_t)>;
  std::vector<Localization> localize(std::size_t count, const Frames& frames, bool sequence) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace placegraph
