#pragma once
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

struct sqlite3;
struct sqlite3_stmt;

namespace placegraph {

/// An open SQLite database. Every failure is a FileError that names the file.
/// Its statements can use the function row_checksum(value, ...): the CRC-32 of all values.
class SqliteDatabase {
 public:
  enum class Access { kRead, kWrite, kCreate };
  SqliteDatabase(const std::string& path, Access access);
  ~SqliteDatabase();
  SqliteDatabase(const SqliteDatabase&) = delete;
  SqliteDatabase& operator=(const SqliteDatabase&) = delete;

  /// A copy in memory, which no other program sees.
  std::unique_ptr<SqliteDatabase> copy_in_memory();
  /// One or more statements without results.
  void execute(const std::string& sql);
  /// Moves the write-ahead log into the file; does nothing if the file is damaged or no database.
  void merge_log();
  /// The first column of a pragma's first row.
  std::int64_t integer(const std::string& sql);
  std::string text(const std::string& sql);
  /// Names of the columns of a table, in its order.
  std::vector<std::string> columns(const std::string& table);
  [[noreturn]] void fail(const std::string& doing) const;
  const std::string& path() const { return path_; }
  sqlite3* handle() const { return handle_; }

 private:
  SqliteDatabase(std::string path, sqlite3* handle);

  std::string path_;
  sqlite3* handle_ = nullptr;
};

/// A prepared statement: bind its parameters in order, then run it.
class SqliteStatement {
 public:
  SqliteStatement(SqliteDatabase& database, const std::string& sql);
  ~SqliteStatement();
  SqliteStatement(const SqliteStatement&) = delete;
  SqliteStatement& operator=(const SqliteStatement&) = delete;

  SqliteStatement& operator<<(std::int64_t value);
  SqliteStatement& operator<<(double value);  ///< not a number becomes NULL
  SqliteStatement& text(std::string_view value);
  /// Binds bytes that must remain valid until run().
  SqliteStatement& blob(std::string_view bytes);
  SqliteStatement& null();
  /// Runs the statement to its end; it can then be bound again.
  void run();
  /// Advances to the next row of a query.
  bool next();
  sqlite3_stmt* handle() const { return handle_; }

 private:
  SqliteDatabase& database_;
  sqlite3_stmt* handle_ = nullptr;
  int bound_ = 0;
};

/// The rows of a table, checked as they are read: a value of another type, out of range or not
/// finite is a FileError with file, table and row, which is named by its first column.
class SqliteRows {
 public:
  /// `columns`: names, the row's number first; `rest`: e.g. "ORDER BY id".
  SqliteRows(SqliteDatabase& database, const std::string& table, const std::string& columns,
             const std::string& rest = "ORDER BY 1");
  bool next() { return statement_.next(); }

  bool is_null(int column) const;
  std::int64_t integer(int column, std::int64_t min = std::numeric_limits<std::int64_t>::min(),
                       std::int64_t max = std::numeric_limits<std::int64_t>::max()) const;
  double real(int column) const;  ///< finite
  double positive(int column) const;
  std::string_view text(int column) const;  ///< valid until the next row
  std::string_view blob(int column) const;  ///< valid until the next row
  /// A blob of exactly this many bytes.
  std::string_view blob(int column, std::size_t bytes) const;
  [[noreturn]] void refuse(const std::string& what) const;

 private:
  [[noreturn]] void refuse(int column, const std::string& what) const;

  SqliteDatabase& database_;
  std::string table_;
  SqliteStatement statement_;
};

}  // namespace placegraph
