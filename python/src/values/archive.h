#pragma once
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/geometry/line3.h>
#include <placegraph/graph/geometry/plane3.h>
#include <placegraph/graph/geometry/se2.h>
#include <placegraph/graph/geometry/sim3.h>

#include <array>
#include <bit>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <cstring>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "python/src/values/members.h"

namespace placegraph::python {

/// Writes the numbers of a value as bytes, in the byte order of the machine.
class Writer {
 public:
  static constexpr bool kReads = false;
  /// What the bytes are for: to be read again, or to be compared. Compared ones have one NaN and
  /// one zero, so that equal bytes are equal values.
  enum class Use { kStored, kCompared };

  explicit Writer(Use use) : use_(use) {}
  std::string take() { return std::move(bytes_); }

  template <class Number>
  void number(const Number& value) {
    if constexpr (std::is_floating_point_v<Number>) {
      if (use_ == Use::kCompared) {
        append(std::isnan(value) ? std::numeric_limits<Number>::quiet_NaN()
                                 : value + Number(0));  // -0 + 0 is 0
        return;
      }
    }
    append(value);
  }
  /// The number of elements that follow.
  std::size_t count(std::size_t size) {
    append(static_cast<std::uint64_t>(size));
    return size;
  }
  void text(const std::string& value) {
    count(value.size());
    bytes_ += value;
  }

 private:
  template <class Number>
  void append(const Number& value) {
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof(value));
  }
  Use use_;
  std::string bytes_;
};

/// Reads what a Writer wrote to be stored; throws ArgumentError where the bytes end too early.
class Reader {
 public:
  static constexpr bool kReads = true;
  explicit Reader(std::string_view bytes) : rest_(bytes) {}
  bool at_end() const { return rest_.empty(); }

  template <class Number>
  void number(Number& value) {
    require(rest_.size() >= sizeof(value), kDamaged);
    std::memcpy(&value, rest_.data(), sizeof(value));
    rest_.remove_prefix(sizeof(value));
  }
  std::size_t count(std::size_t) {
    std::uint64_t size = 0;
    number(size);
    require(size <= rest_.size(), kDamaged);  // an element has one byte at least
    return static_cast<std::size_t>(size);
  }
  void text(std::string& value) {
    const std::size_t size = count(0);
    value = rest_.substr(0, size);
    rest_.remove_prefix(size);
  }

  static constexpr const char* kDamaged = "pickle: it is damaged";

 private:
  std::string_view rest_;
};

// ---- pass(archive, value) writes a value with a Writer, and replaces it with a Reader ----

template <class Archive, class Number>
  requires std::is_arithmetic_v<Number> || std::is_enum_v<Number>
void pass(Archive& archive, Number& value) {
  archive.number(value);
}

template <class Archive>
void pass(Archive& archive, std::string& value) {
  archive.text(value);
}

template <class Archive, class Tag>
void pass(Archive& archive, Id<Tag>& id) {
  std::int64_t number = id.value();
  archive.number(number);
  if constexpr (Archive::kReads) id = Id<Tag>(number);
}

template <class Archive, class T>
void pass(Archive& archive, std::vector<T>& values) {
  const std::size_t size = archive.count(values.size());
  if constexpr (Archive::kReads) values.resize(size);
  for (T& value : values) pass(archive, value);
}

template <class Archive, class T, std::size_t size>
void pass(Archive& archive, std::array<T, size>& values) {
  for (T& value : values) pass(archive, value);
}

template <class Archive, class First, class Second>
void pass(Archive& archive, std::pair<First, Second>& value) {
  pass(archive, value.first);
  pass(archive, value.second);
}

template <class Archive, class Key, class T>
void pass(Archive& archive, std::map<Key, T>& values) {
  const std::size_t size = archive.count(values.size());
  if constexpr (Archive::kReads) {
    values.clear();
    for (std::size_t i = 0; i < size; ++i) {
      Key key;
      pass(archive, key);
      pass(archive, values[key]);
    }
  } else {
    for (auto& [key, value] : values) {
      Key copy = key;
      pass(archive, copy);
      pass(archive, value);
    }
  }
}

