#pragma once
#include <placegraph/backend/factors/variable.h>
#include <placegraph/graph/core/ids.h>

#include <compare>
#include <cstdint>
#include <string>

namespace placegraph {

/// A variable of a sliding window that measurements stand between: a keyframe's pose T_map_cam, a
/// plane of the map, the rotation R_map_manhattan of a rectangular world. (Points and lines, which
/// cameras alone observe, have a path of their own.)
struct WindowVariable {
  enum class Kind { kKeyframe, kPlane, kManhattanFrame };
  Kind kind = Kind::kKeyframe;
  std::int64_t id = 0;  ///< its number among those of its kind
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

/// Number of directions in which it can move: columns that it has in the normal equations.
inline int degrees_of_freedom(const WindowVariable& variable) {
  return variable.kind == WindowVariable::Kind::kKeyframe ? 6 : 3;
}

/// "keyframe 3": for messages.
inline std::string to_string(const WindowVariable& variable) {
  const char* const names[] = {"keyframe ", "plane ", "world "};
  return names[static_cast<int>(variable.kind)] + std::to_string(variable.id);
}

/// What a factor takes for it: the index of SE3, Plane3 or SO3 among the alternatives of Variable.
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
