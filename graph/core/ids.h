#pragma once
#include <compare>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <ostream>
#include <string>

namespace [[gnu::visibility("default")]] placegraph {

/// The number of an object of one kind; ids of different kinds cannot be mixed or compared.
/// `Tag` is an incomplete type that names the kind, as below. No id means "none": an
/// id that may be missing is a std::optional. Files store ids as integers.
template <class Tag>
class Id {
 public:
  /// The id 0.
  constexpr Id() = default;
  /// The id with the given number, which must be an integer.
  template <std::integral Integer>
    requires(!std::same_as<Integer, bool>)
  constexpr explicit Id(Integer value) : value_(static_cast<std::int64_t>(value)) {}

  /// The number: for files, messages, and arithmetic on positions in a sequence.
  [[nodiscard]] constexpr std::int64_t value() const { return value_; }

  /// Increments the id, for code that numbers its own objects.
  constexpr Id& operator++() {
    ++value_;
    return *this;
  }
  /// Increments the id and returns its previous value.
  constexpr Id operator++(int) {
    const Id before = *this;
    ++value_;
    return before;
  }

  /// Ids of one kind compare by their numbers.
  friend constexpr bool operator==(Id, Id) = default;
  friend constexpr auto operator<=>(Id, Id) = default;

  /// The number as text, for messages.
  friend std::string to_string(Id id) { return std::to_string(id.value_); }
  /// Writes the number.
  friend std::ostream& operator<<(std::ostream& out, Id id) { return out << id.value_; }

  /// Writes the number; nlohmann::json finds this function by argument-dependent lookup.
  template <class Json>
  friend void to_json(Json& json, Id id) {
    json = id.value_;
  }
  /// Reads the number; throws the exception of nlohmann::json if the value is not a number.
  template <class Json>
  friend void from_json(const Json& json, Id& id) {
    id.value_ = json.template get<std::int64_t>();
  }

  /// An id below all others of the kind, as a bound of ranges.
  static constexpr Id lowest() { return Id(std::numeric_limits<std::int64_t>::min()); }
  /// An id above all others of the kind, as a bound of ranges.
  static constexpr Id highest() { return Id(std::numeric_limits<std::int64_t>::max()); }

 private:
  std::int64_t value_ = 0;
};

/// A frame: its position in the sequence or folder of images that it was read from.
using FrameId = Id<struct FrameTag>;

/// A keyframe. Keyframes are numbered in the order of their frames, over all components of a map.
/// A segment of a place is identified by its first keyframe, the anchor keyframe.
using KeyframeId = Id<struct KeyframeTag>;

/// A topological place: a node of the place graph.
using PlaceId = Id<struct PlaceTag>;

/// A point of the scene. The track of its observations in the images has the same id.
using LandmarkId = Id<struct LandmarkTag>;

/// A straight line of the scene. The track of its edges in the images has the same id.
using LineId = Id<struct LineTag>;

/// A plane of the scene.
using PlaneId = Id<struct PlaneTag>;

/// A Manhattan frame: three orthogonal directions that many edges of the scene are parallel to.
using ManhattanFrameId = Id<struct ManhattanFrameTag>;

/// A vertex of a pose graph: a pose or a point landmark. Ids may be any integers.
using NodeId = Id<struct NodeTag>;

}  // namespace placegraph

/// Hashes an id as its number.
template <class Tag>
struct std::hash<placegraph::Id<Tag>> {
  std::size_t operator()(placegraph::Id<Tag> id) const noexcept {
    return std::hash<std::int64_t>()(id.value());
  }
};
