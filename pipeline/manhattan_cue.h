#pragma once
#include <placegraph/frontend/lines/scene_directions.h>
#include <placegraph/frontend/lines/segment_detector.h>
#include <placegraph/graph/core/image.h>
#include <placegraph/graph/core/log.h>
#include <placegraph/pipeline/frame_view.h>
#include <placegraph/pipeline/manhattan_worlds.h>

namespace placegraph {

struct ManhattanCueOptions {
  SegmentDetectorOptions segments{.min_length_px = 20, .merging = {}, .refinement = {}};
  SceneDirectionOptions directions;
  ManhattanWorldOptions worlds;
  int max_width_px = 800;    ///< wider images are halved before segments are looked for
  double max_sigma_deg = 1;  ///< about any axis: directions known less well are not believed
  void check() const;
};
void visit(OptionVisitor& field, ManhattanCueOptions& options);

/// The share of rectangular worlds in motion memory: the straight edges of a keyframe give the
/// directions of its scene, which are sightings of the window's worlds (ManhattanWorlds). Known
/// worlds are followed from where the window expects them; only where none is seen, all directions
/// are looked for. Believed is what shows two axes at least, is known well enough in all three
/// turns, and agrees with its world.
class ManhattanCue {
 public:
  ManhattanCue(const ManhattanCueOptions& options, const Camera& camera, std::uint64_t seed,
               LogSink log);

  /// `segments`: edges of the image, if they are known already.
  void observe(std::int64_t keyframe, const Image& image,
               const std::optional<std::vector<LineSegment>>& segments, SlidingWindow& window);
  void settle(const SlidingWindow& window) { worlds_.settle(window); }
  /// The edges of the last keyframe's image that were looked at, with their world and axis.
  const std::vector<FrameView::DirectedLine>& view() const { return view_; }
  void reset();

 private:
  std::vector<LineSegment> detect(const Image& image) const;
  bool trusted(const ManhattanFrame& frame) const;
  bool take(std::int64_t keyframe, const ManhattanFrame& frame, SlidingWindow& window);

  ManhattanCueOptions options_;
  Camera camera_;
  std::uint64_t seed_;
  LogSink log_;
  ManhattanWorlds worlds_;
  std::vector<FrameView::DirectedLine> view_;
};

}  // namespace placegraph
