#pragma once
#include <placegraph/frontend/internal/cloud_planes/cloud_points.h>

#include <vector>

namespace placegraph {

/// A small connected piece of a cloud: a block of an image, or a leaf of a tree.
struct SuperPoint {
  int begin = 0, end = 0;  ///< of its points in `SuperPoints::order`
  PlaneSums sums;
  FittedPlane plane;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< mean of its points [m]
  bool planar = false;  ///< its points lie on one plane within noise and flatness
};

/// Two super-points with points that are neighbours.
struct Contact {
  int a = 0, b = 0;  ///< a < b
  int pairs = 0;     ///< of neighbours
};

struct SuperPoints {
  std::vector<SuperPoint> cells;
  std::vector<int> order;         ///< points, cell by cell
  std::vector<int> cell_of;       ///< of each point
  std::vector<Contact> contacts;  ///< ascending, between any two cells
};

/// Whether points lie on the plane that was fitted to them.
bool lies_on_plane(const PlaneSums& sums, const FittedPlane& fit, const FitModel& model);

/// Cuts a cloud into super-points, as large as the surface allows: a piece is split while its
/// points are off one plane by more than their noise. Images are cut into blocks of 16 px a side
/// down to 4 px, other clouds at medians into pieces of at most 1/64 of the points down to a dozen.
SuperPoints make_super_points(const CloudPoints& points);

/// How unlike one plane two super-points are: the rise of chi2 of both when one plane must do for
/// them, per degree of freedom, with the bending that is allowed. About 1 on a common plane.
double planar_dissimilarity(const SuperPoint& a, const SuperPoint& b, const FitModel& model);

}  // namespace placegraph
