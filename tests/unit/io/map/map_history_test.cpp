#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/io/map/sqlite.h>

#include "tests/support/message_of.h"
#include "tests/support/random_map.h"
#include "tests/support/temporary_folder.h"

namespace placegraph {
namespace map_history_test {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// Poses are written in double precision as quaternion and translation.
constexpr double kRounding = 1e-12;

void expect_pose(const SE3& a, const SE3& b) {
  EXPECT_LT((a.inverse() * b).log().norm(), kRounding);
}
void expect_similarity(const Sim3& a, const Sim3& b) {
  EXPECT_LT((a.inverse() * b).log().norm(), kRounding);
}

/// A map of random numbers in which no field of the history is what it is by default.
StoredMap map_with_history() {
  Random random(8);
  StoredMap stored = test::random_map(random, 5, true);
  PlaceHistory& history = stored.history;
  for (PlaceHistory::Keyframe& keyframe : history.keyframes) {
    if (!keyframe.link) continue;
    keyframe.link->source = static_cast<ConstraintSource>(keyframe.id.value() % 3);
    keyframe.link->sigma_log_scale = random.uniform(0.1, 1);
    keyframe.link->scale = random.uniform(0.5, 2);
  }
  for (PlaceHistory::Segment& segment : history.segments)
    segment.S_place_segment = Sim3(segment.S_place_segment.rotation(),
                                   segment.S_place_segment.translation(), random.uniform(0.5, 2));
  const KeyframeId last = stored.map.keyframes.back().id;
  history.loops.front().scale_match_query = 1.25;
  history.loops.push_back(
      {last, KeyframeId(1), test::random_pose(random), test::random_information<7>(random), 0.75});
  history.motions.push_back({history.segments[2].anchor, history.segments[4].anchor,
                             test::random_pose(random), test::random_information<6>(random)});
  history.merged.push_back({history.segments[3].anchor,
                            {{history.segments[1].anchor, test::random_information<7>(random)},
                             {history.segments[4].anchor, test::random_information<7>(random)}}});
  history.separated.insert({history.segments[1].anchor, history.segments[2].anchor});
  return stored;
}

class MapHistory : public ::testing::Test {
 protected:
  MapHistory() { write_map(path, stored); }
  void change(const std::string& sql) {
    SqliteDatabase(path, SqliteDatabase::Access::kWrite).execute(sql);
  }
  std::string refusal() const {
    return test::message_of([&] { (void)read_map(path); });
  }
  PlaceHistory read() const { return read_map(path).history; }

