#pragma once
#include <placegraph/frontend/internal/places/cues/cue_grid.h>
#include <placegraph/graph/image/image.h>

namespace placegraph {

struct GaborOptions {
  int cells = 4;  ///< columns and rows, whatever the shape of the image
  int scales = 4, orientations = 6;
  double wavelength_px = 4;  ///< of the finest scale in the image at 80 pixels; a root of 2 apart
};

/// Texture: how much a bank of Gabor filters (orientation x scale) answers in every cell, as the
/// logarithms of the mean and of the deviation of the magnitude, each less its mean over cells and
/// orientations of one scale: brightness and contrast play no part, nor the spectrum that all
/// images share. Filters have round Gaussian envelopes, so that they are products of a row and a
/// column; coarser scales see a smaller image. Grey image of 8 bits (ArgumentError otherwise).
CueGrid gabor_cue(const Image& grey, const GaborOptions& options = {});

}  // namespace placegraph
