#pragma once
#include <placegraph/frontend/places/place_recognizer.h>
#include <placegraph/frontend/places/recognition_odds.h>
#include <placegraph/graph/core/ids.h>
#include <placegraph/io/map/map_database.h>
#include <placegraph/pipeline/loops/loop_closer.h>

#include <set>

namespace placegraph {

struct LocalizerOptions {
  PlaceRecognizerOptions recognizer;  ///< its cues are those of the map
  /// Images behind and ahead count, and none hurries: evidence is gathered over a longer way than
  /// where only the past is known.
  SequenceFilterOptions sequence{.memory = 0.97};
  double min_probability = 0.95;  ///< of an answer
  int calibration_views = 300;    ///< of the map, that tell how wrong answers look, at most
  bool geometry = true;           ///< verify by features where the map has their depth
  LoopOptions loops;              ///< as the run that made the map
  void check() const;
};
void visit(OptionVisitor& field, LocalizerOptions& options);

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

  /// Images one by one, or consecutive ones of one drive, each with the evidence of those around
  /// it. `frames`: grey image as by the map's camera (others are placed without a pose),
  /// and `colour` where the map's views have colour (ArgumentError). Called with each index once.
  using Frames = std::function<Frame(std::size_t)>;
  std::vector<Localization> localize(std::size_t count, const Frames& frames, bool sequence) const;

 private:
  std::string why_no_features(const Image& grey) const;
  std::vector<PlaceLikeness> likenesses(const PlaceView& view) const;
  void learn_near();
  int lag_of_likeness() const;
  bool near(int a, int b) const;
  std::optional<RecognitionOdds> odds(bool sequence) const;
  std::vector<ViewEvidence> evidence(const std::vector<std::vector<PlaceLikeness>>& lists,
                                     bool sequence) const;
  Localization described(const ViewAnswer& answer, double probability) const;
  std::optional<LocatedFrame> verify(const Frame& frame,
                                     const std::vector<PlaceLikeness>& list) const;
  void take_geometry(const LocatedFrame& located, Localization& result) const;
  const Keyframe& keyframe_of(int view) const;

  LocalizerOptions options_;
  StoredMap stored_;
  bool in_colour_ = false;
  PlaceRecognizer recognizer_;
  std::vector<int> keyframes_;                      ///< of the views, indices in the map's
  int lag_ = 1;                                     ///< views so far apart look like any others
  std::set<std::pair<PlaceId, PlaceId>> adjacent_;  ///< places
  std::optional<LoopCloser> closer_;
};

}  // namespace placegraph
