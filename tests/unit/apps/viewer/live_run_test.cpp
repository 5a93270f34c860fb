#include "apps/viewer/live_run.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "apps/page/column.h"
#include "apps/viewer/jpeg_url.h"
#include "tests/support/sleeping_thread.h"
#include "tests/unit/io/datasets/tiny_images.h"

namespace placegraph::apps {
namespace live_run_test {

using nlohmann::json;
using ::testing::ElementsAre;

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

/// Events as a browser gets them: names and data.
std::vector<std::pair<std::string, json>> events_in(const std::string& text) {
  std::vector<std::pair<std::string, json>> events;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("event: ")) events.emplace_back(line.substr(7), json());
    if (line.starts_with("data: ")) events.back().second = json::parse(line.substr(6));
  }
  return events;
}

class LiveRunTest : public ::testing::Test {
 protected:
  LiveRunTest() { (void)reader->next(); }
  /// The events since the last call; there must be one.
  std::vector<std::pair<std::string, json>> events() { return events_in(*reader->next()); }

  /// A frame at x = 10 + `number` m, with two landmarks of its own, which becomes a keyframe.
  void see(int number, bool lost = false) {
    Frame frame;
    frame.id = FrameId(number);
    frame.stamp_ns = 500'000'000LL * number;
    frame.image = test::tiny_grey(16, 12, number);
    FrameResult result;
    result.frame = frame.id;
    FrameView view;
    if (lost) {
      result.state = TrackingState::kLost;
      result.outcome = Outcome::failure(Outcome::Code::kTooFewData, "too dark");
    } else {
      result.state = TrackingState::kTracking;
      result.T_map_cam = SE3(SO3(), Eigen::Vector3d(10 + number, 0, 0));
      result.inliers = 30 + number;
      result.confidence = 0.5;
      result.keyframe = true;
      for (int i = 0; i < 2; ++i) {
        FrameView::Track& track = view.tracks.emplace_back();
        track.id = LandmarkId(2 * number + i);
        track.px = Eigen::Vector2d(3, 4 + i);
        track.point_cam = Eigen::Vector3d(0, 0, 5 + i);
        if (i == 0) track.px_projected = Eigen::Vector2d(3 + 0.3, 4 - 0.4);
      }
      FrameView::Line& line = view.lines.emplace_back();
      line.segment = {{1, 2}, {3, 4}};
      if (number > 0) line.off_px = 0.5;
    }
    live.frame_seen(frame, result, view);
  }
  /// Begins a run of two frames whose first is a place.
  void begin() {
    live.run_began();
    live.begin("somewhere", 2);
    live.keyframe_added({KeyframeId(0), FrameId(0), PlaceId(0), SE3()});
    live.place_added({PlaceId(0), KeyframeId(0), SE3(), 0});
  }

  const std::shared_ptr<EventLog> log = std::make_shared<EventLog>();
  const std::shared_ptr<HttpStream> reader = log->reader();
  LiveRun live{log};
};

TEST_F(LiveRunTest, AFrameIsAnEventWithItsPoseAndItsNewLandmarks) {
  begin();
  see(0);
  see(1, true);
  const auto seen = events();
  std::vector<json> frames;
  for (const auto& [name, data] : seen)
    if (name == "frame") frames.push_back(data);
  ASSERT_EQ(frames.size(), 2U);
  EXPECT_EQ(frames[0]["pose"], json({10, 0, 0, 0, 0, 0, 1}));  // x y z qx qy qz qw
  EXPECT_EQ(frames[0]["landmarks"], column(std::vector<float>{10, 0, 5, 10, 0, 6}, 3));
  EXPECT_EQ(frames[0]["state"], "tracking");
  EXPECT_EQ(frames[0]["index"], 0);
  EXPECT_EQ(frames[0]["total"], 2);
  EXPECT_EQ(frames[0]["inliers"], 30);
  EXPECT_EQ(frames[0]["confidence"], 0.5);
  EXPECT_EQ(frames[1]["frame"], 1);
  EXPECT_EQ(frames[1]["index"], 1);
  EXPECT_EQ(frames[1]["stamp_s"], 0.5);
  EXPECT_EQ(frames[1]["state"], "lost");
  EXPECT_EQ(frames[1]["reason"], "too dark");
  EXPECT_TRUE(frames[1]["pose"].is_null() && frames[1]["confidence"].is_null());
  EXPECT_FALSE(frames[1].contains("landmarks"));
}

TEST_F(LiveRunTest, ItsStateHasAllFramesByThePresentPoses) {
  begin();
  see(0);
  see(1, true);
  const int version = live.state()["version"];
  MapMoved moved;
  moved.poses = {{PlaceId(0), Sim3(SE3(SO3(), Eigen::Vector3d(0, 2, 0)))}};
  live.map_moved(moved);
  const json state = live.state();
  EXPECT_EQ(state["version"], version + 1);
  EXPECT_EQ(state["total"], 2);
  EXPECT_EQ(state["done"], 2);
  EXPECT_EQ(state["frame_ids"], column(std::vector<std::int32_t>{0, 1}));
  EXPECT_EQ(state["component"], column(std::vector<std::int32_t>{0, -1}));
  std::vector<float> poses = {10, 2, 0, 0, 0, 0, 1};
  poses.insert(poses.end(), 7, kUnknown);
  EXPECT_EQ(state["pose"], column(poses, 7));
  EXPECT_EQ(state["landmarks"], column(std::vector<float>{10, 2, 5, 10, 2, 6}, 3));
  live.component_joined({0, 3});
  EXPECT_EQ(live.state()["component"], column(std::vector<std::int32_t>{3, -1}));
  EXPECT_EQ(live.state()["version"], version + 2);
}

