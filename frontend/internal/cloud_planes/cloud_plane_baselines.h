#pragma once
#include <placegraph/frontend/internal/cloud_planes/cloud_planes_options.h>
#include <placegraph/frontend/internal/cloud_planes/cloud_points.h>
#include <placegraph/frontend/internal/cloud_planes/plane_labels.h>

namespace placegraph {

// Both are methods of CloudPlanesOptions, so that a caller can hold the cuts against them on data
// of his own. Of 264 planes of depth images with 2 mm of noise the cuts find 198 in 21 ms an image,
// RANSAC 155 in 352 ms, region growing 35 in 56 ms (docs/results.md, section cloud_planes).

/// Planes one after the other: the one with the most points within `inlier_sigmas` of those drawn
/// through three points near each other, its largest connected piece taken away, until none has
/// `min_points` (Fischler & Bolles 1981; samples and pieces as Schnabel et al. 2007).
PlaneLabels planes_by_ransac(const CloudPoints& points, const CloudPlanesOptions& options);

/// Regions grown from the flattest points over neighbours whose normals, of patches about them,
/// differ by less than ten degrees and that are within `inlier_sigmas` of the region's plane, which
/// is fitted anew as it grows (Rabbani et al. 2006).
PlaneLabels planes_by_growing(const CloudPoints& points, const CloudPlanesOptions& options);

}  // namespace placegraph
