#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/parallel.h>
#include <placegraph/io/map/sqlite.h>
#include <sqlite3.h>
#include <zlib.h>

#include <cmath>
#include <filesystem>
#include <utility>

namespace placegraph {
namespace {

constexpr int kBusyTimeoutMs = 200;  // for another program that has the file

/// Adds type, length and bytes of a value to a CRC-32.
uLong add_to_checksum(uLong crc, sqlite3_value* value) {
  const int type = sqlite3_value_type(value);
  const auto add = [&](const void* bytes, std::size_t size) {
    crc = crc32_z(crc, static_cast<const Bytef*>(bytes), size);
  };
  const auto kind = static_cast<std::uint8_t>(type);
  add(&kind, sizeof(kind));
  if (type == SQLITE_INTEGER) {
    const std::int64_t number = sqlite3_value_int64(value);
    add(&number, sizeof(number));
  } else if (type == SQLITE_FLOAT) {
    const double number = sqlite3_value_double(value);
    add(&number, sizeof(number));
  } else if (type != SQLITE_NULL) {
    const void* bytes = type == SQLITE_TEXT ? sqlite3_value_text(value) : sqlite3_value_blob(value);
    const auto size = static_cast<std::uint64_t>(sqlite3_value_bytes(value));
    add(&size, sizeof(size));
    if (size > 0) add(bytes, size);
  }
  return crc;
}

void row_checksum(sqlite3_context* context, int count, sqlite3_value** values) {
  uLong crc = crc32_z(0, nullptr, 0);
  for (int i = 0; i < count; ++i) crc = add_to_checksum(crc, values[i]);
  sqlite3_result_int64(context, static_cast<std::int64_t>(crc));
}

void add_functions(sqlite3* database) {
  sqlite3_create_function(database, "row_checksum", -1,
                          SQLITE_UTF8 | SQLITE_DETERMINISTIC | SQLITE_INNOCUOUS, nullptr,
                          row_checksum, nullptr, nullptr);
}

}  // namespace

SqliteDatabase::SqliteDatabase(const std::string& path, Access access) : path_(path) {
  const bool is_file = std::filesystem::is_regular_file(path);
  if (access != Access::kCreate && !is_file)
    throw FileError(path, std::filesystem::is_directory(path) ? "is a folder, no file"
                                                              : "there is no such file");
  const int write = SQLITE_OPEN_READWRITE;
  const int flags = access == Access::kCreate ? write | SQLITE_OPEN_CREATE : write;
  int code = sqlite3_open_v2(path.c_str(), &handle_, flags, nullptr);
  if (code != SQLITE_OK && access == Access::kRead) {
    sqlite3_close(handle_);
    code = sqlite3_open_v2(path.c_str(), &handle_, SQLITE_OPEN_READONLY, nullptr);
  }
  if (code != SQLITE_OK) {
    const std::string message = handle_ ? sqlite3_errmsg(handle_) : "out of memory";
    sqlite3_close(handle_);
    throw FileError(path, "cannot be opened: " + message);
  }
  sqlite3_busy_timeout(handle_, kBusyTimeoutMs);
  add_functions(handle_);
}

SqliteDatabase::SqliteDatabase(std::string path, sqlite3* handle)
    : path_(std::move(path)), handle_(handle) {
  add_functions(handle_);
}

std::unique_ptr<SqliteDatabase> SqliteDatabase::copy_in_memory() {
  sqlite3* memory = nullptr;
  if (sqlite3_open(":memory:", &memory) != SQLITE_OK) {
    sqlite3_close(memory);
    throw FileError(path_, "cannot be copied: out of memory");
  }
  std::unique_ptr<SqliteDatabase> copy(new SqliteDatabase(path_, memory));
  sqlite3_backup* backup = sqlite3_backup_init(memory, "main", handle_, "main");
  const bool done = backup && sqlite3_backup_step(backup, -1) == SQLITE_DONE;
  sqlite3_backup_finish(backup);
  if (!done) fail("copying it");
  return copy;
}

SqliteDatabase::~SqliteDatabase() { sqlite3_close(handle_); }

void SqliteDatabase::fail(const std::string& doing) const {
  switch (sqlite3_errcode(handle_)) {
    case SQLITE_NOTADB:
      throw FileError(path_, "is no saved map: it is no SQLite database");
    case SQLITE_BUSY:
      throw FileError(path_, "another program is using it");
    case SQLITE_CORRUPT:
      throw FileError(path_, "is damaged or cut off (" + doing + ")");
    default:
      throw FileError(path_, doing + ": " + sqlite3_errmsg(handle_));
  }
}

void SqliteDatabase::execute(const std::string& sql) {
  if (sqlite3_exec(handle_, sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK)
    fail(sql.substr(0, sql.find('(')));
}

void SqliteDatabase::merge_log() {
  const int code = sqlite3_exec(handle_, "PRAGMA journal_mode = DELETE", nullptr, nullptr, nullptr);
  if (code != SQLITE_OK && code != SQLITE_CORRUPT && code != SQLITE_NOTADB)
    fail("moving its log into it");
}

std::int64_t SqliteDatabase::integer(const std::string& sql) {
  SqliteStatement statement(*this, sql);
  return statement.next() ? sqlite3_column_int64(statement.handle(), 0) : 0;
}

std::string SqliteDatabase::text(const std::string& sql) {
  SqliteStatement statement(*this, sql);
  if (!statement.next()) return {};
  const auto* text = sqlite3_column_text(statement.handle(), 0);
  return text ? reinterpret_cast<const char*>(text) : "";
}

std::vector<std::string> SqliteDatabase::columns(const std::string& table) {
  SqliteStatement statement(*this,
                            "SELECT name FROM pragma_table_info('" + table + "') ORDER BY cid");
  std::vector<std::string> names;
  while (statement.next())
    names.emplace_back(reinterpret_cast<const char*>(sqlite3_column_text(statement.handle(), 0)));
  return names;
}

SqliteStatement::SqliteStatement(SqliteDatabase& database, const std::string& sql)
    : database_(database) {
  if (sqlite3_prepare_v3(database.handle(), sql.c_str(), -1, SQLITE_PREPARE_PERSISTENT, &handle_,
                         nullptr) != SQLITE_OK)
    database.fail("reading its tables");
}

SqliteStatement::~SqliteStatement() { sqlite3_finalize(handle_); }

SqliteStatement& SqliteStatement::operator<<(std::int64_t value) {
  sqlite3_bind_int64(handle_, ++bound_, value);
  return *this;
}

SqliteStatement& SqliteStatement::operator<<(double value) {
  sqlite3_bind_double(handle_, ++bound_, value);
  return *this;
}

SqliteStatement& SqliteStatement::text(std::string_view value) {
  sqlite3_bind_text(handle_, ++bound_, value.data(), static_cast<int>(value.size()),
                    SQLITE_TRANSIENT);
  return *this;
}

SqliteStatement& SqliteStatement::blob(std::string_view bytes) {
  sqlite3_bind_blob64(handle_, ++bound_, bytes.data(), bytes.size(), SQLITE_STATIC);
  return *this;
}

SqliteStatement& SqliteStatement::null() {
  sqlite3_bind_null(handle_, ++bound_);
  return *this;
}

void SqliteStatement::run() {
  while (next()) {
  }
  sqlite3_clear_bindings(handle_);
  bound_ = 0;
}

bool SqliteStatement::next() {
  check_interruption();
  const int code = sqlite3_step(handle_);
  if (code == SQLITE_ROW) return true;
  if (code != SQLITE_DONE) database_.fail("reading or writing");
  sqlite3_reset(handle_);
  return false;
}

SqliteRows::SqliteRows(SqliteDatabase& database, const std::string& table,
                       const std::string& columns, const std::string& rest)
    : database_(database),
      table_(table),
      statement_(database, "SELECT " + columns + " FROM " + table + " " + rest) {}

void SqliteRows::refuse(const std::string& what) const {
  const auto* number = sqlite3_column_text(statement_.handle(), 0);
  const std::string row = number ? reinterpret_cast<const char*>(number) : "NULL";
  throw FileError(database_.path(), "table " + table_ + ", row " + row + ": " + what);
}

void SqliteRows::refuse(int column, const std::string& what) const {
  refuse(std::string(sqlite3_column_name(statement_.handle(), column)) + " " + what);
}

bool SqliteRows::is_null(int column) const {
  return sqlite3_column_type(statement_.handle(), column) == SQLITE_NULL;
}

std::int64_t SqliteRows::integer(int column, std::int64_t min, std::int64_t max) const {
  if (sqlite3_column_type(statement_.handle(), column) != SQLITE_INTEGER)
    refuse(column, is_null(column) ? "is missing" : "is no whole number");
  const std::int64_t value = sqlite3_column_int64(statement_.handle(), column);
  if (value < min || value > max) refuse(column, "is out of range: " + std::to_string(value));
  return value;
}

double SqliteRows::real(int column) const {
  const int type = sqlite3_column_type(statement_.handle(), column);
  if (type == SQLITE_NULL) refuse(column, "is missing or not a number");
  if (type != SQLITE_FLOAT && type != SQLITE_INTEGER) refuse(column, "is no number");
  const double value = sqlite3_column_double(statement_.handle(), column);
  if (!std::isfinite(value)) refuse(column, "is not finite");
  return value;
}

double SqliteRows::positive(int column) const {
  const double value = real(column);
  if (!(value > 0)) refuse(column, "must be positive: " + std::to_string(value));
  return value;
}

std::string_view SqliteRows::text(int column) const {
  if (sqlite3_column_type(statement_.handle(), column) != SQLITE_TEXT) refuse(column, "is no text");
  const auto* data = sqlite3_column_text(statement_.handle(), column);
  return {reinterpret_cast<const char*>(data),
          static_cast<std::size_t>(sqlite3_column_bytes(statement_.handle(), column))};
}

std::string_view SqliteRows::blob(int column) const {
  if (sqlite3_column_type(statement_.handle(), column) != SQLITE_BLOB)
    refuse(column, is_null(column) ? "is missing" : "is no blob");
  const auto* data = static_cast<const char*>(sqlite3_column_blob(statement_.handle(), column));
  return {data, static_cast<std::size_t>(sqlite3_column_bytes(statement_.handle(), column))};
}

std::string_view SqliteRows::blob(int column, std::size_t bytes) const {
  const std::string_view value = blob(column);
  if (value.size() != bytes)
    refuse(column,
           "has " + std::to_string(value.size()) + " bytes instead of " + std::to_string(bytes));
  return value;
}

}  // namespace placegraph
