#pragma once
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/geometry/se3.h>

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <cstring>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace placegraph {

/// The state of objects as bytes, so that a resumed run goes on with what it knew. A class lists
/// the members that are its state once, for writing and for reading:
///
///     void visit_state(auto& archive) { archive(count_, windows_); }
///
/// For a type of another folder a function visit_state(archive, object) does it. Numbers are
/// little-endian, lists begin with their length.
template <class Derived>
class StateArchive {
 public:
  void operator()(auto&... values) { (visit(values), ...); }

 private:
  Derived& derived() { return static_cast<Derived&>(*this); }

  template <class T>
  void visit(T& value) {
    if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>)
      derived().bytes(&value, sizeof(value));
    else if constexpr (requires { value.visit_state(derived()); })
      value.visit_state(derived());
    else
      visit_state(derived(), value);
  }
  template <class Tag>
  void visit(Id<Tag>& id) {
    std::int64_t value = id.value();
    visit(value);
    id = Id<Tag>(value);
  }
  template <class Scalar, int kRows, int kCols, int kOptions, int kMaxRows, int kMaxCols>
  void visit(Eigen::Matrix<Scalar, kRows, kCols, kOptions, kMaxRows, kMaxCols>& matrix) {
    std::int64_t rows = matrix.rows(), cols = matrix.cols();
    if constexpr (kRows == Eigen::Dynamic) visit(rows), derived().require_left(rows);
    if constexpr (kCols == Eigen::Dynamic) visit(cols), derived().require_left(cols);
    if constexpr (kRows == Eigen::Dynamic && kCols == Eigen::Dynamic)
      derived().require_left(rows * cols);
    matrix.resize(rows, cols);
    for (Eigen::Index i = 0; i < matrix.size(); ++i) visit(matrix.data()[i]);
  }
  void visit(SO3& rotation) {
    Eigen::Vector4d q = rotation.quaternion().coeffs();
    visit(q);
    rotation = SO3(Eigen::Quaterniond(q));
  }
  void visit(SE3& pose) {
    SO3 rotation = pose.rotation();
    Eigen::Vector3d translation = pose.translation();
    (*this)(rotation, translation);
    pose = SE3(rotation, translation);
  }
  template <class T>
  void visit(std::optional<T>& value) {
    std::uint8_t known = value.has_value();
    visit(known);
    if (known == 0) {
      value.reset();
      return;
    }
    // Not emplace(): Clang knows only behind a class that a class inside it has a default
    // constructor.
    if (!value) value = T{};
    visit(*value);
  }
  template <class A, class B>
  void visit(std::pair<A, B>& pair) {
    (*this)(pair.first, pair.second);
  }
  template <class T, std::size_t kSize>
  void visit(std::array<T, kSize>& list) {
    for (T& value : list) visit(value);
  }
  template <class T>
  void visit(std::vector<T>& list) {
    auto size = static_cast<std::int64_t>(list.size());
    visit(size);
    derived().require_left(size);
    list.resize(static_cast<std::size_t>(size));
    for (T& value : list) visit(value);
  }
  template <class Key, class T>
  void visit(std::map<Key, T>& map) {
    std::vector<std::pair<Key, T>> entries(map.begin(), map.end());
    visit(entries);
    if constexpr (Derived::kReads) map = {entries.begin(), entries.end()};
  }
};

/// Writes states.
class StateWriter : public StateArchive<StateWriter> {
 public:
  static constexpr bool kReads = false;
  void bytes(const void* value, std::size_t size) {
    bytes_.append(static_cast<const char*>(value), size);
  }
  void require_left(std::int64_t) const {}
  const std::string& written() const { return bytes_; }

 private:
  std::string bytes_;
};

/// Reads states in the order in which they were written. Throws ArgumentError where the bytes end
/// too early or a length is impossible.
class StateReader : public StateArchive<StateReader> {
 public:
  static constexpr bool kReads = true;
  explicit StateReader(std::string_view bytes) : bytes_(bytes) {}
  void bytes(void* value, std::size_t size) {
    require_left(static_cast<std::int64_t>(size));
    std::memcpy(value, bytes_.data(), size);
    bytes_.remove_prefix(size);
  }
  /// Throws unless at least so many bytes are left, before memory is allocated.
  void require_left(std::int64_t size) const {
    require(size >= 0 && static_cast<std::uint64_t>(size) <= bytes_.size(),
            "the saved state of a run is cut off");
  }
  /// Throws unless all bytes have been read.
  void end() const { require(bytes_.empty(), "the saved state of a run is too long"); }

 private:
  std::string_view bytes_;
};

}  // namespace placegraph
