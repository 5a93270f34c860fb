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

/// Place of an image in a map, or the reason why the place is unknown.
struct Localization {
  bool placed = false;  ///< whether `probability` reaches LocalizerOptions::min_probability
  /// Place in the map; the most probable one if `placed` is false, nothing if there is none.
  std::optional<PlaceId> place;
  std::optional<KeyframeId> keyframe;  ///< keyframe to which the image was matched
  std::optional<FrameId> frame;        ///< frame of that keyframe
  double probability = 0;              ///< probability that the place is correct
  /// Test that decided. For placed images: "geometry" or "appearance". For others: "unreadable"
  /// (there is no image), "grey" (the map's keyframes are in colour), "blank" (the image has no
  /// content to compare), "calibration" (the keyframes of the map provide no examples
  /// of wrong matches), "appearance" (the probability is too low), "geometry" (the features
  /// contradict the match).
  std::string stage;
  std::optional<SE3> T_map_cam;  ///< pose, if the image is placed and verified by geometry
  std::string without_pose;      ///< reason why a placed image has no pose; empty otherwise
};

/// Localizes images in a saved map, with a calibrated probability.
///
/// The appearance of whole images is compared with that of the keyframes; the keyframes of the map
/// are used to calibrate the probability of a match. Where the map contains points of known depth,
/// features verify the match and determine the pose.
class MapLocalizer {
 public:
  /// Takes ownership of the map and prepares its keyframes for comparison.
  ///
  /// Throws ArgumentError for options that check() rejects, for a map with fewer than ten keyframes
  /// whose appearance is stored, or if the map was described with other cues than those of the
  /// options.
  MapLocalizer(const LocalizerOptions& options, StoredMap stored);
  ~MapLocalizer();
  MapLocalizer(MapLocalizer&&) noexcept;
  MapLocalizer& operator=(MapLocalizer&&) noexcept;

  /// Callback that returns the frame of an index; called once for each, in ascending order.
  ///
  /// `image` is grey and taken by the camera of the map (images of another size are placed without
  /// a pose), or empty if the image cannot be read. `colour` is needed if the map's keyframes were
  /// stored in colour. Images that cannot be compared are refused and give their neighbours in a
  /// sequence no evidence.
  using Frames = std::function<Frame(std::size_t)>;
  /// Localizes `count` images; returns one result for each, in order.
  ///
  /// `sequence`: the images are consecutive images of one drive, and each is classified with the
  /// evidence of its neighbours; otherwise each image is classified independently.
  std::vector<Localization> localize(std::size_t count, const Frames& frames, bool sequence) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace placegraph
