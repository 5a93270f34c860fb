#pragma once
#include <placegraph/frontend/internal/flow/point_tracker.h>
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/image/frame.h>
#include <placegraph/graph/measurements/data_note.h>

#include <map>
#include <optional>
#include <vector>

namespace placegraph {

/// Inverse depths of one pixel: by two views of the image, and by the depth image.
struct TwoInverseDepths {
  double from_views = 0;  ///< in an arbitrary unit
  double sigma = 0;       ///< standard deviation of from_views
  double measured = 0;    ///< [1/m]
};

/// Share of the spread of the inverse depths from views that the measured ones leave unexplained,
/// in medians of absolute errors: about 0 if they agree up to a factor, about 1 if a constant depth
/// fits as well. Nothing if there are fewer than forty, or if the spread is less than three
/// standard deviations.
std::optional<double> unexplained_share(const std::vector<TwoInverseDepths>& depths);

/// Finds depth images that do not belong to the images: of another time, mirrored, constant. The
/// relative pose and the points of two views a few frames apart, which the depths do not enter, are
/// compared with the depth image of the first view.
class DepthAgreement {
 public:
  explicit DepthAgreement(const Calibration& calibration);

  void add(const Frame& frame);
  /// Adds the unexplained share of a pair of views.
  void add(double unexplained);
  /// Reports depths that explain less than half of the spread in most of at least three pairs.
  std::optional<DataNote> note() const;

 private:
  void begin(const Frame& frame);
  std::optional<std::vector<TwoInverseDepths>> compare() const;

  Calibration calibration_;
  std::optional<PointTracker> tracker_;  // from the first view on
  std::map<LandmarkId, Eigen::Vector2d> px_first_;
  Image depth_first_;
  int frames_ = 0;  // since the first view, or since the last pair
  std::vector<double> pairs_;
};

}  // namespace placegraph
