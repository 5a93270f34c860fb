#include "apps/viewer/live_run.h"

#include <placegraph/pipeline/report/served_page.h>
#include <placegraph/pipeline/report/tables/column.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>
#include <thread>

#include "tests/support/sleeping_thread.h"
#include "tests/unit/io/datasets/tiny_images.h"

namespace placegraph::apps {
namespace live_run_test {

using nlohmann::json;
using report::column;
using report::text_column;
using ::testing::ElementsAre;

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

/// An event as a browser gets it.
struct Event {
  std::int64_t number = 0;
  std::string name;
  json data;
};

std::vector<Event> events_in(const std::string& text) {
  std::vector<Event> events;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("id: ")) events.push_back({std::stoll(line.substr(4)), "", json()});
    if (line.starts_with("event: ")) events.back().name = line.substr(7);
    if (line.starts_with("data: ")) events.back().data = json::parse(line.substr(6));
  }
  return events;
}

class LiveRunTest : public ::testing::Test {
 protected:
  LiveRunTest() { (void)reader->next(); }
  /// The events since the last call; there must be one.
  std::vector<Event> events() { return events_in(*reader->next()); }

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
  for (const Event& event : seen)
    if (event.name == "frame") frames.push_back(event.data);
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
  MapMoved moved;
  moved.poses = {{PlaceId(0), Sim3(SE3(SO3(), Eigen::Vector3d(0, 2, 0)))}};
  live.map_moved(moved);
  const json state = live.state();
  EXPECT_EQ(state["total"], 2);
  EXPECT_EQ(state["done"], 2);
  EXPECT_EQ(state["last"]["reason"], "too dark");
  const json& frames = state["frames"];
  EXPECT_EQ(frames["id"], column(std::vector<std::int32_t>{0, 1}));
  EXPECT_EQ(frames["component"], column(std::vector<std::int32_t>{0, -1}));
  EXPECT_EQ(frames["inliers"], column(std::vector<std::int32_t>{30, 0}));
  EXPECT_EQ(frames["state"], text_column({"tracking", "lost"}));
  EXPECT_EQ(frames["keyframe"], column(std::vector<std::uint8_t>{1, 0}));
  std::vector<float> poses = {10, 2, 0, 0, 0, 0, 1};
  poses.insert(poses.end(), 7, kUnknown);
  EXPECT_EQ(frames["pose"], column(poses, 7));
  EXPECT_EQ(state["landmarks"], column(std::vector<float>{10, 2, 5, 10, 2, 6}, 3));
  live.component_joined({0, 3});
  EXPECT_EQ(live.state()["frames"]["component"], column(std::vector<std::int32_t>{3, -1}));
}

TEST_F(LiveRunTest, MotionsOfTheMapAreAnnouncedWithTheNextFrame) {
  begin();
  see(0);
  EXPECT_EQ(events().size(), 1U);
  for (int i = 0; i < 3; ++i) live.map_moved({});
  see(1);
  const auto seen = events();
  ASSERT_EQ(seen.size(), 2U);
  EXPECT_EQ(seen[1].name, "moved");
  EXPECT_EQ(live.state()["number"], seen[1].number);
}

TEST_F(LiveRunTest, ItsEndIsInItsStateAsInItsLastEvent) {
  EXPECT_EQ(live.state()["finished"], false);
  live.finish("doubtful");
  const auto seen = events();
  ASSERT_EQ(seen.size(), 1U);
  EXPECT_EQ(seen[0].name, "done");
  EXPECT_EQ(seen[0].data["verdict"], "doubtful");
  const json state = live.state();
  EXPECT_EQ(state["finished"], true);
  EXPECT_EQ(state["verdict"], "doubtful");
}

/// What a browser knows after these events.
struct Known {
  std::size_t done = 0;
  std::int64_t began = 0;
  json loops = json::array(), last, stages = json::array();
  std::string landmarks;  // in base64, which has whole letters for two landmarks
  bool paused = false;

  void apply(const Event& event) {
    if (event.name == "frame") {
      ++done;
      last = event.data;
      if (last.contains("landmarks")) landmarks += last["landmarks"]["data"].get<std::string>();
      last.erase("landmarks");
    } else if (event.name == "loop") {
      loops.push_back(event.data);
    } else if (event.name == "reset") {
      done = 0;
      began = event.number;
      loops = json::array();
      last = json();
      landmarks.clear();
    } else if (event.name == "stages") {
      stages = event.data;
    } else if (event.name == "control") {
      paused = event.data["paused"];
    }
  }
};

