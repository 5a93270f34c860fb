#pragma once
#include <placegraph/io/map/map_blobs.h>
#include <placegraph/io/map/sqlite.h>

#include <cstring>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace placegraph {

/// The values of a row, as bytes that can be compared.
class MapRow {
 public:
  MapRow& integer(std::int64_t value) { return put('i', &value, sizeof(value)); }
  MapRow& real(double value) { return put('d', &value, sizeof(value)); }
  MapRow& text(std::string_view value) { return put('t', value.data(), value.size()); }
  MapRow& blob(std::string_view value) { return put('b', value.data(), value.size()); }
  MapRow& null() { return put('n', nullptr, 0); }
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

  const std::string& bytes() const { return bytes_; }
  void bind(SqliteStatement& statement) const {
    for (std::size_t at = 0; at < bytes_.size();) {
      const char type = bytes_[at];
      std::size_t size = 0;
      std::memcpy(&size, bytes_.data() + at + 1, sizeof(size));
      const char* data = bytes_.data() + at + 1 + sizeof(size);
      at += 1 + sizeof(size) + size;
      if (type == 'i') statement << as<std::int64_t>(data);
      if (type == 'd') statement << as<double>(data);
      if (type == 't') statement.text({data, size});
      if (type == 'b') statement.blob({data, size});
      if (type == 'n') statement.null();
    }
  }

 private:
  MapRow& put(char type, const void* data, std::size_t size) {
    bytes_ += type;
    bytes_.append(reinterpret_cast<const char*>(&size), sizeof(size));
    if (size > 0) bytes_.append(static_cast<const char*>(data), size);
    return *this;
  }
  template <class Number>
  static Number as(const char* data) {
    Number value;
    std::memcpy(&value, data, sizeof(value));
    return value;
  }
  std::string bytes_;
};

/// A table with one whole number as its key, and what has been written to it.
class MapTable {
 public:
  MapTable(SqliteDatabase& database, const std::string& name, const std::string& key, int columns)
      : put_(database, put_sql(name, columns)),
        erase_(database, "DELETE FROM " + name + " WHERE " + key + " = ?") {}

  /// Writes the row unless it stands there already.
  void put(std::int64_t key, const MapRow& row) {
    std::string& written = written_[key];
    if (written == row.bytes()) return;
    written = row.bytes();
    write(key, row);
  }
  /// Without remembering what was written.
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
  /// Rows that are there, whatever they say.
  void take_keys(SqliteDatabase& database, const std::string& sql) {
    SqliteRows rows(database, sql.substr(sql.find(' ') + 1), sql.substr(0, sql.find(' ')));
    while (rows.next()) written_[rows.integer(0)];
  }
  /// Erases what is not among `keys`, and says what that was.
  std::vector<std::int64_t> keep(const std::set<std::int64_t>& keys) {
    std::vector<std::int64_t> gone;
    for (const auto& [key, row] : written_)
      if (!keys.count(key)) gone.push_back(key);
    for (const std::int64_t key : gone) erase(key);
    return gone;
  }
  void forget() { written_.clear(); }

 private:
  static std::string put_sql(const std::string& name, int columns) {
    std::string sql = "INSERT OR REPLACE INTO " + name + " VALUES (?";
    for (int i = 1; i < columns; ++i) sql += ", ?";
    return sql + ")";
  }
  SqliteStatement put_, erase_;
  std::map<std::int64_t, std::string> written_;
};

}  // namespace placegraph