template <class Archive, class T>
void pass(Archive& archive, std::optional<T>& value) {
  bool present = value.has_value();
  archive.number(present);
  if constexpr (Archive::kReads) {
    value.reset();
    if (present) value.emplace();
  }
  if (present) pass(archive, *value);
}

template <class Archive, class... T>
void pass(Archive& archive, std::variant<T...>& value) {
  auto index = static_cast<std::uint8_t>(value.index());
  archive.number(index);
  if constexpr (Archive::kReads) {
    require(index < sizeof...(T), Reader::kDamaged);
    std::uint8_t i = 0;
    ((i++ == index ? static_cast<void>(value.template emplace<T>()) : static_cast<void>(0)), ...);
  }
  std::visit([&](auto& kind) { pass(archive, kind); }, value);
}

template <class Archive, class Scalar, int rows, int columns, int options, int most_rows,
          int most_columns>
void pass(Archive& archive,
          Eigen::Matrix<Scalar, rows, columns, options, most_rows, most_columns>& matrix) {
  Eigen::Index shape[2] = {matrix.rows(), matrix.cols()};
  if constexpr (rows == Eigen::Dynamic || columns == Eigen::Dynamic) {
    archive.number(shape);
    if constexpr (Archive::kReads) {
      const auto fits = [](Eigen::Index size, int fixed, int most) {
        return fixed == Eigen::Dynamic
                   ? size >= 0 && size < (1 << 20) && (most == Eigen::Dynamic || size <= most)
                   : size == fixed;
      };
      require(fits(shape[0], rows, most_rows) && fits(shape[1], columns, most_columns),
              Reader::kDamaged);
      matrix.resize(shape[0], shape[1]);
    }
  }
  for (Eigen::Index i = 0; i < matrix.size(); ++i) archive.number(matrix.data()[i]);
}

template <class Archive>
void pass(Archive& archive, Eigen::Isometry3d& T) {
  pass(archive, T.matrix());
}

template <class Archive>
void pass(Archive& archive, SO2& R) {
  // Cosine and sine: by way of the angle they would be rounded.
  auto parts = std::bit_cast<std::array<double, 2>>(R);
  pass(archive, parts);
  if constexpr (Archive::kReads) R = std::bit_cast<SO2>(parts);
}

template <class Archive>
void pass(Archive& archive, SO3& R) {
  Eigen::Vector4d parts = R.quaternion().coeffs();
  pass(archive, parts);
  if constexpr (Archive::kReads) R = SO3(Eigen::Quaterniond(parts));
}

/// Passes copies of the parts of a value, and makes the value of them with a Reader.
template <class Archive, class T, class... Part>
void pass_parts(Archive& archive, T& value, Part... parts) {
  (pass(archive, parts), ...);
  if constexpr (Archive::kReads) value = T(parts...);
}

template <class Archive>
void pass(Archive& archive, SE2& T) {
  pass_parts(archive, T, T.rotation(), T.translation());
}

template <class Archive>
void pass(Archive& archive, SE3& T) {
  pass_parts(archive, T, T.rotation(), T.translation());
}

template <class Archive>
void pass(Archive& archive, Sim3& S) {
  pass_parts(archive, S, S.rotation(), S.translation(), S.scale());
}

template <class Archive>
void pass(Archive& archive, Line3& line) {
  pass_parts(archive, line, line.U(), line.angle());
}

template <class Archive>
void pass(Archive& archive, Plane3& plane) {
  pass_parts(archive, plane, plane.quaternion());
}

template <class Archive, class Struct>
  requires std::is_aggregate_v<Struct>
void pass(Archive& archive, Struct& value) {
  visit_members(value, [&](auto&... members) { (pass(archive, members), ...); });
}

/// The bytes of a value.
template <class T>
std::string bytes_of(const T& value, Writer::Use use) {
  Writer writer(use);
  pass(writer, const_cast<T&>(value));  // a Writer changes nothing
  return writer.take();
}

/// The value of bytes that were written to be stored; throws ArgumentError if they are damaged.
template <class T>
T value_of(std::string_view bytes) {
  Reader reader(bytes);
  T value;
  pass(reader, value);
  require(reader.at_end(), Reader::kDamaged);
  return value;
}

}  // namespace placegraph::python
