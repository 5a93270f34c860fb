#pragma once

namespace [[gnu::visibility("default")]] placegraph {

/// The solver of the optimization: the library's own solver or Ceres.
enum class PoseGraphEngine { kNative, kCeres };

/// Step rule of the native engine; Ceres always uses Levenberg-Marquardt.
enum class StepRule { kDogleg, kGaussNewton, kLevenbergMarquardt };

}  // namespace placegraph
