#include "apps/run/run_messages.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace placegraph::apps {
namespace run_messages_test {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::MatchesRegex;

FrameResult lost(int frame, TrackingState state = TrackingState::kLost) {
  FrameResult result;
  result.state = state;
  result.frame = FrameId(frame);
  result.outcome = Outcome::failure(Outcome::Code::kTooFewData, "8 points, 12 needed");
  return result;
}

FrameResult posed(int frame) {
  FrameResult result;
  result.frame = FrameId(frame);
  return result;
}

LoopRecord loop() {
  LoopRecord record;
  record.query_frame = FrameId(90);
  record.match_frame = FrameId(3);
  return record;
}

class Messages : public testing::Test {
 protected:
  std::vector<std::string> lines;
  RunMessages::Print print = [this](const std::string& line) { lines.push_back(line); };
};

TEST_F(Messages, NameALossOnceAndTheRecovery) {
  RunMessages messages(Verbosity::kNormal, print);
  messages.run_began();
  messages.frame_lost(lost(0, TrackingState::kInitializing));  // the map has not begun
  messages.frame_posed(posed(1));
  messages.frame_lost(lost(2));
  messages.frame_lost(lost(3));
  messages.frame_posed(posed(4));
  messages.frame_posed(posed(5));
  EXPECT_THAT(lines, ElementsAre("frame 2: tracking lost: 8 points, 12 needed",
                                 "frame 4: tracking recovered after 2 frames without a pose"));
}

TEST_F(Messages, NameLoopsScaleComponentsAndARestart) {
  RunMessages messages(Verbosity::kNormal, print);
  messages.run_began();
  messages.loop_accepted(loop());
  messages.loop_refused(loop());
  MapMoved scaled;
  scaled.scale = 1.6;
  messages.map_moved(scaled);
  messages.map_moved(MapMoved());
  messages.component_joined({1, 0});
  messages.lens_found({FrameId(69), -0.0364, 0.0021, 2});
  messages.run_began();
  EXPECT_THAT(lines, ElementsAre("frame 90: loop closed with frame 3", "the metric scale is known",
                                 "component 1 joined to component 0",
                                 "frame 69: lens distortion found (k1 = -0.0364 +- 0.0021): the "
                                 "run begins again with undistorted images, pass 2"));
}

TEST_F(Messages, AreWarningsAloneIfQuiet) {
  RunMessages messages(Verbosity::kQuiet, print);
  messages.loop_accepted(loop());
  messages.log()(LogLevel::kInfo, "something");
  messages.log()(LogLevel::kWarning, "place graph not optimized");
  EXPECT_THAT(lines, ElementsAre("warning: place graph not optimized"));
}

TEST_F(Messages, HoldTheLogAccordingToItsLevel) {
  RunMessages normal(Verbosity::kNormal, print);
  normal.log()(LogLevel::kInfo, "something");
  EXPECT_THAT(lines, IsEmpty());
  RunMessages verbose(Verbosity::kVerbose, print);
  verbose.log()(LogLevel::kInfo, "something");
  verbose.log()(LogLevel::kDebug, "a detail");
  verbose.frame_lost(lost(0, TrackingState::kInitializing));
  EXPECT_THAT(lines, ElementsAre("something", "frame 0: no pose yet: 8 points, 12 needed"));
}

TEST_F(Messages, HaveTimeAndLevelForDebugging) {
  RunMessages messages(Verbosity::kDebug, print);
  messages.log()(LogLevel::kDebug, "a detail");
  messages.loop_refused(loop());
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_THAT(lines[0], MatchesRegex(" +[0-9.]+ s  debug    a detail"));
  EXPECT_THAT(lines[1], HasSubstr("event    frame 90: loop with frame 3 refused at stage "));
}

}  // namespace run_messages_test
}  // namespace placegraph::apps
