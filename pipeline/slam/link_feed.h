#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/loop.h>
#include <placegraph/graph/measurements/data_note.h>
#include <placegraph/pipeline/local_map/local_map.h>
#include <placegraph/pipeline/places/loop_feed.h>
#include <placegraph/pipeline/places/place_mapper.h>

#include <map>
#include <optional>
#include <vector>

namespace placegraph {

/// Errors along the links from a keyframe to a later one, in the right tangent of the later one.
struct ChainErrors {
  KeyframeId first, last;
  Matrix6d independent = Matrix6d::Zero();
  SharedErrors by_shared = SharedErrors::Zero();  ///< by errors that all links share
  void visit_state(auto& archive) { archive(first, last, independent, by_shared); }
};

/// Passes motions between keyframes, loops, and their uncertainties from the local map to the place
/// graph. What the run learns about its errors later holds for earlier motions, too: finish()
/// passes their uncertainties again.
class LinkFeed {
 public:
  /// Updates the links of the last `keyframes` keyframes up to `newest`, which the window still
  /// refines. The uncertainty of the motion between consecutive anchors comes from the window as a
  /// whole while it contains both.
  void refresh(const LocalMap& map, KeyframeId newest, int keyframes, PlaceMapper& mapper);
  /// Multiplies all lengths from keyframe `first` on by `factor`.
  void rescale(KeyframeId first, double factor);
  /// Adds loops that were found at once. Their covariances are as much larger than the noise of
  /// their features as those of the motions are, translation and rotation by the median factor of
  /// the newest links, and by what the innovations of earlier loops have shown.
  void add_loops(const std::vector<Loop>& loops, const LocalMap& map, PlaceMapper& mapper);
  /// Errors of the motion from the anchor of the first place to that of the last one of its
  /// component, along the links; nothing where a link between them is none of the run's odometry.
  std::optional<OdometryError> odometry_error(const LocalMap& map, const PlaceMapper& mapper) const;
  /// Notes the errors from keyframe `first`, an anchor, to the newest one, for a run that goes on
  /// there.
  void note_errors(KeyframeId first, const LocalMap& map, const PlaceMapper& mapper);
  /// Passes all uncertainties again.
  void finish(const LocalMap& map, PlaceMapper& mapper);
  /// What loops have shown, and the errors that were noted; when read, the latter are those of the
  /// run that was interrupted.
  void visit_state(auto& archive) { archive(loops_, archive.kReads ? earlier_ : noted_); }

 private:
  Loop with_errors(const Loop& loop, const LocalMap& map) const;
  ChainErrors errors_from(KeyframeId first) const;
  bool extend(ChainErrors& errors, KeyframeId last, const LocalMap& map,
              const PlaceMapper& mapper) const;

  std::map<KeyframeId, LocalMap::Link> links_;       // by the keyframe at the end
  std::map<KeyframeId, AssessedMotion> to_anchors_;  // from the previous anchor
  LoopFeed loops_;
  KeyframeId oldest_refreshed_;         // links before this keyframe change no more
  std::optional<ChainErrors> settled_;  // along these links
  std::optional<ChainErrors> noted_, earlier_;
};

}  // namespace placegraph
