#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/random.h>
#include <placegraph/io/map/map_schema.h>
#include <placegraph/io/map/map_table.h>

#include <limits>
#include <optional>

#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace placegraph {
namespace map_table_test {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::UnorderedElementsAreArray;

class Table : public ::testing::Test {
 protected:
  Table() {
    database.execute("PRAGMA synchronous = OFF");
    database.text("PRAGMA journal_mode = MEMORY");
    database.execute("CREATE TABLE things (id INTEGER PRIMARY KEY, a, b, checksum)");
    table.emplace(database, "things", "id", 3);
  }
  static MapRow row(std::int64_t a, const std::string& b) { return MapRow().integer(a).text(b); }
  std::map<std::int64_t, std::pair<std::int64_t, std::string>> content() {
    std::map<std::int64_t, std::pair<std::int64_t, std::string>> content;
    SqliteRows rows(database, "things", "id, a, b");
    while (rows.next()) content[rows.integer(0)] = {rows.integer(1), std::string(rows.text(2))};
    return content;
  }
  test::TemporaryFolder dir;
  SqliteDatabase database{dir / "some.db", SqliteDatabase::Access::kCreate};
  std::optional<MapTable> table;
};

TEST(MapRow, IsEqualIfAndOnlyIfTheBitsAre) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(MapRow().real(kNan).null(), MapRow().real(kNan).null());
  EXPECT_NE(MapRow().real(0.0), MapRow().real(-0.0));
  EXPECT_NE(MapRow().real(1), MapRow().integer(1));
  EXPECT_NE(MapRow().text("a"), MapRow().blob("a"));
  EXPECT_NE(MapRow().text(""), MapRow().null());
  EXPECT_NE(MapRow().integer(1).integer(2), MapRow().integer(2).integer(1));
  EXPECT_NE(MapRow().integer(1), MapRow().integer(1).null());
  EXPECT_EQ(MapRow().id(Id<struct SomeTag>(4)), MapRow().integer(4));
  EXPECT_EQ(MapRow().symmetric(Eigen::Matrix2d::Identity()),
            MapRow().blob(std::string_view("\0\0\0\0\0\0\xf0\x3f\0\0\0\0\0\0\0\0"
                                           "\0\0\0\0\0\0\xf0\x3f",
                                           24)));
}

TEST_F(Table, WritesARowOnlyIfItHasChanged) {
  table->put(1, row(5, "five"));
  database.execute("DELETE FROM things");  // behind the back of the table
  table->put(1, row(5, "five"));
  EXPECT_TRUE(content().empty());
  table->put(1, row(5, "six"));
  EXPECT_EQ(content().at(1), std::pair(std::int64_t{5}, std::string("six")));
  table->forget();
  database.execute("DELETE FROM things");
  table->put(1, row(5, "six"));
  EXPECT_EQ(content().size(), 1U);
}

TEST_F(Table, TakesTheKeysOfAnEarlierRun) {
  table->write(3, row(1, "a"));
  table->write(8, row(2, "b"));
  EXPECT_THAT(table->keep({}), ElementsAre());  // write() records nothing
  table->take_keys(database, "id things");
  EXPECT_THAT(table->keep({8, 9}), ElementsAre(3));
  EXPECT_EQ(content().size(), 1U);
  table->put(8, row(2, "b"));  // the content of a taken row is not known
  EXPECT_EQ(content().at(8).second, "b");
}

// A plain map takes the same steps.
TEST_F(Table, HasTheRowsOfAMapAfterAnySteps) {
  Random random(4);
  std::map<std::int64_t, std::pair<std::int64_t, std::string>> expected;
  for (int step = 0; step < 400; ++step) {
    const std::int64_t key = random.index(12), value = random.index(3);
    const int kind = random.index(12);
    if (kind < 9) {
      table->put(key, row(value, std::to_string(value)));
      expected[key] = {value, std::to_string(value)};
    } else if (kind < 11) {
      table->erase(key);
      expected.erase(key);
    } else {
      std::set<std::int64_t> keys;
      for (std::int64_t k = 0; k < 12; ++k)
        if (random.index(2) == 0) keys.insert(k);
      std::vector<std::int64_t> gone;
      for (const auto& [k, v] : expected)
        if (!keys.contains(k)) gone.push_back(k);
      EXPECT_EQ(table->keep(keys), gone);
      for (const std::int64_t k : gone) expected.erase(k);
    }
    if (step % 20 == 19) {
      ASSERT_EQ(content(), expected) << step;
    }
  }
  EXPECT_EQ(database.integer("SELECT count(*) FROM things WHERE checksum IS NOT "
                             "row_checksum(id, a, b)"),
            0);
}

class Schema : public ::testing::Test {
 protected:
  Schema() {
    database.execute("PRAGMA synchronous = OFF");
    create_map_tables(database);
  }
  test::TemporaryFolder dir;
  SqliteDatabase database{dir / "map.db", SqliteDatabase::Access::kCreate};
};

TEST_F(Schema, TheLastColumnOfEachTableIsItsChecksum) {
  std::vector<std::string> tables;
  SqliteRows rows(database, "sqlite_master", "name", "WHERE type = 'table'");
  while (rows.next()) tables.emplace_back(rows.text(0));
  EXPECT_FALSE(tables.empty());
  for (const std::string& name : tables) {
    EXPECT_EQ(database.columns(name).back(), "checksum") << name;
    EXPECT_EQ(database.integer("SELECT count(*) FROM " + name), 0) << name;
  }
}

TEST_F(Schema, KnowsItsOwnVersionsAndNoOthers) {
  EXPECT_NO_THROW(check_map_schema(database));
  upgrade_map_schema(database);  // does nothing
  EXPECT_NO_THROW(check_map_schema(database));
  for (const int version : {0, -1}) {
    database.execute("PRAGMA user_version = " + std::to_string(version));
    EXPECT_THAT(test::message_of([&] { check_map_schema(database); }),
                HasSubstr("schema " + std::to_string(version) + ", which does not exist"));
  }
}

TEST_F(Schema, ChecksumsCoverEveryColumnOfARow) {
  database.execute("INSERT INTO frame VALUES (4, 5, 6, 7, x'08', 9, 0.5, 'lost', 0)");
  EXPECT_THAT(test::message_of([&] { check_checksums(database); }), HasSubstr("frame, row 4"));
  update_checksums(database, "frame");
  EXPECT_NO_THROW(check_checksums(database));
  for (const std::string& column : database.columns("frame")) {
    database.execute("SAVEPOINT before; UPDATE frame SET " + column + " = 77");
    EXPECT_THAT(test::message_of([&] { check_checksums(database); }), HasSubstr("checksum"))
        << column;
    database.execute("ROLLBACK TO before; RELEASE before");
  }
  EXPECT_NO_THROW(check_checksums(database));
}

}  // namespace map_table_test
}  // namespace placegraph
