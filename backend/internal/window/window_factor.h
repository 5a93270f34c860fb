#pragma once
#include <placegraph/backend/factors/factor.h>
#include <placegraph/backend/internal/window/window_variable.h>

#include <memory>
#include <vector>

namespace placegraph {

/// A measurement between variables of a sliding window: a factor of backend/factors and the
/// variables that it stands between, in the order in which the factor takes them. The window knows
/// no kinds of measurements beyond this: it evaluates the factor, marginalizes it with the first of
/// its variables that leaves, and asks Factor::transformed what it becomes in another frame or unit
/// of length. So a new kind is a factor with `transformed` and a caller, and a virtual function
/// does what a std::variant of the known kinds could not: take a factor of somebody who embeds the
/// library.
struct WindowFactor {
  /// What the measurement says of the unit of length. Declared, not found from the derivatives: a
  /// motion of full rank without translation and a length of zero measure the unit too.
  enum class Length {
    kNone,      ///< nothing, as rotations and directions
    kMeasured,  ///< it gives the unit: a distance, a measured plane, a motion of full rank
    kPosition,  ///< a position in the map: two positions give the unit
    kHeight,    ///< a height above a plane: it gives the unit if three points lie on the plane
  };

  std::shared_ptr<const Factor> factor;
  std::vector<WindowVariable> variables;
  bool robust = true;  ///< under the window's Huber kernel
  Length length = Length::kNone;
};

bool touches(const WindowFactor& factor, const WindowVariable& variable);

/// Throws ArgumentError, whose text begins with `name`, if there is no factor, if the variables are
/// not of its kinds or repeat, or if it does not say what it becomes in another frame.
void check(const WindowFactor& factor, const std::string& name);

/// The same measurement where the map's frame and its unit of length are others: its residual at
/// the transformed variables is that of `factor` at the old ones. See Factor::transformed.
WindowFactor transformed(const WindowFactor& factor, const Sim3& S_new_old);

}  // namespace placegraph