  const StoredMap stored = map_with_history();
  const PlaceHistory& written = stored.history;
  test::TemporaryFolder dir;
  const std::string path = dir / "map.db";
};

TEST_F(MapHistory, KeyframesComeBackWithTheirLinks) {
  const PlaceHistory history = read();
  ASSERT_EQ(history.keyframes.size(), written.keyframes.size());
  for (std::size_t i = 0; i < history.keyframes.size(); ++i) {
    const PlaceHistory::Keyframe &a = history.keyframes[i], &b = written.keyframes[i];
    SCOPED_TRACE(i);
    EXPECT_EQ(a.id, b.id);
    EXPECT_EQ(a.segment, b.segment);
    EXPECT_EQ(a.track_segment, b.track_segment);
    ASSERT_EQ(a.link.has_value(), b.link.has_value());
    if (!a.link) continue;
    EXPECT_EQ(a.link->from, b.link->from);
    expect_pose(a.link->T_from_this, b.link->T_from_this);
    EXPECT_EQ(a.link->information, b.link->information);
    EXPECT_EQ(a.link->source, b.link->source);
    EXPECT_EQ(a.link->sigma_log_scale, b.link->sigma_log_scale);
    EXPECT_EQ(a.link->scale, b.link->scale);
  }
  EXPECT_EQ(history.scale_measured, written.scale_measured);
}

TEST_F(MapHistory, PartsAndPlacesComeBack) {
  const PlaceHistory history = read();
  ASSERT_EQ(history.segments.size(), written.segments.size());
  for (std::size_t i = 0; i < history.segments.size(); ++i) {
    SCOPED_TRACE(i);
    EXPECT_EQ(history.segments[i].anchor, written.segments[i].anchor);
    EXPECT_EQ(history.segments[i].place, written.segments[i].place);
    expect_similarity(history.segments[i].S_place_segment, written.segments[i].S_place_segment);
    EXPECT_EQ(history.segments[i].covariance, written.segments[i].covariance);
    EXPECT_EQ(history.segments[i].motion_covariance, written.segments[i].motion_covariance);
  }
  ASSERT_EQ(history.places.size(), written.places.size());
  for (std::size_t i = 0; i < history.places.size(); ++i) {
    EXPECT_EQ(history.places[i].id, written.places[i].id);
    EXPECT_EQ(history.places[i].reach, written.places[i].reach);
    EXPECT_EQ(history.places[i].last_keyframe, written.places[i].last_keyframe);
  }
  EXPECT_EQ(history.founded, written.founded);
  EXPECT_EQ(history.judged_loops, written.judged_loops);
  EXPECT_EQ(history.median_depth_m, written.median_depth_m);
}

TEST_F(MapHistory, MotionsAndRevisitsComeBack) {
  const PlaceHistory history = read();
  ASSERT_EQ(history.motions.size(), written.motions.size());
  for (std::size_t i = 0; i < history.motions.size(); ++i) {
    EXPECT_EQ(history.motions[i].from, written.motions[i].from);
    EXPECT_EQ(history.motions[i].to, written.motions[i].to);
    expect_pose(history.motions[i].T_from_to, written.motions[i].T_from_to);
    EXPECT_EQ(history.motions[i].covariance, written.motions[i].covariance);
  }
  ASSERT_EQ(history.loops.size(), written.loops.size());
  for (std::size_t i = 0; i < history.loops.size(); ++i) {
    EXPECT_EQ(history.loops[i].query, written.loops[i].query);
    EXPECT_EQ(history.loops[i].match, written.loops[i].match);
    expect_similarity(history.loops[i].S_match_query(), written.loops[i].S_match_query());
    EXPECT_EQ(history.loops[i].information, written.loops[i].information);
  }
}

TEST_F(MapHistory, MergersAndWhatIsPartedComeBack) {
  const PlaceHistory history = read();
  ASSERT_EQ(history.merged.size(), written.merged.size());
  for (std::size_t i = 0; i < history.merged.size(); ++i) {
    EXPECT_EQ(history.merged[i].anchor, written.merged[i].anchor);
    EXPECT_EQ(history.merged[i].covariance_of_segment, written.merged[i].covariance_of_segment);
  }
  EXPECT_EQ(history.separated, written.separated);
}

TEST_F(MapHistory, MergersThatAreUndoneLeaveTheFile) {
  MapChanges changes;
  changes.places = stored.map.place_graph.places;
  changes.keyframes = stored.map.keyframes;
  changes.history = written;
  MapDatabase database = MapDatabase::create(dir / "steps.db", stored.origin);
  database.commit(changes);
  changes.history.merged.pop_back();
  database.finish(changes);
  const PlaceHistory history = read_map(dir / "steps.db").history;
  ASSERT_EQ(history.merged.size(), 1u);
  EXPECT_EQ(history.merged[0].covariance_of_segment, written.merged[0].covariance_of_segment);
}

TEST_F(MapHistory, AMapWithoutHistoryIsRead) {
  StoredMap bare = stored;
  bare.history = {};
  write_map(path, bare);
  const PlaceHistory history = read();
  EXPECT_TRUE(history.keyframes.empty());
  EXPECT_TRUE(history.segments.empty());
  EXPECT_TRUE(history.merged.empty());
}

/// What is done to the file, and what the message names.
struct Damage {
  std::string sql, place, reason;
  friend void PrintTo(const Damage& damage, std::ostream* os) { *os << damage.sql; }
};

class DamagedMapHistory : public MapHistory, public ::testing::WithParamInterface<Damage> {};

TEST_P(DamagedMapHistory, IsRefusedWithTableAndRow) {
  change("PRAGMA foreign_keys = OFF; " + GetParam().sql);
  EXPECT_THAT(refusal(),
              AllOf(HasSubstr("map.db: table " + GetParam().place), HasSubstr(GetParam().reason)));
}

INSTANTIATE_TEST_SUITE_P(
    Tables, DamagedMapHistory,
    ::testing::Values(
        Damage{"DELETE FROM track_segment WHERE number = 0", "track_segment, row 1",
               "row 0 is missing before it"},
        Damage{"UPDATE track_segment SET scale_measured = 2 WHERE number = 1",
               "track_segment, row 1", ""},
        Damage{"UPDATE link SET track_segment = 2 WHERE keyframe = 0", "link, row 0",
               "track_segment"},
        Damage{"UPDATE link SET segment = 99 WHERE keyframe = 0", "link, row 0", "segment 99"},
        Damage{
            "DELETE FROM segment WHERE anchor = 0; DELETE FROM merged; DELETE FROM merged_segment",
            "link, row 0", "segment 0 is not a segment of the map"},
        Damage{"DELETE FROM link WHERE keyframe = 0", "link: ", "rows for"},
        Damage{"UPDATE link SET from_keyframe = keyframe WHERE from_keyframe = 0", "link, row 1",
               "from_keyframe is not older"},
        Damage{"UPDATE link SET source = 3 WHERE from_keyframe = 0", "link, row 1", "source"},
        Damage{"UPDATE link SET scale = 0 WHERE from_keyframe = 0", "link, row 1",
               "scale must be positive"},
        Damage{"UPDATE link SET T_from_this = zeroblob(56) WHERE from_keyframe = 0", "link, row 1",
               "T_from_this"},
        Damage{"UPDATE segment SET place = 99 WHERE anchor = 0", "segment, row 0",
               "place 99 is not a place of the map"},
        Damage{"UPDATE segment SET covariance = zeroblob(8) WHERE anchor = 0", "segment, row 0",
               "covariance"},
        Damage{"UPDATE motion SET to_segment = 99 WHERE number = 1", "motion, row 1",
               "its ends are not segments of the map"},
        Damage{"UPDATE motion SET from_segment = 99 WHERE number = 0", "motion, row 0",
               "its ends are not segments of the map"},
        Damage{"DELETE FROM motion WHERE number = 0", "motion, row 1", "row 0 is missing"},
        Damage{"UPDATE loop_constraint SET query = 99 WHERE number = 1", "loop_constraint, row 1",
               "query 99 is not a keyframe of the map"},
        Damage{"DELETE FROM loop_constraint WHERE number = 0", "loop_constraint, row 1",
               "row 0 is missing"},
        Damage{"UPDATE merged SET anchor = 99 WHERE number = 1", "merged, row 1",
               "anchor is not a segment of the map"},
        Damage{"UPDATE merged_segment SET segment = 99 WHERE number = 2", "merged_segment, row 2",
               "segment 99 is not a segment of the map"},
        Damage{"UPDATE merged_segment SET merged = 2 WHERE number = 2", "merged_segment, row 2",
               "merged"},
        Damage{"UPDATE separated SET other = 99 WHERE number = 1", "separated, row 1",
               "other 99 is not a keyframe of the map"}));

}  // namespace map_history_test
}  // namespace placegraph
