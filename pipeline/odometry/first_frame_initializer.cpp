#include <placegraph/graph/text/log_message.h>
#include <placegraph/pipeline/odometry/first_frame_initializer.h>

namespace placegraph {

Initialization FirstFrameInitializer::add(const Frame& frame, const std::optional<SE3>& /*known*/,
                                          LocalMap& map, LocalMapping& mapping) {
  const double median_depth = map.median_depth();
  tracker_.see_first(frame);
  const auto added = mapping.add(frame, T_odom_start_, tracker_, map);
  const Outcome outcome =
      added ? tracker_.enough_to_begin(map)
            : Outcome::failure(Outcome::Code::kTooFewData, "no surface to begin with");
  if (!outcome) {
    log(log_, LogLevel::kDebug, "frame {}: {}", frame.id, outcome.reason);
    // Neither the keyframe nor its few landmarks belong to the map.
    map.discard(median_depth);
    tracker_.reset();
    return Initialization::pending(outcome);
  }
  Initialization begun;
  begun.state = TrackingState::kTracking;
  begun.keyframes = {added->keyframe};
  return begun;
}

}  // namespace placegraph
