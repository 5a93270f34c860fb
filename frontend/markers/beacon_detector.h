#pragma once
#include <placegraph/frontend/markers/marker_options.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/image/image.h>

#include <Eigen/Core>
#include <vector>

namespace placegraph {

/// A bright spot in an image.
struct BeaconObservation {
  Eigen::Vector2d px = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Identity();  ///< [px^2]
  double area_px = 0;                                        ///< area above half of its contrast
};

/// Detects bright round spots on darker background, largest first.
///
/// The position is the centre of the pixels above half of the spot's contrast, each weighted by its
/// grey value above that. Where the sensor saturates and the spot blooms, all pixels inside have
/// the same weight and its rim determines the position. The covariance is that of the centre under
/// the noise of the pixels, with the discretization of the rim by whole pixels. CV_8UC1, else
/// ArgumentError.
std::vector<BeaconObservation> detect_beacons(const Image& grey,
                                              const BeaconDetectorOptions& options = {});

}  // namespace placegraph
