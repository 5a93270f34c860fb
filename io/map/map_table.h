#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/measurements/data_note.h>
#include <placegraph/io/map/map_blobs.h>
#include <placegraph/io/map/sqlite.h>

#include <bit>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace placegraph {

/// The values of a row, in the order of its columns behind the key.
class MapRow {
 public:
  MapRow& integer(std::int64_t value) { return put(value); }
  template <class Tag>
  MapRow& id(Id<Tag> id) {
    return put(id.value());
  }
  MapRow& real(double value) { return put(Real{value}); }
  MapRow& text(std::string_view value) { return put(Text{std::string(value)}); }
  MapRow& blob(std::string_view value) { return put(Blob{std::string(value)}); }
  MapRow& null() { return put(Null()); }
  /// Its cause, text, whether it doubts the scale, and advice.
  MapRow& note(const DataNote& note) {
    return text(to_string(note.cause)).text(note.text).integer(note.doubts_scale).text(note.advice);
  }
  MapRow& pose(const SE3& T) {
    std::string bytes;
    BlobWriter(bytes).pose(T);
    return blob(bytes);
  }
  template <class Matrix>
  MapRow& symmetric(const Matrix& matrix) {
    std::string bytes;
    BlobWriter(bytes).symmetric(matrix);
    return blob(bytes);
  }

  void bind(SqliteStatement& statement) const {
    for (const Value& value : values_)
      std::visit([&](const auto& v) { bind(statement, v); }, value);
  }
  bool operator==(const MapRow&) const = default;

 private:
  /// Equal if the bits are equal: NaN equals NaN, and -0 differs from 0.
  struct Real {
    double value;
    bool operator==(const Real& other) const {
      return std::bit_cast<std::uint64_t>(value) == std::bit_cast<std::uint64_t>(other.value);
    }
  };
  struct Text {
    std::string value;
    bool operator==(const Text&) const = default;
  };
  struct Blob {
    std::string value;
    bool operator==(const Blob&) const = default;
  };
  using Null = std::monostate;
  using Value = std::variant<Null, std::int64_t, Real, Text, Blob>;

  static void bind(SqliteStatement& statement, Null) { statement.null(); }
  static void bind(SqliteStatement& statement, std::int64_t value) { statement << value; }
  static void bind(SqliteStatement& statement, const Real& real) { statement << real.value; }
  static void bind(SqliteStatement& statement, const Text& text) { statement.text(text.value); }
  static void bind(SqliteStatement& statement, const Blob& blob) { statement.blob(blob.value); }
  MapRow& put(Value value) {
    values_.push_back(std::move(value));
    return *this;
  }
  std::vector<Value> values_;
};

/// A table with one whole number as its key, and the rows that have been written to it.
class MapTable {
 public:
  MapTable(SqliteDatabase& database, const std::string& name, const std::string& key, int columns)
      : put_(database, put_sql(name, columns)),
        erase_(database, "DELETE FROM " + name + " WHERE " + key + " = ?") {}

  /// Writes the row unless the table has it already.
  void put(std::int64_t key, const MapRow& row) {
    MapRow& written = written_[key];
    if (written == row) return;
    written = row;
    write(key, row);
  }
  /// Writes the row without recording it.
  void write(std::int64_t key, const MapRow& row) {
    put_ << key;
    row.bind(put_);
    put_.run();
  }
  void erase(std::int64_t key) {
    erase_ << key;
    erase_.run();
    written_.erase(key);
  }
  /// Records the existing keys without their content.
  void take_keys(SqliteDatabase& database, const std::string& sql) {
    SqliteRows rows(database, sql.substr(sql.find(' ') + 1), sql.substr(0, sql.find(' ')));
    while (rows.next()) written_[rows.integer(0)];
  }
  /// Erases the rows whose keys are not in `keys`, and returns the erased keys.
  std::vector<std::int64_t> keep(const std::set<std::int64_t>& keys) {
    std::vector<std::int64_t> gone;
    for (const auto& [key, row] : written_)
      if (!keys.count(key)) gone.push_back(key);
    for (const std::int64_t key : gone) erase(key);
    return gone;
  }
  void forget() { written_.clear(); }

  /// The last column of a table is the checksum of the others.
  static std::string put_sql(const std::string& name, int columns) {
    std::string values = "?1";
    for (int i = 2; i <= columns; ++i) values += ", ?" + std::to_string(i);
    return "INSERT OR REPLACE INTO " + name + " VALUES (" + values + ", row_checksum(" + values +
           "))";
  }

 private:
  SqliteStatement put_, erase_;
  std::map<std::int64_t, MapRow> written_;
};

}  // namespace placegraph
