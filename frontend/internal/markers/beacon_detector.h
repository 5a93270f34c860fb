#pragma once
#include <placegraph/frontend/internal/markers/marker_options.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/image/image.h>

#include <Eigen/Core>
#include <vector>

namespace placegraph {

/// A bright spot in an image.
struct BeaconObservation {
  Eigen::Vector2d px = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Identity();  ///< px^2
  double area_px = 0;                                        ///< above half of its contrast
};

/// Bright round spots on darker ground, brightest surroundings excluded: the centre of what is
/// above half of the spot's contrast, each pixel with its grey value above that. Where the sensor
/// saturates and the spot blooms, all pixels inside count the same and its rim decides. Covariance:
/// that of the centre under the noise of the pixels, the rim's share where it is cut by whole
/// pixels. Largest first. CV_8UC1, else ArgumentError.
std::vector<BeaconObservation> detect_beacons(const Image& grey,
                                              const BeaconDetectorOptions& options = {});

}  // namespace placegraph
