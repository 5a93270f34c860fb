#pragma once
#include <placegraph/backend/factors/variable.h>
#include <placegraph/graph/core/ids.h>

#include <compare>
#include <cstdint>
#include <string>

namespace placegraph {

/// A variable of a sliding window that measurements connect.
/// It is a keyframe's pose T_map_cam, a plane of the map or the rotation R_map_manhattan of a
/// Manhattan frame. (Points and lines, which only cameras observe, are treated separately.)
struct WindowVariable {
  enum class Kind { kKeyframe, kPlane, kManhattanFrame };
  Kind kind = Kind::kKeyframe;
  std::int64_t id = 0;  ///< number among the variables of its kind
  auto operator<=>(const WindowVariable&) const = default;

  /// The id of a variable of that kind.
  KeyframeId keyframe() const { return KeyframeId(id); }
  PlaneId plane() const { return PlaneId(id); }
  ManhattanFrameId manhattan_frame() const { return ManhattanFrameId(id); }
};

inline WindowVariable keyframe_variable(KeyframeId id) {
  return {WindowVariable::Kind::kKeyframe, id.value()};
}
inline WindowVariable plane_variable(PlaneId id) {
  return {WindowVariable::Kind::kPlane, id.value()};
}
inline WindowVariable manhattan_variable(ManhattanFrameId id) {
  return {WindowVariable::Kind::kManhattanFrame, id.value()};
}

/// Number of directions in which a variable can move: its columns in the normal equations.
inline int degrees_of_freedom(const WindowVariable& variable) {
  return variable.kind == WindowVariable::Kind::kKeyframe ? 6 : 3;
}

/// The name of a variable in messages: "keyframe 3".
inline std::string to_string(const WindowVariable& variable) {
  const char* const names[] = {"keyframe ", "plane ", "Manhattan frame "};
  return names[static_cast<int>(variable.kind)] + std::to_string(variable.id);
}

/// The index of the variable's type (SE3, Plane3 or SO3) among the alternatives of Variable.
inline std::size_t factor_kind(const WindowVariable& variable) {
  switch (variable.kind) {
    case WindowVariable::Kind::kPlane:
      return Variable(std::in_place_type<Plane3>).index();
    case WindowVariable::Kind::kManhattanFrame:
      return Variable(std::in_place_type<SO3>).index();
    default:
      return Variable(std::in_place_type<SE3>).index();
  }
}

}  // namespace placegraph
