#include <fmt/format.h>
#include <fmt/ranges.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/files/npy_array.h>
#include <placegraph/io/files/little_endian.h>
#include <placegraph/io/files/text_file.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <optional>
#include <ranges>
#include <string_view>

namespace placegraph {
namespace {

// The format: numpy.lib.format, versions 1.0, 2.0 and 3.0.
constexpr std::string_view kNpyMagic = "\x93NUMPY";
constexpr std::size_t kNpyAlignment = 64;  ///< the numbers begin at a multiple of it

/// What follows a key of the header, a dictionary of Python; nothing if the key is not there.
std::optional<std::string_view> npy_value(std::string_view header, const std::string& key) {
  for (const char quote : {'\'', '"'}) {
    const std::size_t at = header.find(quote + key + quote);
    if (at == std::string_view::npos) continue;
    std::size_t begin = header.find(':', at + key.size() + 2);
    if (begin == std::string_view::npos) return std::nullopt;
    begin = header.find_first_not_of(' ', begin + 1);
    if (begin == std::string_view::npos) return std::nullopt;
    return header.substr(begin);
  }
  return std::nullopt;
}

/// The sizes of "(3, 4), ..."; nothing if it is no such list.
std::optional<std::vector<std::size_t>> npy_shape(std::string_view text) {
  const std::size_t end = text.find(')');
  if (!text.starts_with('(') || end == std::string_view::npos) return std::nullopt;
  std::vector<std::size_t> shape;
  std::vector<std::string_view> fields;
  split_comma(text.substr(1, end - 1), fields);
  for (const std::string_view field : fields) {
    if (field.empty()) continue;  // behind the comma of a list, "(3,)"
    std::size_t size = 0;
    const auto [stop, error] = std::from_chars(field.data(), field.data() + field.size(), size);
    if (error != std::errc() || stop != field.data() + field.size()) return std::nullopt;
    shape.push_back(size);
  }
  return shape;
}

template <class Number>
std::vector<double> npy_numbers(std::string_view bytes) {
  std::vector<double> values(bytes.size() / sizeof(Number));
  for (std::size_t i = 0; i < values.size(); ++i) {
    Number number;
    std::memcpy(&number, bytes.data() + i * sizeof number, sizeof number);
    values[i] = static_cast<double>(number);
  }
  return values;
}

/// A type of numbers by its name in the header.
struct NumberType {
  std::string_view name;
  std::size_t size;  ///< [bytes]
  std::vector<double> (*read)(std::string_view);
};

constexpr std::array kNumberTypes = {NumberType{"<f8", 8, npy_numbers<double>},
                                     NumberType{"<f4", 4, npy_numbers<float>},
                                     NumberType{"<i8", 8, npy_numbers<std::int64_t>},
                                     NumberType{"<i4", 4, npy_numbers<std::int32_t>},
                                     NumberType{"<i2", 2, npy_numbers<std::int16_t>},
                                     NumberType{"|i1", 1, npy_numbers<std::int8_t>},
                                     NumberType{"<u8", 8, npy_numbers<std::uint64_t>},
                                     NumberType{"<u4", 4, npy_numbers<std::uint32_t>},
                                     NumberType{"<u2", 2, npy_numbers<std::uint16_t>},
                                     NumberType{"|u1", 1, npy_numbers<std::uint8_t>},
                                     NumberType{"|b1", 1, npy_numbers<std::uint8_t>}};

/// The type that the header's `descr` names, in quotes.
const NumberType& number_type(std::string_view descr, const std::string& what) {
  const std::string_view quoted = descr.substr(0, descr.find_first_of(",}"));
  for (const NumberType& type : kNumberTypes)
    if (quoted.substr(1, 3) == type.name && quoted.size() >= 5) return type;
  if (quoted.substr(1).starts_with("|O"))
    throw FileError(what,
                    "has objects of Python, which only unpickling could read: save numbers alone");
  throw FileError(what, fmt::format("has numbers of type {}, known are {}", quoted,
                                    fmt::join(kNumberTypes | std::views::transform(&NumberType::name), ", ")));
}

/// The header of a file and what follows it.
struct NpyParts {
  std::string_view header, numbers;
};

NpyParts npy_parts(const std::string& bytes, const std::string& what) {
  const auto byte = [&](std::size_t at) {
    return static_cast<std::size_t>(static_cast<unsigned char>(bytes[at]));
  };
  if (!bytes.starts_with(kNpyMagic) || bytes.size() < 12)
    throw FileError(what, "is no .npy file of numpy");
  const std::size_t version = byte(6);
  if (version < 1 || version > 3)
    throw FileError(what, fmt::format("is a .npy file of version {}, known are 1 to 3", version));
  const std::size_t begin = version == 1 ? 10 : 12;
  std::size_t length = byte(8) + 256 * byte(9);
  if (version > 1) length += 65536 * byte(10) + 16777216 * byte(11);
  if (length > bytes.size() - begin) throw FileError(what, "its header is cut short");
  const std::string_view all = bytes;
  return {all.substr(begin, length), all.substr(begin + length)};
}

}  // namespace

NpyArray read_npy(const std::string& bytes, const std::string& what) {
  const NpyParts parts = npy_parts(bytes, what);
  const auto type = npy_value(parts.header, "descr"),
             order = npy_value(parts.header, "fortran_order"),
             sizes = npy_value(parts.header, "shape");
  if (!type || !order || !sizes)
    throw FileError(what, "its header has no descr, fortran_order or shape");
  const auto shape = npy_shape(*sizes);
  if (!shape) throw FileError(what, "its shape is no list of sizes");
  if (shape->size() > 2)
    throw FileError(what, fmt::format("has {} dimensions, at most 2 are read", shape->size()));
  NpyArray array{*shape, {}};
  const NumberType& number = number_type(*type, what);
  const std::size_t size = number.size;
  std::size_t left = parts.numbers.size() / size;
  bool fits = parts.numbers.size() % size == 0;
  for (const std::size_t each : *shape) {
    fits = fits && (each == 0 || left % each == 0);
    left = each == 0 ? left : left / each;
  }
  const bool empty = std::ranges::count(*shape, std::size_t{0}) > 0;
  if (!fits || left != (empty ? 0 : 1))
    throw FileError(what, fmt::format("has {} bytes of numbers, which is not its shape ({})",
                                      parts.numbers.size(), fmt::join(*shape, ", ")));
  array.values = number.read(parts.numbers);
  if (order->starts_with("True") && shape->size() == 2) {
    const std::size_t rows = (*shape)[0], columns = (*shape)[1];
    const std::vector<double> by_column = array.values;
    for (std::size_t i = 0; i < by_column.size(); ++i)
      array.values[i % rows * columns + i / rows] = by_column[i];
  }
  return array;
}

std::string to_npy(const NpyArray& array) {
  std::size_t count = 1;
  std::string shape;
  for (const std::size_t size : array.shape) {
    count *= size;
    shape += fmt::format("{}, ", size);
  }
  require(count == array.values.size(), "npy: the number of values is not that of the shape");
  if (array.shape.size() > 1) shape.resize(shape.size() - 2);
  if (array.shape.size() == 1) shape.pop_back();
  std::string header =
      fmt::format("{{'descr': '<f8', 'fortran_order': False, 'shape': ({}), }}", shape);
  const std::size_t before = kNpyMagic.size() + 4;
  header.resize(
      (before + header.size() + 1 + kNpyAlignment - 1) / kNpyAlignment * kNpyAlignment - before - 1,
      ' ');
  header += '\n';
  std::string bytes(kNpyMagic);
  append_number(bytes, std::uint8_t{1});
  append_number(bytes, std::uint8_t{0});
  append_number(bytes, static_cast<std::uint16_t>(header.size()));
  bytes += header;
  for (const double value : array.values) append_number(bytes, value);
  return bytes;
}

}  // namespace placegraph
