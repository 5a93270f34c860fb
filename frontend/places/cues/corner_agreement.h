#pragma once
#include <placegraph/frontend/places/cues/place_cue_options.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/image/image.h>
#include <placegraph/graph/measurements/landmark.h>

#include <vector>

namespace placegraph {

/// Harris corners of a pyramid with rotated binary descriptors (Rublee et al. 2011).
///
/// The pixel coordinates are those of the image at `width_px`.
std::vector<Feature> corners_of_view(const Image& grey, const CornerAgreementOptions& options);

/// Number of mutually best matches of two views that agree with one similarity of the image plane.
///
/// The similarity is the best of those that each match proposes by its orientations and octaves, so
/// that there is no random choice. The tolerance admits views of one place from half a metre apart.
int corner_agreement(const std::vector<Feature>& a, const std::vector<Feature>& b,
                     const CornerAgreementOptions& options);

}  // namespace placegraph
