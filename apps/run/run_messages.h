#pragma once
#include <placegraph/graph/core/log.h>
#include <placegraph/pipeline/slam/slam_events.h>

#include <chrono>
#include <functional>
#include <string>

namespace placegraph::apps {

/// How much a run prints beside its result.
enum class Verbosity {
  kQuiet,    ///< warnings
  kNormal,   ///< also progress, and the events that a user acts on: lost, recovered, loop closed
  kVerbose,  ///< also the other events and the messages of level kInfo
  kDebug     ///< also the messages of level kDebug; every line has its time and level
};

/// The lines that a run prints about its events and from its log.
class RunMessages : public SlamEvents {
 public:
  using Print = std::function<void(const std::string& line)>;  ///< receives a line without its end

  RunMessages(Verbosity verbosity, Print print);

  /// Takes the messages of a log. The sink must not outlive this object.
  LogSink log();

  void run_began() override;
  void lens_found(const LensFound& lens) override;
  void frame_posed(const FrameResult& frame) override;
  void frame_lost(const FrameResult& frame) override;
  void loop_accepted(const LoopRecord& loop) override;
  void loop_refused(const LoopRecord& loop) override;
  void place_added(const PlaceAdded& place) override;
  void places_merged(const PlacesMerged& places) override;
  void component_joined(const ComponentJoined& component) override;
  void map_moved(const MapMoved& move) override;

 private:
  void print(Verbosity least, const char* level, const std::string& line) const;

  Verbosity verbosity_;
  Print print_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  int lost_ = 0;  ///< consecutive frames without a pose since the last posed one
};

}  // namespace placegraph::apps
