#pragma once
#include <placegraph/frontend/lines/line_feature.h>
#include <placegraph/frontend/places/place_database.h>
#include <placegraph/frontend/places/place_recognizer.h>
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/loop.h>
#include <placegraph/graph/map.h>
#include <placegraph/pipeline/loops/keyframe_describer.h>
#include <placegraph/pipeline/loops/keyframe_motion.h>
#include <placegraph/pipeline/loops/located_frame.h>
#include <placegraph/pipeline/loops/loop_options.h>

#include <deque>

namespace placegraph {

/// Place recognition: stores described keyframes, detects revisits by appearance, verifies them by
/// geometry, and accepts a loop only when a second, independent one agrees with it.
class LoopCloser {
 public:
  /// Candidates are those of `recognizer`, which is cleared, or of visual words without one.
  LoopCloser(const LoopOptions& options, const Calibration& calibration, std::uint64_t seed,
             std::shared_ptr<PlaceRetrieval> recognizer = nullptr);
  /// Loads the keyframes of a map, so that `relocalize` locates frames in it, for example when the
  /// path is travelled back. A `recognizer`, which is cleared, gets the images of these keyframes:
  /// `frame_of` returns their frames (ArgumentError without it).
  LoopCloser(const LoopOptions& options, const Calibration& calibration, std::uint64_t seed,
             const Map& map, std::shared_ptr<PlaceRetrieval> recognizer = nullptr,
             const std::function<Frame(FrameId)>& frame_of = {});

  using View = DescribedKeyframe;

  /// Describes a keyframe. `T_previous_this`, if there is a predecessor in the same track segment,
  /// is used to compute the depth of features observed in both. `lines`: those that the odometry
  /// tracks in the frame; their descriptors are computed here. `errors` correct the features of an
  /// RGB-D camera.
  void add_view(KeyframeId keyframe, const Frame& frame, const std::optional<SE3>& T_previous_this,
                std::vector<LineFeature> lines = {}, const FrameErrors& errors = FrameErrors());
  /// Corrects the features of all views by the errors of the newest; returns whether any view has
  /// changed since it was added.
  bool correct_views();
  /// Returns the loops that the newest view completes.
  std::vector<Loop> find_loops(const KnownMotions& known, double median_depth_m);
  /// Measures the loop between two keyframes, without the other tests; nothing if their
  /// features agree with no relative pose. `record` receives frames and evidence, no stage.
  /// Throws ArgumentError for an unknown keyframe, or unless the match is the earlier one.
  std::optional<Loop> measure(KeyframeId query, KeyframeId match, bool free_scale,
                              LoopRecord& record) const;
  /// Pose of a frame relative to a known keyframe. The last views are tried first, because most
  /// losses are short.
  std::optional<LocatedFrame> relocalize(const Frame& frame, std::size_t last_views = 3) const;
  /// The same with the keyframes `tries` tried first.
  std::optional<LocatedFrame> relocalize(const Frame& frame, std::vector<KeyframeId> tries) const;

  /// The recognizer that was given; null: none.
  const std::shared_ptr<PlaceRetrieval>& recognizer() const { return recognizer_; }
  const std::vector<View>& views() const { return views_; }
  const std::vector<LoopRecord>& records() const { return records_; }
  /// Appearance of a view in the current vocabulary; it changes with every training.
  const Appearance& appearance(KeyframeId keyframe) const { return database_.appearance(keyframe); }
  std::size_t trained_views() const { return database_.trained_views(); }
  /// Multiplies depths of all features by `factor` when the scale of the map has become known.
  void rescale(double factor, KeyframeId first_keyframe);

 private:
  struct Candidate {
    View* match;
    /// Relative to the similarity of the keyframe before the newest view; a recognizer's score.
    double similarity;
  };
  struct Pending {  // loop that has passed all gates
    Loop loop;
    std::size_t record, view;
  };
  std::vector<PlaceCandidate> similar_views(const std::vector<Feature>& features,
                                            const Image& image, FrameId frame,
                                            const std::function<bool(KeyframeId)>& allowed) const;
  std::vector<Candidate> retrieve(const KnownMotions& known);
  double similarity_to_previous(std::size_t number) const;
  std::optional<Loop> verify(const View& query, const View& match, bool free_scale,
                             LoopRecord& record) const;
  std::optional<Loop> judge(const Candidate& candidate, const KnownMotions& known,
                            double median_depth_m, LoopRecord& record) const;
  std::vector<Loop> support(const MotionBetween& odometry, double median_depth_m);
  void accept(const Pending& pending, std::vector<Loop>& accepted);
  std::size_t number_of(KeyframeId keyframe) const;
  void correct(View& view);
  const View& view(KeyframeId keyframe) const { return views_[number_of(keyframe)]; }

  LoopOptions options_;
  KeyframeDescriber describer_;
  std::uint64_t seed_;
  PlaceDatabase database_;
  std::shared_ptr<PlaceRetrieval> recognizer_;  // instead of database_ for candidates; may be null
  Image newest_image_;                          // image of the newest view, for recognizer_
  std::vector<View> views_;                     // in ascending order of keyframes
  bool views_corrected_ = false;                // whether any has changed since it was added
  std::vector<LoopRecord> records_;
  std::deque<Pending> pending_;
};

}  // namespace placegraph
