#pragma once
#include <placegraph/backend/factor_graph/factor_graph_options.h>
#include <placegraph/graph/core/outcome.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// The result of adjusting a COLMAP model.
struct ColmapAdjustmentReport {
  Outcome outcome;               ///< too few data, not converged; see ColmapAdjustment::adjust
  std::size_t observations = 0;  ///< number of observations
  double cost_initial = 0;       ///< half the initial sum of rho(squared error [px^2])
  double cost_final = 0;         ///< that of the estimate
  double error_before_px = 0;    ///< initial mean reprojection error, without the kernel
  double error_px = 0;           ///< that of the estimate
  int iterations = 0;            ///< number of steps of Levenberg-Marquardt
};

/// The cameras that no image of a model has, as "2 cameras that no image has: 3, 5".
/// Of many the first ids are named.
std::string describe_unused_cameras(const std::vector<std::uint32_t>& ids);

/// Bundle adjustment of a COLMAP model in a folder.
class ColmapAdjustment {
 public:
  /// Reads a model, in binary or text form, all images of which have one camera.
  ///
  /// Cameras that no image has are kept as they are. Throws FileError.
  explicit ColmapAdjustment(const std::string& folder);
  ~ColmapAdjustment();

  /// Number of images of the model.
  std::size_t images() const;
  /// Number of points of the model.
  std::size_t points() const;
  /// Ids of the cameras that no image has, in the order of the file.
  std::vector<std::uint32_t> unused_cameras() const;
  /// Adjusts the poses and points of the model; its camera is held.
  ///
  /// It minimizes the reprojection errors, each with a standard deviation of 1 px. They do not
  /// determine position, orientation and scale of the model, which stay near the initial ones.
  /// Throws ArgumentError for options out of range. Outcomes: too few data (no observations; the
  /// model remains as it was), not converged (the model is the last estimate).
  [[nodiscard]] ColmapAdjustmentReport adjust(const BundleOptions& options);
  /// Writes cameras, images and points3D in the form of the model that was read.
  ///
  /// Files of the other form are removed from the folder, as are rigs and frames there, which have
  /// poses of their own. Throws FileError.
  void write(const std::string& folder) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace placegraph
