#pragma once
#include <placegraph/backend/factors/factor.h>
#include <placegraph/backend/window/window_variable.h>

#include <memory>
#include <vector>

namespace placegraph {

/// A measurement between variables of a sliding window.
/// It consists of a factor of backend/factors and its variables, in the order in which the factor
/// takes them. The window does not distinguish kinds of measurements: it evaluates the factor,
/// marginalizes it with the first of its variables that leaves, and transforms it to another frame
/// or scale by Factor::transformed. So a new kind of measurement needs only a factor with
/// `transformed` and a caller. Unlike a std::variant of the known kinds, virtual functions also
/// admit factors of applications that embed the library.
struct WindowFactor {
  /// The information of the measurement about the scale. It is declared, not derived from the
  /// Jacobians: a motion of full rank without translation and a length of zero measure the scale,
  /// too.
  enum class Length {
    kNone,      ///< none: rotations and directions
    kMeasured,  ///< measures the scale: a distance, a measured plane, a motion of full rank
    kPosition,  ///< a position in the map: two positions determine the scale
    kHeight,    ///< a height above a plane: determines the scale if three points are on the plane
  };

  std::shared_ptr<const Factor> factor;
  std::vector<WindowVariable> variables;
  bool robust = true;  ///< whether the window's Huber kernel is applied
  Length length = Length::kNone;
};

bool touches(const WindowFactor& factor, const WindowVariable& variable);

/// Throws ArgumentError, whose text begins with `name`, if the measurement is invalid.
/// Invalid are: no factor, variables that are not of its kinds or repeat, a factor without
/// `transformed`.
void check(const WindowFactor& factor, const std::string& name);

/// The same measurement in another frame and scale of the map.
/// Its residual at the transformed variables is that of `factor` at the old ones. See
/// Factor::transformed.
WindowFactor transformed(const WindowFactor& factor, const Sim3& S_new_old);

}  // namespace placegraph
