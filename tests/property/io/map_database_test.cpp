#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "tests/support/map_bits.h"
#include "tests/support/random_map.h"
#include "tests/support/seed.h"
#include "tests/support/temporary_folder.h"

namespace placegraph {
namespace map_database_test {

using test::random_map;

TEST(MapDatabaseProperty, ReadAfterWriteIsIdentity) {
  Random random = test::seeded_random(5);
  for (int round = 0; round < 20; ++round) {
    const test::TemporaryFolder dir;
    StoredMap stored = random_map(random, 2 + random.index(5), round % 2 == 1);
    stored.finished = round % 3 != 0;
    write_map(dir / "a.db", stored);
    const StoredMap read = read_map(dir / "a.db");
    EXPECT_EQ(test::map_bits(read.map), test::map_bits(stored.map));
    EXPECT_EQ(read.finished, stored.finished);
    // What map_bits does not look at: the file of what was read has the same bytes.
    write_map(dir / "b.db", read);
    EXPECT_EQ(test::read_file(dir / "a.db"), test::read_file(dir / "b.db"));
    ASSERT_EQ(read.map.landmarks.size(), stored.map.landmarks.size());
    EXPECT_EQ(read.map.landmarks[1234].point_cam, stored.map.landmarks[1234].point_cam);
    EXPECT_EQ(read.map.landmarks[1234].rgb, stored.map.landmarks[1234].rgb);
    EXPECT_EQ(read.map.landmarks[1233].rgb, std::nullopt);
    EXPECT_EQ(read.map.landmarks[1234].covariance, stored.map.landmarks[1234].covariance);
    EXPECT_EQ(read.map.landmarks[1235].covariance, std::nullopt);
    ASSERT_EQ(read.map.frames.size(), stored.map.frames.size());
    EXPECT_EQ(read.map.frames[5].reason, "only 'few' points");
    EXPECT_EQ(read.map.frames[4].confidence, stored.map.frames[4].confidence);
    EXPECT_EQ(read.judgement.has_value(), stored.finished);
    for (std::size_t i = 0; i < stored.map.keyframes.size(); ++i) {
      EXPECT_EQ(read.map.keyframes[i].view.thumbnail, stored.map.keyframes[i].view.thumbnail);
      EXPECT_EQ(read.map.keyframes[i].thumbnail, stored.map.keyframes[i].thumbnail);
      ASSERT_EQ(read.map.keyframes[i].observations.size(),
                stored.map.keyframes[i].observations.size());
      for (std::size_t k = 0; k < read.map.keyframes[i].observations.size(); ++k) {
        const LandmarkObservation &a = read.map.keyframes[i].observations[k],
                                  &b = stored.map.keyframes[i].observations[k];
        EXPECT_TRUE(a.landmark == b.landmark && a.px == b.px && a.camera == b.camera);
      }
      EXPECT_EQ(read.map.keyframes[i].view.gabor.values, stored.map.keyframes[i].view.gabor.values);
      EXPECT_EQ(read.map.keyframes[i].view.colour.energy,
                stored.map.keyframes[i].view.colour.energy);
    }
    EXPECT_EQ(read.history.segments.back().covariance, stored.history.segments.back().covariance);
    EXPECT_EQ(read.history.loops.front().information, stored.history.loops.front().information);
    EXPECT_EQ(read.history.evidence, stored.history.evidence);
    EXPECT_EQ(read.origin.overlays.at(0).note.text, stored.origin.overlays[0].note.text);
    EXPECT_EQ(cv::norm(read.origin.overlays[0].mask, stored.origin.overlays[0].mask), 0);
    EXPECT_EQ(read.run.notes.at(0).advice, stored.run.notes[0].advice);
    EXPECT_EQ(read.run.odometry_error->shared, stored.run.odometry_error->shared);
    ASSERT_EQ(read.run.stages.size(), 2u);
    EXPECT_EQ(read.run.stages[1].cpu_s, stored.run.stages[1].cpu_s);
  }
}

// What a run commits in steps is what it would have written at once.
TEST(MapDatabaseProperty, CommitsAddUpToTheWholeMap) {
  Random random = test::seeded_random(6);
  for (int round = 0; round < 5; ++round) {
    const test::TemporaryFolder dir;
    const StoredMap whole = random_map(random, 5);
    {
      MapDatabase database = MapDatabase::create(dir / "steps.db", whole.origin);
      MapChanges changes;
      for (std::size_t step = 1; step <= whole.map.place_graph.places.size(); ++step) {
        const bool last = step == whole.map.place_graph.places.size();
        changes = MapChanges();
        changes.places.assign(
            whole.map.place_graph.places.begin(),
            whole.map.place_graph.places.begin() + static_cast<std::ptrdiff_t>(step));
        const Place& place = changes.places.back();
        changes.appearances.emplace_back(place.id, place.appearance);
        for (const PlaceMember& member : place.members) {
          changes.keyframes.push_back(*whole.map.find_keyframe(member.keyframe));
          changes.observations.emplace_back(member.keyframe, changes.keyframes.back().observations);
        }
        if (last) {
          for (std::size_t i = 0; i < whole.map.place_graph.constraints.size(); ++i)
            changes.constraints.push_back(
                {0, static_cast<std::int64_t>(i), whole.map.place_graph.constraints[i]});
          changes.frames = whole.map.frames;
          changes.online = whole.map.trajectory_online.poses;
          changes.first_landmark = 1000;
          changes.landmarks.assign(whole.map.landmarks.begin() + 1000, whole.map.landmarks.end());
          changes.loops = whole.map.loops;
          changes.history = whole.history;
          changes.metric = whole.map.metric;
          database.finish(changes);
          break;
        }
        changes.landmarks.assign(whole.map.landmarks.begin(), whole.map.landmarks.begin() + 1200);
        database.commit(changes);
      }
    }
    const StoredMap read = read_map(dir / "steps.db");
    EXPECT_EQ(test::map_bits(read.map), test::map_bits(whole.map));
    EXPECT_EQ(read.map.landmarks.size(), whole.map.landmarks.size());
    EXPECT_FALSE(std::filesystem::exists(dir / "steps.db-wal"));
  }
}

/// The first frames of a map, with all its places.
MapChanges changes_of(const StoredMap& stored, std::size_t frames) {
  MapChanges changes;
  changes.places = stored.map.place_graph.places;
  changes.keyframes = stored.map.keyframes;
  changes.frames.assign(stored.map.frames.begin(),
                        stored.map.frames.begin() + static_cast<std::ptrdiff_t>(frames));
  changes.online.assign(
      stored.map.trajectory_online.poses.begin(),
      stored.map.trajectory_online.poses.begin() + static_cast<std::ptrdiff_t>(frames));
  changes.history = stored.history;
  return changes;
}

// Wherever the program ends, the map has at least as many frames as it ever had.
TEST(MapDatabaseProperty, ARestartKeepsTheOldMapUntilTheNewOneIsLonger) {
  Random random = test::seeded_random(7);
  for (int round = 0; round < 10; ++round) {
    const test::TemporaryFolder dir;
    const std::string path = dir / "map.db";
    StoredMap stored = random_map(random, 4);
    const std::size_t all = stored.map.frames.size();
    std::size_t longest = 0, newest = 0;
    RunRecord run;
    auto database = std::make_optional(MapDatabase::create(path, stored.origin));
    for (int step = 0; step < 12; ++step) {
      if (random.uniform() < 0.3) {
        stored.origin.lens_pass = step;
        run.stages = {{"reading", 0.5 * step, step}};
        database->restart(stored.origin, run);
        newest = 0;
      } else {
        newest = std::min(all, newest + 1 + static_cast<std::size_t>(random.index(6)));
        MapChanges changes = changes_of(stored, newest);
        changes.run = run;
        database->commit(changes);
      }
      longest = std::max(longest, newest);
      if (random.uniform() < 0.5) continue;
      database.reset();
      EXPECT_EQ(read_map(path).map.frames.size(), longest);
      const StoredMap current = read_map(interrupted_map_path(path));
      EXPECT_EQ(current.map.frames.size(), newest);
      EXPECT_EQ(current.origin.lens_pass, stored.origin.lens_pass);
      ASSERT_EQ(current.run.stages.size(), run.stages.size());
      for (std::size_t i = 0; i < run.stages.size(); ++i)
        EXPECT_EQ(current.run.stages[i].calls, run.stages[i].calls);
      check_map_checksums(interrupted_map_path(path));
      database = MapDatabase::open(path);
    }
    database->finish(changes_of(stored, all));
    EXPECT_EQ(interrupted_map_path(path), path);
    EXPECT_TRUE(read_map(path).finished);
    EXPECT_EQ(read_map(path).origin.lens_pass, stored.origin.lens_pass);
  }
}

}  // namespace map_database_test
}  // namespace placegraph
