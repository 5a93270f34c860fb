#pragma once
#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// The distance of the two poses of a relative error.
struct Delta {
  enum class Unit {
    kFrames,   ///< judged frames
    kSeconds,  ///< time
    kMetres,   ///< length of the true path
    kDegrees,  ///< rotation accumulated along the true path
  };
  double value = 1;           ///< positive; whole for kFrames
  Unit unit = Unit::kFrames;  ///< unit of the value

  bool operator==(const Delta&) const = default;
};

/// Which pairs of poses relative errors are taken of.
enum class StepPairs {
  kConsecutive,  ///< every step begins where the one before ends
  kAll,          ///< a step begins at every pose
};

/// Reads "10f", "1s", "5m", "10deg" or "0.2rad"; a whole number alone counts frames.
///
/// Throws ArgumentError if the text is none of these or the value is not positive.
Delta parse_delta(const std::string& text);
/// Reads deltas joined by commas. Throws as parse_delta.
std::vector<Delta> parse_deltas(const std::string& text);

/// The delta as parse_delta reads it: "10f", "1s", "5m", "10deg".
std::string to_string(const Delta& delta);
/// Deltas joined by commas, as parse_deltas reads them.
std::string to_string(const std::vector<Delta>& deltas);
/// The delta in words: "10 frames", "1 s", "5 m", "10 deg".
std::string text_of(const Delta& delta);

}  // namespace placegraph
