#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/map/sqlite.h>

#include <filesystem>
#include <fstream>

#include "tests/support/message_of.h"
#include "tests/support/random_map.h"
#include "tests/support/temporary_folder.h"

namespace placegraph {
namespace map_database_test {

using ::testing::AllOf;
using ::testing::HasSubstr;

class MapDatabaseFaults : public ::testing::Test {
 protected:
  MapDatabaseFaults() {
    Random random(3);
    write_map(path, test::random_map(random));
  }
  void change(const std::string& sql) {
    SqliteDatabase(path, SqliteDatabase::Access::kWrite).execute(sql);
  }
  std::string refusal() const {
    return test::message_of([&] { (void)read_map(path); });
  }
  test::TemporaryFolder dir;
  const std::string path = dir / "map.db";
};

TEST_F(MapDatabaseFaults, APoseThatIsNotFiniteIsNamedWithTableAndRow) {
  change("UPDATE keyframe SET T_place_keyframe = x'" + std::string(96, '0') +
         "000000000000f87f' WHERE id = 2");
  EXPECT_THAT(refusal(), AllOf(HasSubstr("map.db: table keyframe, row 2: T_place_keyframe"),
                               HasSubstr("not finite")));
}

TEST_F(MapDatabaseFaults, ARotationOfNoUnitLengthIsRefused) {
  change("UPDATE place SET T_map_place = zeroblob(56) WHERE id = 1");
  EXPECT_THAT(refusal(), HasSubstr("table place, row 1: T_map_place: a pose's quaternion"));
}

// The judgement of an interrupted run is of the map as it is: a run that goes on removes it.
TEST(MapDatabase, AJudgementDecidesOnMetresUntilTheRunGoesOn) {
  Random random(4);
  StoredMap stored = test::random_map(random);
  stored.finished = false;
  const test::TemporaryFolder dir;
  const std::string path = dir / "map.db";
  write_map(path, stored);
  ASSERT_TRUE(read_map(path).map.metric);
  Judgement judgement = *stored.judgement;
  judgement.metric = false;
  write_judgement(path, judgement);
  check_map_checksums(path);
  const StoredMap judged = read_map(path);
  EXPECT_FALSE(judged.finished || judged.map.metric || judged.judgement->expected_drift_m);

  MapChanges changes;
  changes.places = stored.map.place_graph.places;
  changes.first_frame = stored.map.frames.size();
  changes.landmarks = stored.map.landmarks;
  changes.loops = stored.map.loops;
  changes.history = stored.history;
  changes.metric = true;
  MapDatabase::open(path).commit(changes);
  EXPECT_TRUE(read_map(path).map.metric);
  EXPECT_FALSE(read_map(path).judgement);
}

TEST_F(MapDatabaseFaults, ANumberThatIsNotFiniteIsRefused) {
  change("UPDATE place SET scale = 9e999 WHERE id = 0");
  EXPECT_THAT(refusal(), HasSubstr("table place, row 0: scale is not finite"));
  change("UPDATE place SET scale = -1 WHERE id = 0");
  EXPECT_THAT(refusal(), HasSubstr("table place, row 0: scale must be positive"));
}

TEST_F(MapDatabaseFaults, MissingRowsAreNamedByWhoRefersToThem) {
  change("DELETE FROM place WHERE id = 1");
  EXPECT_THAT(refusal(), HasSubstr("place 1 is not a place of the map"));
}

TEST_F(MapDatabaseFaults, AMissingKeyframeIsNamedByWhoRefersToIt) {
  change("DELETE FROM keyframe WHERE id = 0");
  EXPECT_THAT(refusal(), AllOf(HasSubstr("row 0: keyframe 0 is not a keyframe of the map")));
}

TEST_F(MapDatabaseFaults, AGapAmongCountedRowsIsSeen) {
  change("DELETE FROM frame WHERE number = 2");
  EXPECT_THAT(refusal(), HasSubstr("table frame, row 3: row 2 is missing before it"));
}

TEST_F(MapDatabaseFaults, CountsAreHeldAgainstTheBytes) {
  change("UPDATE features SET count = 2000000000 WHERE keyframe = 1");
  EXPECT_THAT(refusal(), AllOf(HasSubstr("table features, row 1: data has"),
                               HasSubstr("instead of 120000000000")));
}

TEST_F(MapDatabaseFaults, AViewThatPromisesTooMuchIsRefusedBeforeMemoryIsAskedFor) {
  change("UPDATE view SET data = x'ffffffffffff0000' WHERE keyframe = 1");
  EXPECT_THAT(refusal(), HasSubstr("table view, row 1: data: is cut off"));
}

TEST_F(MapDatabaseFaults, AnInformationMatrixMustBeOne) {
  change("UPDATE edge SET information = zeroblob(168) WHERE number = 1");
  EXPECT_THAT(refusal(), HasSubstr("table edge, row 0:1: information"));
}

TEST_F(MapDatabaseFaults, AMissingTableIsSaid) {
  change("DROP TABLE loop");
  EXPECT_THAT(refusal(), HasSubstr("no such table: loop"));
}

TEST_F(MapDatabaseFaults, ANewerSchemaIsRefusedByItsVersion) {
  change("PRAGMA user_version = 99");
  EXPECT_THAT(refusal(), HasSubstr("is a map of schema 99; this program reads up to 4"));
}

TEST_F(MapDatabaseFaults, ALoopModelThatThereIsNotIsNamed) {
  change("UPDATE loop SET model = 'guess' WHERE number = 0");
  EXPECT_THAT(refusal(), HasSubstr("table loop, row 0: model"));
  change("UPDATE loop SET model = 'none', probability = 1.5 WHERE number = 0");
  EXPECT_THAT(refusal(), HasSubstr("table loop, row 0: similarity or probability"));
}

TEST_F(MapDatabaseFaults, ALoopStageThatThereIsNotIsNamed) {
  change("UPDATE loop SET stage = 'guess' WHERE number = 1");
  EXPECT_THAT(refusal(), HasSubstr("map.db: table loop, row 1: stage"));
  EXPECT_THAT(refusal(), HasSubstr("guess"));
  change("UPDATE loop SET stage = 'geometry', accepted = 1 WHERE number = 1");
  EXPECT_THAT(refusal(), HasSubstr("table loop, row 1: accepted"));
}

/// SQL that turns a map of the present schema into one of schema 2.
std::string to_schema_2(const std::string& path) {
  std::string sql =
      "PRAGMA foreign_keys = OFF; BEGIN; DROP VIEW component; DROP VIEW frame_component;";
  for (const char* table : {"observations", "thumbnail", "inertial_state", "judgement", "finding",
                            "overlay", "evidence", "note", "odometry_error", "stage"})
    sql += std::string("DROP TABLE ") + table + ";";
  {
    SqliteDatabase database(path, SqliteDatabase::Access::kRead);
    SqliteRows tables(database, "sqlite_master", "name", "WHERE type = 'table'");
    while (tables.next())
      if (sql.find("DROP TABLE " + std::string(tables.text(0)) + ";") == std::string::npos)
        sql += "ALTER TABLE " + std::string(tables.text(0)) + " DROP COLUMN checksum;";
  }
  return sql +
         "ALTER TABLE landmarks DROP COLUMN colours; ALTER TABLE landmarks DROP COLUMN covariances;"
         "ALTER TABLE frame DROP COLUMN confidence; ALTER TABLE frame DROP COLUMN reason;"
         "ALTER TABLE loop RENAME COLUMN similarity TO likeness;"
         "ALTER TABLE separated RENAME TO parted;"
         "ALTER TABLE merged_segment RENAME COLUMN segment TO part;"
         "ALTER TABLE merged_segment RENAME TO merged_part;"
         "ALTER TABLE loop_constraint RENAME TO revisit;"
         "ALTER TABLE motion RENAME COLUMN from_segment TO from_part;"
         "ALTER TABLE motion RENAME COLUMN to_segment TO to_part;"
         "ALTER TABLE link RENAME COLUMN segment TO part;"
         "ALTER TABLE link RENAME COLUMN track_segment TO run;"
         "ALTER TABLE track_segment RENAME COLUMN scale_measured TO unit_measured;"
         "ALTER TABLE track_segment RENAME TO run;"
         "ALTER TABLE segment RENAME COLUMN S_place_segment TO S_place_part;"
         "ALTER TABLE segment RENAME TO part; PRAGMA user_version = 2; COMMIT;";
}

const std::string kToSchema3 =
    "DROP TABLE overlay; DROP TABLE evidence; DROP TABLE note; DROP TABLE odometry_error;"
    "DROP TABLE stage; PRAGMA user_version = 3";

// Schema 1 had no more columns of loops than these.
const std::string kToSchema1 =
    "BEGIN; ALTER TABLE frame DROP COLUMN inliers; ALTER TABLE loop DROP COLUMN model; ALTER "
    "TABLE loop DROP COLUMN lines;"
    "ALTER TABLE loop DROP COLUMN likeness; ALTER TABLE loop DROP COLUMN probability;"
    "PRAGMA user_version = 1; COMMIT";

TEST_F(MapDatabaseFaults, AMapOfAnOlderSchemaIsReadAndUpgradedWhenWritten) {
  const StoredMap present = read_map(path);
  for (const int schema : {3, 2, 1}) {
    write_map(path, present);
    change(schema == 3 ? kToSchema3 : to_schema_2(path));
    if (schema == 1) change(kToSchema1);
    const std::string bytes = test::read_file(path);
    const StoredMap old = read_map(path);
    EXPECT_EQ(test::read_file(path), bytes);  // reading leaves the file as it is
    ASSERT_EQ(old.map.loops.size(), 2u);
    EXPECT_EQ(old.map.loops[0].inliers, 33);
    EXPECT_EQ(old.map.loops[0].probability, schema == 1 ? 0 : 0.9);
    EXPECT_TRUE(old.history.evidence.empty() && old.run.notes.empty());
    EXPECT_EQ(old.history.loops.size(), present.history.loops.size());
    EXPECT_EQ(old.map.landmarks.size(), present.map.landmarks.size());
    EXPECT_EQ(old.map.landmarks[1].rgb || old.judgement, schema == 3);
    EXPECT_NO_THROW(check_map_checksums(path));
    MapDatabase::open(path).close();
    EXPECT_EQ(SqliteDatabase(path, SqliteDatabase::Access::kRead).integer("PRAGMA user_version"),
              kMapSchema);
    EXPECT_NO_THROW(check_map_checksums(path));
    const Map upgraded = read_map(path).map;
    EXPECT_EQ(upgraded.loops[0].inliers, 33);
    EXPECT_EQ(upgraded.frames.size(), old.map.frames.size());
  }
}

TEST_F(MapDatabaseFaults, AChangedRowIsFoundByItsChecksum) {
  EXPECT_NO_THROW(check_map_checksums(path));
  for (const auto& [sql, row] : std::vector<std::pair<std::string, std::string>>{
           {"UPDATE keyframe SET stamp_ns = stamp_ns + 1 WHERE id = 2", "table keyframe, row 2"},
           {"UPDATE origin SET sequence = '/data/elsewhere'", "table origin, row 1"},
           {"UPDATE frame SET confidence = 0.123 WHERE number = 3", "table frame, row 3"},
           {"UPDATE finding SET advice = '' WHERE number = 0", "table finding, row 0"},
           {"UPDATE edge SET kernel_width = 4 WHERE number = 1", "table edge, row 0"},
           {"UPDATE camera SET fx = fx + 1e-9", "table camera, row 1"}}) {
    write_map(path, read_map(path));
    change(sql);
    EXPECT_NO_THROW((void)read_map(path)) << sql;
    EXPECT_THAT(test::message_of([&] { check_map_checksums(path); }),
                AllOf(HasSubstr("map.db: " + row), HasSubstr("checksum")))
        << sql;
  }
}

// Bytes of the file that no row uses may change.
TEST_F(MapDatabaseFaults, AChangedByteIsRefusedOrChangesNothing) {
  const std::string whole = test::read_file(path);
  Random random(11);
  int refused = 0;
  for (int i = 0; i < 60; ++i) {
    std::string changed = whole;
    const auto at = static_cast<std::size_t>(random.uniform() * static_cast<double>(whole.size()));
    changed[at] = static_cast<char>(changed[at] ^ (1 << random.index(8)));
    std::ofstream(path, std::ios::binary | std::ios::trunc) << changed;
    try {
      if (check_map_file(path) != "ok") throw FileError(path, "damaged");
      const StoredMap read = read_map(path);
      check_map_checksums(path);
      write_map(dir / "again.db", read);
      EXPECT_EQ(test::read_file(dir / "again.db"), whole) << "byte " << at;
    } catch (const FileError&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 10);
}

TEST_F(MapDatabaseFaults, AnotherDatabaseIsNoMap) {
  change("PRAGMA application_id = 1");
  EXPECT_THAT(refusal(), HasSubstr("is a database, but no saved map"));
}

TEST_F(MapDatabaseFaults, WhatIsNoDatabaseSaysSo) {
  std::ofstream(path) << std::string(5000, 'x');
  EXPECT_THAT(refusal(), HasSubstr("is no saved map"));
  std::ofstream(path, std::ios::trunc) << "";
  EXPECT_THAT(refusal(), HasSubstr("no saved map"));
  std::filesystem::remove(path);
  EXPECT_THAT(refusal(), HasSubstr("there is no such file"));
}

TEST_F(MapDatabaseFaults, ACutOffFileIsRefusedAtEveryLength) {
  const std::string whole = test::read_file(path);
  for (std::size_t size = 100; size < whole.size(); size += 3 * 16384 + 101) {
    std::ofstream(path, std::ios::binary | std::ios::trunc) << whole.substr(0, size);
    EXPECT_THAT(refusal(), HasSubstr("map.db: ")) << size;
  }
}

TEST(MapDatabase, PlacesThatAreGoneLeaveNothingBehind) {
  const test::TemporaryFolder dir;
  Random random(4);
  const StoredMap stored = test::random_map(random, 3);
  MapChanges changes;
  changes.places = stored.map.place_graph.places;
  changes.keyframes = stored.map.keyframes;
  for (const Place& place : changes.places)
    changes.appearances.emplace_back(place.id, place.appearance);
  MapDatabase database = MapDatabase::create(dir / "map.db", stored.origin);
  database.commit(changes);
  Place& kept = changes.places[0];
  for (const PlaceMember& member : changes.places[1].members) kept.members.push_back(member);
  changes.places.erase(changes.places.begin() + 1);
  changes.appearances.clear();
  changes.keyframes.clear();
  database.finish(changes);
  const Map map = read_map(dir / "map.db").map;
  ASSERT_EQ(map.place_graph.places.size(), 2u);
  EXPECT_EQ(map.place_graph.places[0].members.size(), kept.members.size());
  EXPECT_EQ(map.place_graph.places[0].appearance.words.size(), 5u);
}

/// Leaves in left.db a map of a program that was killed: the file and its log.
StoredMap leave_killed_map(const test::TemporaryFolder& dir) {
  Random random(4);
  StoredMap stored = test::random_map(random, 3);
  MapChanges changes;
  changes.places = stored.map.place_graph.places;
  changes.keyframes = stored.map.keyframes;
  MapDatabase database = MapDatabase::create(dir / "map.db", stored.origin);
  database.commit(changes);
  std::filesystem::copy(dir / "map.db", dir / "left.db");
  std::filesystem::copy(dir / "map.db-wal", dir / "left.db-wal");
  EXPECT_THAT(test::message_of([&] { (void)read_map(dir / "map.db"); }),
              HasSubstr("another program is using it"));
  return stored;
}

// A second connection sees what has been committed, whatever becomes of the first.
TEST(MapDatabase, WhatIsCommittedIsThereWithoutAnEnd) {
  const test::TemporaryFolder dir;
  const StoredMap stored = leave_killed_map(dir);
  EXPECT_TRUE(is_unfinished_map(dir / "left.db"));
  EXPECT_EQ(read_map(dir / "left.db").map.keyframes.size(), stored.map.keyframes.size());
  EXPECT_EQ(check_map_file(dir / "left.db"), "ok");
}

// The newest commits of a map that was killed are in its log.
TEST(MapDatabase, AMapThatCannotBeReplacedKeepsItsCommits) {
  const test::TemporaryFolder dir;
  const StoredMap stored = leave_killed_map(dir);
  std::filesystem::create_directories(dir / "left.db-shm/full");
  EXPECT_THROW((void)MapDatabase::create(dir / "left.db", stored.origin), std::exception);
  std::filesystem::remove_all(dir / "left.db-shm");
  EXPECT_EQ(read_map(dir / "left.db").map.keyframes.size(), stored.map.keyframes.size());
  MapDatabase::create(dir / "left.db", stored.origin).close();
  EXPECT_EQ(read_map(dir / "left.db").map.keyframes.size(), 0u);
}

TEST(MapDatabase, AMapThatAProgramWritesIsNotReplaced) {
  const test::TemporaryFolder dir;
  Random random(4);
  const StoredMap stored = test::random_map(random, 3);
  MapDatabase database = MapDatabase::create(dir / "map.db", stored.origin);
  database.commit({});
  EXPECT_THAT(test::message_of([&] { (void)MapDatabase::create(dir / "map.db", stored.origin); }),
              HasSubstr("another program is using it"));
}

}  // namespace map_database_test
}  // namespace placegraph
