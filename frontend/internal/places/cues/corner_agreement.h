#pragma once
#include <placegraph/frontend/places/recognition_options.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/image/image.h>
#include <placegraph/graph/landmark.h>

#include <vector>

namespace placegraph {

/// Harris corners of a pyramid with rotated binary descriptors (Rublee et al. 2011), their pixels
/// those of the image at `width_px`.
std::vector<Feature> corners_of_view(const Image& grey, const CornerAgreementOptions& options);

/// How many mutually best matches of two views follow one similarity of the image plane, the best
/// of those that every match by its orientations and octaves proposes: no chance in it. It is loose
/// enough for views of one place from half a metre apart.
int corner_agreement(const std::vector<Feature>& a, const std::vector<Feature>& b,
                     const CornerAgreementOptions& options);

}  // namespace placegraph
