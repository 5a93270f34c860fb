#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/io/map/stored_map.h>
#include <placegraph/pipeline/slam_options.h>

#include <memory>
#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

class LoopCloser;
class PlaceMapper;

/// How far an optimization moved the map.
struct MapMotion {
  std::size_t places_before = 0, places_after = 0;  ///< number of places
  std::size_t components_before = 0, components_after = 0;
  /// Largest motion of a keyframe: its length in the map's scale, and its angle [rad].
  double translation = 0, rotation_rad = 0;
};

/// Edits the loops of a saved map by hand, and optimizes the map with them.
///
/// Frames are named by their ids. An edit changes the constraints at once; the poses follow with
/// optimize(). A function that throws ArgumentError, with the reason as a sentence, has changed
/// nothing.
class LoopEditor {
 public:
  /// `options`: those of the run that made the map. Throws ArgumentError for a map that no run can
  /// continue: one that was imported or whose run was interrupted.
  LoopEditor(StoredMap stored, const SlamOptions& options);
  ~LoopEditor();

  /// Removes an accepted loop; its record keeps LoopStage::kManual.
  ///
  /// Returns, as the other edits, what was done, as a sentence.
  std::string refuse(FrameId query, FrameId match);
  /// Accepts a candidate that a test has refused, if the features of both keyframes agree.
  std::string accept(FrameId query, FrameId match);
  /// Adds a loop between the keyframes of any two frames, if their features agree.
  std::string add(FrameId query, FrameId match);
  /// Optimizes the place graph to convergence. After a loop was removed, mergers of places and
  /// joined components are determined again.
  MapMotion optimize();
  /// Takes back the last edit or optimization; false if there is none.
  bool undo();

  /// The map with all edits, without a judgement, which was that of the run.
  const StoredMap& stored() const { return stored_; }
  /// Sentences of the edits in force, in order.
  const std::vector<std::string>& edits() const { return state_.edits; }
  /// Number of the present state of the map: two states differ if their numbers do. 0: the map as
  /// it was given.
  int revision() const { return state_.revision; }
  /// Whether the poses follow from the present loops.
  bool optimized() const { return state_.optimized; }

 private:
  struct State {  // what edits change
    std::vector<LoopRecord> loops = {};
    PlaceHistory history = {};
    PlaceGraph place_graph = {};
    bool metric = false, optimized = true, loop_removed = false;  // metric: as Map::metric
    std::vector<std::string> edits = {};
    int revision = 0;
  };
  PlaceMapper mapper_of(const State& state) const;
  const Keyframe& keyframe_of(FrameId frame) const;
  const LoopCloser& closer();
  std::string take(FrameId query, FrameId match, const char* done);
  void change(State next);
  void show(State next);
  void describe_places(PlaceGraph& graph);

  StoredMap stored_;
  SlamOptions options_;
  State state_;
  bool scale_doubted_ = false;  // a judgement withdrew the metres of the scale that was measured
  std::vector<State> earlier_;
  int revisions_ = 0;                   // the greatest number of a state so far
  std::unique_ptr<LoopCloser> closer_;  // made when it is first needed
};

}  // namespace placegraph