// While the run goes on and is paused and let go by a browser, another browser asks for its state
// again and again. Each of these states must be what the events up to its number have told.
TEST_F(LiveRunTest, AStateIsWhatTheEventsUpToItsNumberHaveTold) {
  constexpr int kSteps = 3000;
  constexpr unsigned kSeed = 3;
  std::vector<Event> told;
  std::vector<json> states;
  std::atomic<bool> ended = false;
  std::thread following([&] {
    while (const auto text = reader->next())
      for (Event& event : events_in(*text)) told.push_back(std::move(event));
  });
  std::thread asking([&] {
    while (!ended) states.push_back(live.state());
  });
  std::thread controlling([&] {
    for (int i = 0; i < kSteps / 4; ++i) live.pause(i % 2 == 0);
  });
  std::mt19937 random(kSeed);
  begin();
  for (int i = 0, frames = 0; i < kSteps; ++i) {
    const unsigned what = random() % 16;
    if (what == 0) {
      begin();
      frames = 0;
    } else if (what < 8) {
      see(frames++, what == 7);
    } else if (what < 12) {
      const LoopStage stage = what < 10 ? LoopStage::kGeometry : LoopStage::kAccepted;
      const LoopRecord loop{FrameId(i % 5 + 1), FrameId(0), i, stage, {}};
      loop.accepted() ? live.loop_accepted(loop) : live.loop_refused(loop);
    } else if (what < 14) {
      live.map_moved({});
    } else {
      live.stages_measured({{"tracking", 0.1 * i, i}});
    }
  }
  controlling.join();
  ended = true;
  asking.join();
  states.push_back(live.state());
  log->close();
  following.join();
  for (std::size_t i = 0; i < told.size(); ++i)
    ASSERT_EQ(told[i].number, static_cast<std::int64_t>(i) + 1);
  Known known;
  std::size_t next = 0;
  for (const json& state : states) {
    const std::int64_t number = state["number"];
    ASSERT_LE(number, static_cast<std::int64_t>(told.size()));
    while (static_cast<std::int64_t>(next) < number) known.apply(told[next++]);
    ASSERT_EQ(static_cast<std::int64_t>(next), number);  // a later state has a later number
    EXPECT_EQ(state["done"], known.done) << number;
    EXPECT_EQ(state["began"], known.began) << number;
    EXPECT_EQ(state["loops"], known.loops) << number;
    EXPECT_EQ(state["last"], known.last) << number;
    EXPECT_EQ(state["stages"], known.stages) << number;
    EXPECT_EQ(state["paused"], known.paused) << number;
    EXPECT_EQ(state["landmarks"]["data"], known.landmarks) << number;
  }
  EXPECT_EQ(states.back()["number"], static_cast<std::int64_t>(told.size()));
}

TEST_F(LiveRunTest, ARunThatBeginsAgainBeforeItsFirstFrameSaysSoIfItHasToldOfLoops) {
  begin();
  live.loop_refused({FrameId(9), FrameId(1), 7, LoopStage::kGeometry, {}});
  begin();
  EXPECT_TRUE(live.state()["loops"].empty());
  const auto seen = events();
  ASSERT_EQ(seen.size(), 2U);
  EXPECT_EQ(seen[1].name, "reset");
}

TEST_F(LiveRunTest, ARunThatBeginsAgainForgetsWhatItHad) {
  begin();
  see(0);
  live.loop_refused({FrameId(9), FrameId(1), 7, LoopStage::kGeometry, {}});
  live.loop_accepted(
      {FrameId(9), FrameId(2), 33, LoopStage::kAccepted, {}, LoopModel::kPoints3d2d, 0, 0.7, 0.75});
  const json loops = live.state()["loops"];
  ASSERT_EQ(loops.size(), 2U);
  EXPECT_EQ(loops[0]["accepted"], false);
  EXPECT_EQ(loops[0]["stage"], "geometry");
  EXPECT_EQ(loops[1], (json{{"query_frame", 9},
                            {"match_frame", 2},
                            {"stage", "accepted"},
                            {"accepted", true},
                            {"probability", 0.75},
                            {"inliers", 33}}));
  auto seen = events();
  ASSERT_EQ(seen.size(), 3U);  // the first beginning was no reset
  EXPECT_EQ(seen[1].name, "loop");
  EXPECT_EQ(seen[2].data, loops[1]);
  live.run_began();
  EXPECT_EQ(live.state()["done"], 0);
  EXPECT_TRUE(live.state()["loops"].empty());
  seen = events();
  ASSERT_EQ(seen.size(), 1U);
  EXPECT_EQ(seen[0].name, "reset");
  EXPECT_EQ(live.state()["began"], seen[0].number);
  EXPECT_TRUE(live.state()["last"].is_null());
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
  for (const Event& event : events()) {
    EXPECT_EQ(event.name, "control");
    announced.push_back(event.data["paused"]);
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
  ASSERT_EQ(seen.front().name, "stages");
  EXPECT_EQ(live.state()["stages"], seen.front().data);
  EXPECT_EQ(seen.front().data, json::parse(R"([{"name": "tracking", "cpu_s": 1.5, "calls": 3},
                            {"name": "mapping", "cpu_s": 0.25, "calls": 1}])"));
}

}  // namespace live_run_test
}  // namespace placegraph::apps
