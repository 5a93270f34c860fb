#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/random.h>
#include <placegraph/io/map/sqlite.h>

#include <algorithm>
#include <filesystem>
#include <limits>

#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace placegraph {
namespace sqlite_test {

using Access = SqliteDatabase::Access;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;

class Sqlite : public ::testing::Test {
 protected:
  Sqlite() {
    database.execute("PRAGMA synchronous = OFF");
    database.text("PRAGMA journal_mode = MEMORY");
  }
  /// The rows of the table, at the first of them.
  SqliteRows first_row(const std::string& columns, const std::string& rest = "ORDER BY 1") {
    return {database, "things", columns, rest};
  }
  test::TemporaryFolder dir;
  const std::string path = dir / "some.db";
  SqliteDatabase database{path, Access::kCreate};
};

class SqliteThings : public Sqlite {
 protected:
  SqliteThings() { database.execute("CREATE TABLE things (id INTEGER PRIMARY KEY, value)"); }
  /// The message of `read` for a row whose value is this expression.
  template <class Read>
  std::string refusal(const std::string& value, const Read& read) {
    database.execute("INSERT OR REPLACE INTO things VALUES (7, " + value + ")");
    SqliteRows rows = first_row("id, value");
    EXPECT_TRUE(rows.next());
    return test::message_of([&] { (void)read(rows); });
  }
};

TEST_F(Sqlite, OpensOnlyFilesThatExistUnlessItCreatesThem) {
  for (const Access access : {Access::kRead, Access::kWrite}) {
    EXPECT_THAT(test::message_of([&] { SqliteDatabase(dir / "none.db", access); }),
                EndsWith("none.db: there is no such file"));
    EXPECT_THAT(test::message_of([&] { SqliteDatabase(dir.path(), access); }),
                HasSubstr("is a folder, no file"));
  }
  EXPECT_FALSE(std::filesystem::exists(dir / "none.db"));
  EXPECT_EQ(database.path(), path);
}

TEST_F(Sqlite, NamesTheFileAndTheFailure) {
  EXPECT_THAT(test::message_of([&] { database.execute("DROP TABLE none"); }),
              AllOf(HasSubstr("some.db: "), HasSubstr("no such table: none")));
  EXPECT_THAT(test::message_of([&] { SqliteStatement(database, "SELECT a FROM none"); }),
              AllOf(HasSubstr("some.db: reading its tables"), HasSubstr("no such table: none")));
}

TEST_F(Sqlite, ListsColumnsInTheOrderOfTheTable) {
  database.execute("CREATE TABLE t (zebra INTEGER, ant TEXT, mole BLOB)");
  EXPECT_THAT(database.columns("t"), ElementsAre("zebra", "ant", "mole"));
  EXPECT_THAT(database.columns("none"), ElementsAre());
  EXPECT_EQ(database.integer("SELECT 41 + 1"), 42);
  EXPECT_EQ(database.text("SELECT 'a' || 'b'"), "ab");
  EXPECT_EQ(database.integer("SELECT zebra FROM t"), 0);  // no row
  EXPECT_EQ(database.text("SELECT ant FROM t"), "");
}

TEST_F(SqliteThings, ValuesOfEveryKindComeBack) {
  const std::string bytes("\0a\xff\0", 4);
  SqliteStatement put(database, "INSERT INTO things VALUES (?, ?)");
  (put << std::int64_t{1} << std::numeric_limits<std::int64_t>::min()).run();
  (put << std::int64_t{2} << 0.1).run();
  (put << std::int64_t{3}).text("ein 'Wort'").run();
  (put << std::int64_t{4}).blob(bytes).run();
  (put << std::int64_t{5}).null().run();
  (put << std::int64_t{6} << std::numeric_limits<double>::quiet_NaN()).run();
  SqliteRows rows = first_row("id, value");
  ASSERT_TRUE(rows.next());
  EXPECT_EQ(rows.integer(1), std::numeric_limits<std::int64_t>::min());
  ASSERT_TRUE(rows.next());
  EXPECT_EQ(rows.real(1), 0.1);
  ASSERT_TRUE(rows.next());
  EXPECT_EQ(rows.text(1), "ein 'Wort'");
  ASSERT_TRUE(rows.next());
  EXPECT_EQ(rows.blob(1), bytes);
  EXPECT_EQ(rows.blob(1, 4), bytes);
  EXPECT_FALSE(rows.is_null(1));
  for (int i = 0; i < 2; ++i) {  // what is no number is NULL
    ASSERT_TRUE(rows.next());
    EXPECT_TRUE(rows.is_null(1));
  }
  EXPECT_FALSE(rows.next());
}

TEST_F(SqliteThings, RowsComeInTheOrderOfTheFirstColumn) {
  Random random(3);
  std::vector<int> order;
  random.sample(1000, 200, order);
  SqliteStatement put(database, "INSERT INTO things VALUES (?, ?)");
  std::reverse(order.begin(), order.end());
  for (const int id : order) (put << std::int64_t{id} << 0.5 * id).run();
  std::ranges::sort(order);
  SqliteRows rows = first_row("id, value");
  for (const int id : order) {
    ASSERT_TRUE(rows.next());
    EXPECT_EQ(rows.integer(0), id);
    EXPECT_EQ(rows.real(1), 0.5 * id);
  }
  EXPECT_FALSE(rows.next());
}

TEST_F(SqliteThings, AValueOfAnotherTypeIsRefusedWithTableRowAndColumn) {
  const auto integer = [](SqliteRows& rows) { return rows.integer(1); };
  const auto real = [](SqliteRows& rows) { return rows.real(1); };
  const auto text = [](SqliteRows& rows) { return rows.text(1); };
  const auto blob = [](SqliteRows& rows) { return rows.blob(1); };
  const std::string where = "some.db: table things, row 7: value ";
  EXPECT_THAT(refusal("1.5", integer), EndsWith(where + "is no whole number"));
  EXPECT_THAT(refusal("NULL", integer), EndsWith(where + "is missing"));
  EXPECT_THAT(refusal("'1'", real), EndsWith(where + "is no number"));
  EXPECT_THAT(refusal("NULL", real), EndsWith(where + "is missing or not a number"));
  EXPECT_THAT(refusal("-9e999", real), EndsWith(where + "is not finite"));
  EXPECT_THAT(refusal("x'00'", text), EndsWith(where + "is no text"));
  EXPECT_THAT(refusal("'a'", blob), EndsWith(where + "is no blob"));
  EXPECT_THAT(refusal("x'0102'", [](SqliteRows& rows) { return rows.blob(1, 3); }),
              EndsWith(where + "has 2 bytes instead of 3"));
}

TEST_F(SqliteThings, BoundsOfARangeBelongToIt) {
  const auto in_range = [](SqliteRows& rows) { return rows.integer(1, -2, 5); };
  EXPECT_THAT(refusal("6", in_range), EndsWith("value is out of range: 6"));
  EXPECT_THAT(refusal("-3", in_range), EndsWith("value is out of range: -3"));
  const auto positive = [](SqliteRows& rows) { return rows.positive(1); };
  EXPECT_THAT(refusal("0", positive), HasSubstr("must be positive"));
  EXPECT_THAT(refusal("-0.5", positive), HasSubstr("must be positive"));
  database.execute("DELETE FROM things; INSERT INTO things VALUES (1, 5), (2, -2), (3, 4)");
  SqliteRows rows = first_row("id, value");
  ASSERT_TRUE(rows.next());
  EXPECT_EQ(rows.integer(1, -2, 5), 5);
  ASSERT_TRUE(rows.next());
  EXPECT_EQ(rows.integer(1, -2, 5), -2);
  ASSERT_TRUE(rows.next());
  EXPECT_EQ(rows.positive(1), 4.0);  // a whole number is a number
}

TEST_F(SqliteThings, ACopyInMemoryIsIndependentOfTheFile) {
  database.execute("INSERT INTO things VALUES (1, 'old')");
  const auto copy = database.copy_in_memory();
  copy->execute("UPDATE things SET value = 'new'");
  EXPECT_EQ(copy->text("SELECT value FROM things"), "new");
  EXPECT_EQ(database.text("SELECT value FROM things"), "old");
  database.execute("DELETE FROM things");
  EXPECT_EQ(copy->integer("SELECT count(*) FROM things"), 1);
  EXPECT_EQ(copy->path(), path);  // for messages
  EXPECT_NE(copy->integer("SELECT row_checksum(1)"), 0);
}

/// CRC-32 bit by bit, by its definition.
std::uint32_t crc32_of(const std::string& bytes) {
  std::uint32_t crc = 0xffffffffU;
  for (const char c : bytes) {
    crc ^= static_cast<std::uint8_t>(c);
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1U) != 0 ? 0xedb88320U : 0U);
  }
  return ~crc;
}

