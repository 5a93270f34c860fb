#pragma once
#include <placegraph/frontend/features/detector.h>
#include <placegraph/frontend/places/place_database.h>
#include <placegraph/frontend/places/verification/loop_verifier.h>
#include <placegraph/graph/loop.h>
#include <placegraph/graph/map.h>
#include <placegraph/graph/measurements/frame.h>
#include <placegraph/pipeline/places/keyframe_motion.h>

#include <deque>
#include <map>

namespace placegraph {

struct LoopOptions {
  bool enabled = true;
  DetectorOptions detector;
  PlaceDatabaseOptions database;
  LoopVerifierOptions verifier;
  int min_frame_gap = 40;  ///< nearer views are neighbours, not revisits
  int candidates = 5;      ///< retrieved views that are verified
  double min_similarity =
      0.3;                 ///< of a candidate, as a share of the similarity to the last keyframe
  int support_window = 4;  ///< keyframes within which a second loop must agree
  double support_translation = 0.03;  ///< disagreement of two loops / (median depth + way between)
  double support_angle_deg = 2;
  double drift_translation = 0.015;  ///< of the odometry / (median depth + way since the match)
  double drift_angle_deg = 1;        ///< of the odometry, per median depth of way
  double drift_scale = 0.03;       ///< of the unit of one eye (logarithm), per median depth of way
  double information_scale = 0.1;  ///< feature noise is correlated: information counts this much
  void check() const;
};
void visit(OptionVisitor& field, LoopOptions& options);

/// Spatial memory: describes keyframes, finds revisits by appearance, verifies them by geometry,
/// and lets one into the graph only when a second, independent one agrees with it.
class LoopCloser {
 public:
  LoopCloser(const LoopOptions& options, const Calibration& calibration, std::uint64_t seed);
  /// One that knows the keyframes of a map: `relocalize` tells where frames stand in it, as on the
  /// way back.
  LoopCloser(const LoopOptions& options, const Calibration& calibration, std::uint64_t seed,
             const Map& map);

  /// A keyframe as the closer knows it.
  struct View {
    std::int64_t keyframe, frame;
    std::vector<Feature> features;
    std::vector<LineFeature> lines;  ///< not those of a map that was read
    LoopView for_verification() const { return {features, lines}; }
  };

  /// Describes a keyframe. `T_previous_this`, if there is a predecessor in the same run of
  /// tracking, gives depth to the features both see. `lines`: edges that motion memory follows
  /// there; their descriptors are made here.
  void add_view(std::int64_t keyframe, const Frame& frame,
                const std::optional<SE3>& T_previous_this, std::vector<LineFeature> lines = {});
  /// Revisits that the newest view completes.
  std::vector<Loop> find_loops(const KnownMotions& known, double median_depth_m);
  /// Where a frame stands relative to a known keyframe: T_match_query of the frame; `query` is -1,
  /// as the frame is no keyframe. The last views are tried first: most losses are short.
  std::optional<Loop> relocalize(const Frame& frame, std::size_t last_views = 3) const;
  /// The same with these keyframes tried first.
  std::optional<Loop> relocalize(const Frame& frame, std::vector<std::int64_t> tries) const;

  const std::vector<View>& views() const { return views_; }
  const std::vector<LoopRecord>& records() const { return records_; }
  /// Of a view, by the vocabulary as it stands; it is another one after every training.
  const Appearance& appearance(std::int64_t keyframe) const {
    return database_.appearance(keyframe);
  }
  std::size_t trained_views() const { return database_.trained_views(); }
  /// The scale of the map became known: depths of all features grow with it.
  void rescale(double factor, std::int64_t first_keyframe);

 private:
  struct Pending {
    Loop loop;
    std::size_t record, view;
    bool accepted;
  };
  LoopRecord judge(const PlaceCandidate& candidate, double likeness, const KnownMotions& known,
                   double median_depth_m);
  void verify(LoopRecord& record, std::int64_t candidate, const KnownMotions& known,
              double median_depth_m);
  bool within_covariance(const Loop& loop, const KnownMotions& known, double median_depth_m) const;
  struct Drift {
    double length, angle_rad, log_scale;
  };
  Drift drift_over(double way, double distance, double median_depth_m) const;
  bool within_reach(const View& query, const View& match, const MotionBetween& odometry,
                    double median_depth_m) const;
  bool within_drift(const Loop& loop, const MotionBetween& odometry, double median_depth_m,
                    bool free_scale) const;
  bool agree(const Loop& a, const Loop& b, const MotionBetween& odometry,
             double median_depth_m) const;
  void accept(Pending& pending, std::vector<Loop>& accepted);
  void lift_features(const Frame& frame, std::vector<Feature>& features) const;
  const View* find_view(std::int64_t keyframe) const;

  LoopOptions options_;
  Calibration calibration_;
  std::uint64_t seed_;
  PlaceDatabase database_;
  std::vector<View> views_;
  std::vector<LoopRecord> records_;
  std::deque<Pending> pending_;
};

}  // namespace placegraph
