#pragma once
#include <placegraph/frontend/cloud_planes/cloud_points.h>

#include <vector>

namespace placegraph {

/// Small connected piece of a cloud: a block of an image, or a leaf of a tree.
struct SuperPoint {
  int begin = 0, end = 0;  ///< range of its points in `SuperPoints::order`
  PlaneSums sums;
  FittedPlane plane;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< mean of its points [m]
  bool planar = false;  ///< its points are on one plane within noise and flatness
};

/// Two super-points that have neighbouring points.
struct Contact {
  int a = 0, b = 0;  ///< a < b
  int pairs = 0;     ///< number of pairs of neighbours
};

struct SuperPoints {
  std::vector<SuperPoint> cells;
  std::vector<int> order;         ///< points, cell by cell
  std::vector<int> cell_of;       ///< cell of each point
  std::vector<Contact> contacts;  ///< ascending, between any two cells
};

/// Whether points are on the plane that was fitted to them.
bool lies_on_plane(const PlaneSums& sums, const FittedPlane& fit, const FitModel& model);

/// Divides a cloud into super-points, as large as the surface allows.
///
/// A piece is split as long as its points deviate from one plane by more than their noise. Images
/// are divided into blocks of 16 px a side down to 4 px, other clouds at medians into pieces of at
/// most 1/64 of the points down to a dozen.
SuperPoints make_super_points(const CloudPoints& points);

/// Dissimilarity of two super-points from one plane: the increase of chi2 of both under a common
/// plane, per degree of freedom, with the allowed deviation. About 1 on a common plane.
double planar_dissimilarity(const SuperPoint& a, const SuperPoint& b, const FitModel& model);

}  // namespace placegraph
