#include "apps/run/run_messages.h"

#include <fmt/format.h>

#include <utility>

#include "apps/support/output.h"

namespace placegraph::apps {

RunMessages::RunMessages(Verbosity verbosity, Print print)
    : verbosity_(verbosity), print_(std::move(print)) {}

LogSink RunMessages::log() {
  return [this](LogLevel level, const std::string& message) {
    switch (level) {
      case LogLevel::kWarning:
        return print(Verbosity::kQuiet, "warning", message);
      case LogLevel::kInfo:
        return print(Verbosity::kVerbose, "info", message);
      case LogLevel::kDebug:
        return print(Verbosity::kDebug, "debug", message);
    }
  };
}

void RunMessages::run_began() { lost_ = 0; }

void RunMessages::lens_found(const LensFound& lens) {
  print(Verbosity::kNormal, "event",
        fmt::format("frame {}: lens distortion found (k1 = {:.4f} +- {:.4f}): the run begins again "
                    "with undistorted images, pass {}",
                    lens.frame.value(), lens.k1, lens.sigma_k1, lens.pass));
}

void RunMessages::frame_posed(const FrameResult& frame) {
  if (lost_ > 0)
    print(Verbosity::kNormal, "event",
          fmt::format("frame {}: tracking recovered after {} {} without a pose",
                      frame.frame.value(), lost_, lost_ == 1 ? "frame" : "frames"));
  lost_ = 0;
}

void RunMessages::frame_lost(const FrameResult& frame) {
  if (frame.state == TrackingState::kInitializing)
    return print(
        Verbosity::kVerbose, "event",
        fmt::format("frame {}: no pose yet: {}", frame.frame.value(), frame.outcome.reason));
  print(lost_ == 0 ? Verbosity::kNormal : Verbosity::kVerbose, "event",
        fmt::format("frame {}: tracking lost: {}", frame.frame.value(), frame.outcome.reason));
  ++lost_;
}

void RunMessages::loop_accepted(const LoopRecord& loop) {
  print(Verbosity::kNormal, "event",
        fmt::format("frame {}: loop closed with frame {}", loop.query_frame.value(),
                    loop.match_frame.value()));
}

void RunMessages::loop_refused(const LoopRecord& loop) {
  print(Verbosity::kDebug, "event",
        fmt::format("frame {}: loop with frame {} refused at stage {}", loop.query_frame.value(),
                    loop.match_frame.value(), to_string(loop.stage)));
}

void RunMessages::place_added(const PlaceAdded& place) {
  print(Verbosity::kVerbose, "event",
        fmt::format("place {} added to component {}", place.place.value(), place.component));
}

void RunMessages::places_merged(const PlacesMerged& places) {
  print(Verbosity::kVerbose, "event",
        fmt::format("place {} merged into place {}", places.gone.value(), places.kept.value()));
}

void RunMessages::component_joined(const ComponentJoined& component) {
  print(Verbosity::kNormal, "event",
        fmt::format("component {} joined to component {}", component.component, component.into));
}

void RunMessages::map_moved(const MapMoved& move) {
  if (move.scale != 1) print(Verbosity::kNormal, "event", "the metric scale is known");
  print(Verbosity::kDebug, "event",
        fmt::format("{} places moved by up to {:.3g}", move.places, move.translation));
}

void RunMessages::print(Verbosity least, const char* level, const std::string& text) const {
  if (verbosity_ < least) return;
  const std::string line = one_line(text);
  if (verbosity_ == Verbosity::kDebug) {
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin_;
    return print_(fmt::format("{:9.3f} s  {:<7}  {}", elapsed.count(), level, line));
  }
  print_(least == Verbosity::kQuiet ? "warning: " + line : line);
}

}  // namespace placegraph::apps
