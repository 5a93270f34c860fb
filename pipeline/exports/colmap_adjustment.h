#pragma once
#include <placegraph/backend/factor_graph/factor_graph_options.h>
#include <placegraph/graph/core/outcome.h>

#include <cstddef>
#include <memory>
#include <string>

namespace [[gnu::visibility("default")]] placegraph {

/// What an adjustment of a COLMAP model came to.
struct ColmapAdjustmentReport {
  Outcome outcome;               ///< kTooFewData: no observations; kNotConverged
  std::size_t images = 0;        ///< images of the model
  std::size_t points = 0;        ///< its points
  std::size_t observations = 0;  ///< number of observations
  double cost_initial = 0;       ///< half the sum of rho(squared error [px^2]) before
  double cost_final = 0;         ///< the same behind
  double error_before_px = 0;    ///< mean reprojection error before, without the kernel
  double error_px = 0;           ///< the same behind
  int iterations = 0;            ///< number of steps of Levenberg-Marquardt
};

/// Bundle adjustment of the poses and points of a COLMAP model in a folder.
/// Its cameras are held, as `placegraph graph bundle` of a folder does it.
class ColmapAdjustment {
 public:
  /// Reads the model, in text or binary form, with any lens. Throws FileError.
  explicit ColmapAdjustment(std::string folder);
  ~ColmapAdjustment();
  ColmapAdjustment(const ColmapAdjustment&) = delete;
  ColmapAdjustment& operator=(const ColmapAdjustment&) = delete;
  /// Minimizes the reprojection errors, each with a standard deviation of 1 px.
  /// They do not determine position, orientation and scale of the model, which stay near the
  /// initial ones. Throws ArgumentError for options out of range.
  ColmapAdjustmentReport adjust(const BundleOptions& options);
  /// Writes the adjusted model into a folder, in the form in which it was read.
  /// Files of the other form there are removed. Throws FileError.
  void write(const std::string& folder) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace placegraph