TEST_F(LiveRunTest, MotionsOfTheMapAreAnnouncedWithTheNextFrame) {
  begin();
  see(0);
  EXPECT_EQ(events().size(), 1U);
  for (int i = 0; i < 3; ++i) live.map_moved({});
  see(1);
  const auto seen = events();
  ASSERT_EQ(seen.size(), 2U);
  EXPECT_EQ(seen[1].first, "moved");
  EXPECT_EQ(seen[1].second["version"], live.state()["version"]);
}

TEST_F(LiveRunTest, ARunThatBeginsAgainForgetsWhatItHad) {
  begin();
  see(0);
  live.loop_refused({FrameId(9), FrameId(1), 7, LoopStage::kGeometry, {}});
  live.loop_accepted({FrameId(9), FrameId(2), 33, LoopStage::kAccepted, {}, LoopModel::kPoints3d2d,
                      0, 0.7, 0.75});
  const json loops = live.state()["loops"];
  ASSERT_EQ(loops.size(), 2U);
  EXPECT_EQ(loops[0]["accepted"], false);
  EXPECT_EQ(loops[0]["stage"], "geometry");
  EXPECT_EQ(loops[1], (json{{"query_frame", 9}, {"match_frame", 2}, {"stage", "accepted"},
                            {"accepted", true}, {"probability", 0.75}, {"inliers", 33}}));
  auto seen = events();
  ASSERT_EQ(seen.size(), 3U);  // the first beginning was no reset
  EXPECT_EQ(seen[1].first, "loop");
  EXPECT_EQ(seen[2].second, loops[1]);
  live.run_began();
  EXPECT_EQ(live.state()["done"], 0);
  EXPECT_TRUE(live.state()["loops"].empty());
  seen = events();
  ASSERT_EQ(seen.size(), 1U);
  EXPECT_EQ(seen[0].first, "reset");
  EXPECT_EQ(seen[0].second["version"], live.state()["version"]);
}

TEST_F(LiveRunTest, TheNewestImageHasItsTracksAndLines) {
  EXPECT_FALSE(live.image());
  begin();
  see(0);
  EXPECT_EQ((*live.image())["lines"], column(std::vector<float>{1, 2, 3, 4, kUnknown}, 5));
  see(1);
  const json image = *live.image();
  EXPECT_EQ(image["frame"], 1);
  EXPECT_EQ(image["width"], 16);
  EXPECT_EQ(image["height"], 12);
  EXPECT_EQ(image["image"], jpeg_url(test::tiny_grey(16, 12, 1)));
  // The first track is half a pixel off its landmark, the second has none.
  const float off = static_cast<float>(Eigen::Vector2d(3 + 0.3 - 3, 4 - 0.4 - 4).norm());
  EXPECT_NEAR(off, 0.5F, 1e-6F);
  EXPECT_EQ(image["points"], column(std::vector<float>{3, 4, off, 3, 5, kUnknown}, 3));
  EXPECT_EQ(image["lines"], column(std::vector<float>{1, 2, 3, 4, 0.5F}, 5));
}

/// Whether the next frame would have to wait.
bool is_halted(LiveRun& live) {
  bool asked = false;  // whether to stop: asked only while the run waits
  live.await_permission([&] { return asked = true; });
  return asked;
}

TEST_F(LiveRunTest, AStepIsOneFrameOfAHaltedRun) {
  EXPECT_FALSE(is_halted(live));
  live.step();
  live.step();
  EXPECT_TRUE(live.paused());
  EXPECT_FALSE(is_halted(live));
  EXPECT_FALSE(is_halted(live));
  EXPECT_TRUE(is_halted(live));
  live.step();
  live.pause(true);  // forgets the steps
  EXPECT_TRUE(is_halted(live));
  live.pause(false);
  EXPECT_FALSE(is_halted(live));
  EXPECT_EQ(live.state()["paused"], false);
  std::vector<bool> announced;
  for (const auto& [name, data] : events()) {
    EXPECT_EQ(name, "control");
    announced.push_back(data["paused"]);
  }
  EXPECT_THAT(announced, ElementsAre(true, true, true, true, false));
}

TEST_F(LiveRunTest, AHaltedRunGoesOnWhenItIsLet) {
  for (const bool by_step : {false, true}) {
    live.pause(true);
    test::ObservedThread run([&] { live.await_permission([] { return false; }); });
    run.await_sleep();
    EXPECT_FALSE(run.ended());
    by_step ? live.step() : live.pause(false);
    run.join();
    EXPECT_EQ(live.paused(), by_step);
  }
}

TEST_F(LiveRunTest, StagesAreSentWithTheirTimes) {
  live.stages_measured({{"tracking", 1.5, 3}, {"mapping", 0.25, 1}});
  live.stages_measured({{"tracking", 1.6, 4}});  // too soon after the first
  live.pause(false);
  const auto seen = events();
  ASSERT_EQ(seen.front().first, "stages");
  EXPECT_EQ(seen.front().second,
            json::parse(R"([{"name": "tracking", "cpu_s": 1.5, "calls": 3},
                            {"name": "mapping", "cpu_s": 0.25, "calls": 1}])"));
}

}  // namespace live_run_test
}  // namespace placegraph::apps
