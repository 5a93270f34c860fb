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

/// Where an image was taken, or why that is not known.
struct Localization {
  bool placed = false;  ///< whether `probability` reaches LocalizerOptions::min_probability
  /// The place of the map; the best guess if not placed, nothing if there is none.
  std::optional<PlaceId> place;
  std::optional<KeyframeId> keyframe;  ///< the keyframe that the image was matched to
  std::optional<FrameId> frame;        ///< the frame of that keyframe
  double probability = 0;              ///< that the place is right
  /// The test that decided. Of placed images "geometry" or "appearance"; of others "blank" (there
  /// is nothing to compare), "calibration" (the map's keyframes do not show what wrong answers look
  /// like), "appearance" (not sure enough), "geometry" (the features contradict).
  std::string stage;
  std::optional<SE3> T_map_cam;  ///< if placed and verified by geometry
  std::string without_pose;      ///< why a placed image has no pose; empty otherwise
};

/// Localizes images in a saved map, with a calibrated probability.
///
/// Whole images are compared with the keyframes by appearance; the map's own keyframes calibrate
/// the probability of an answer. Where the map has points of known depth, features verify it and
/// give a pose.
class MapLocalizer {
 public:
  /// Takes the map over and prepares its keyframes for comparison.
  ///
  /// Throws ArgumentError for options that check() refuses, for fewer than ten keyframes with an
  /// appearance, or if it was described by other cues than those of the options.
  MapLocalizer(const LocalizerOptions& options, StoredMap stored);
  ~MapLocalizer();
  MapLocalizer(MapLocalizer&&) noexcept;
  MapLocalizer& operator=(MapLocalizer&&) noexcept;

  /// Reads the frame of an index; called once for each, in ascending order.
  ///
  /// `image` is grey, as taken by the map's camera (images of another size are placed without a
  /// pose); `colour` is needed where the map's keyframes were kept in colour.
  using Frames = std::function<Frame(std::size_t)>;
  /// Localizes `count` images; one result for each, in their order.
  ///
  /// `sequence`: the images are consecutive ones of one drive, and each is judged with the evidence
  /// of those around it; otherwise each is judged by itself. Throws ArgumentError if colour is
  /// missing.
  std::vector<Localization> localize(std::size_t count, const Frames& frames, bool sequence) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace placegraph
