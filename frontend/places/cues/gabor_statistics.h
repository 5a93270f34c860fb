#pragma once
#include <placegraph/frontend/places/cues/cue_grid.h>
#include <placegraph/graph/image/image.h>

namespace placegraph {

struct GaborOptions {
  int cells = 4;  ///< number of columns and of rows, for any shape of the image
  int scales = 4, orientations = 6;
  /// Wavelength of the finest scale in an image 80 pixels wide; scales differ by a root of 2.
  double wavelength_px = 4;
};

/// Texture: statistics of the responses of a bank of Gabor filters (orientation x scale) in each
/// cell.
///
/// They are the logarithms of the mean and of the deviation of the magnitude, each minus its mean
/// over cells and orientations of one scale. This removes brightness, contrast and the spectrum
/// that all images share. Filters have round Gaussian envelopes, so that they are products of a row
/// and a column; coarser scales use a smaller image. Grey image, 8 bits (ArgumentError otherwise).
CueGrid gabor_cue(const Image& grey, const GaborOptions& options = {});

}  // namespace placegraph