template <class Number>
std::string bytes_of(Number value) {
  return {reinterpret_cast<const char*>(&value), sizeof(value)};
}

// Every value is its type in SQLite (1 to 5: integer, real, text, blob, NULL), the length of a text
// or blob in 8 bytes, and its bytes.
TEST_F(Sqlite, AChecksumIsTheCrcOfTypesLengthsAndBytes) {
  const auto checksum = [&](const std::string& values) {
    return database.integer("SELECT row_checksum(" + values + ")");
  };
  EXPECT_EQ(crc32_of("123456789"), 0xcbf43926U);  // the check value of CRC-32
  EXPECT_EQ(checksum("-3"), crc32_of("\1" + bytes_of(std::int64_t{-3})));
  EXPECT_EQ(checksum("0.25"), crc32_of("\2" + bytes_of(0.25)));
  EXPECT_EQ(checksum("'abc'"), crc32_of("\3" + bytes_of(std::uint64_t{3}) + "abc"));
  EXPECT_EQ(checksum("x'00ff'"),
            crc32_of("\4" + bytes_of(std::uint64_t{2}) + std::string("\0\xff", 2)));
  EXPECT_EQ(checksum("NULL"), crc32_of("\5"));
  EXPECT_EQ(checksum("1, 'a', NULL"), crc32_of("\1" + bytes_of(std::int64_t{1}) + "\3" +
                                               bytes_of(std::uint64_t{1}) + "a\5"));
  EXPECT_EQ(database.integer("SELECT count(*) FROM (SELECT row_checksum('ab', 'c') UNION SELECT "
                             "row_checksum('a', 'bc') UNION SELECT row_checksum('abc', '') UNION "
                             "SELECT row_checksum('abc', NULL) UNION SELECT row_checksum('abc'))"),
            5);
}

}  // namespace sqlite_test
}  // namespace placegraph
