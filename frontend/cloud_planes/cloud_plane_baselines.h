#pragma once
#include <placegraph/frontend/cloud_planes/cloud_planes_options.h>
#include <placegraph/frontend/cloud_planes/cloud_points.h>
#include <placegraph/frontend/cloud_planes/plane_labels.h>

namespace placegraph {

// Both are methods of CloudPlanesOptions, so that a caller can compare the cuts with them on other
// data. Of 264 planes of depth images with 2 mm of noise the cuts find 198 in 21 ms per image,
// RANSAC 155 in 352 ms, region growing 35 in 56 ms (docs/results/cloud_planes.md).

/// Finds planes one after the other by RANSAC (Fischler & Bolles 1981).
///
/// The next plane is the one with the most points within `inlier_sigmas` among those drawn through
/// three points near each other. Its largest connected piece is removed, until no plane has
/// `min_points` (samples and pieces as in Schnabel et al. 2007).
PlaneLabels planes_by_ransac(const CloudPoints& points, const CloudPlanesOptions& options);

/// Grows regions from the flattest points (Rabbani et al. 2006).
///
/// A neighbour is added if its normal, from the patch around it, differs by less than ten degrees
/// and it is within `inlier_sigmas` of the region's plane, which is fitted again as the region
/// grows.
PlaneLabels planes_by_growing(const CloudPoints& points, const CloudPlanesOptions& options);

}  // namespace placegraph
