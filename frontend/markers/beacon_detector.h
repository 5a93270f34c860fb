#pragma once
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/image/image.h>

#include <Eigen/Core>
#include <vector>

namespace placegraph {

struct BeaconDetectorOptions {
  double min_grey = 200;     ///< of a spot's brightest pixel
  double min_contrast = 80;  ///< of that over what surrounds the spot, grey levels
  double min_area_px = 2;    ///< above half of that contrast
  double max_area_px = 900;
  double min_roundness = 0.6;  ///< the spot's shorter axis over its longer
  double min_sigma_px = 0.05;  ///< of a spot: no better, whatever the grey values say
  void check() const { check_ranges(*this); }
};
void visit(OptionVisitor& field, BeaconDetectorOptions& options);

/// A bright spot in an image.
struct BeaconSighting {
  Eigen::Vector2d px = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Identity();  ///< px^2
  double area_px = 0;                                        ///< above half of its contrast
};

/// Bright round spots on darker ground, brightest surroundings excluded: the centre of what is
/// above half of the spot's contrast, each pixel with its grey value above that. Where the sensor
/// saturates and the spot blooms, all pixels inside count the same and its rim decides. Covariance:
/// that of the centre under the noise of the pixels, the rim's share where it is cut by whole
/// pixels. Largest first. CV_8UC1, else ArgumentError.
std::vector<BeaconSighting> detect_beacons(const Image& grey,
                                           const BeaconDetectorOptions& options = {});

}  // namespace placegraph
