#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/files/file_bytes.h>
#include <placegraph/io/files/npy_array.h>
#include <placegraph/io/loops/delimited_table.h>
#include <placegraph/io/loops/number_matrix.h>

#include <utility>

namespace placegraph {
namespace {

NumberMatrix read_npy_matrix(const std::string& path) {
  NpyArray array = read_npy(read_bytes(path), path);
  NumberMatrix matrix;
  matrix.rows = array.shape.empty() ? 1 : array.shape[0];
  matrix.columns = array.shape.size() < 2 ? 1 : array.shape[1];
  matrix.values = std::move(array.values);
  return matrix;
}

}  // namespace

bool is_npy(const std::string& path) { return path.ends_with(".npy"); }

NumberMatrix read_number_matrix(const std::string& path) {
  NumberMatrix matrix;
  if (is_npy(path)) {
    matrix = read_npy_matrix(path);
  } else {
    DelimitedTable table(path);
    std::vector<std::string_view> fields;
    while (table.next(fields)) {
      if (matrix.rows++ == 0) matrix.columns = fields.size();
      if (fields.size() != matrix.columns)
        table.file().fail(fmt::format("{} columns, and {} in the rows before", fields.size(),
                                      matrix.columns));
      for (const std::string_view field : fields)
        matrix.values.push_back(table.file().number_or_nan(field, "value"));
    }
  }
  if (matrix.values.empty()) throw FileError(path, "has no numbers");
  return matrix;
}

}  // namespace placegraph
