#pragma once
#include <placegraph/io/synthetic/render/undulation.h>

#include <Eigen/Core>

#include <functional>
#include <vector>

namespace placegraph::synthetic {

/// A smooth ground y = height(x, z) (y down, metres): a quadratic B-spline surface.
class HeightSurface {
 public:
  /// One surface through samples (x, y, z) that may contradict each other: minimizes
  ///   sum_i (height(x_i, z_i) - y_i)^2 + stiffness * (second differences of the control net)^2,
  /// a thin plate over the whole area plus a margin. Samples of different passes over one spot are
  /// averaged, and the difference is spread along the roads that lead there.
  static HeightSurface fit(const std::vector<Eigen::Vector3d>& samples, double spacing_m,
                           double stiffness, double margin_m);
  /// A surface with the control heights `height(x, z)`.
  static HeightSurface from_function(const Eigen::Vector2d& low, const Eigen::Vector2d& high,
                                     double spacing_m,
                                     const std::function<double(double, double)>& height);

  double height(double x, double z) const;
  /// Unit normal, pointing up (its y is negative).
  Eigen::Vector3d normal(double x, double z) const;

 private:
  struct Stencil {
    int x, z;
    double wx[3], wz[3];
  };
  HeightSurface(const Eigen::Vector2d& low, const Eigen::Vector2d& high, double spacing_m);
  Stencil stencil(double x, double z) const;

  Eigen::Vector2d low_;
  double spacing_m_;
  int nx_, nz_;
  std::vector<double> control_;
};

/// The ground as it is rendered: `surface` plus `undulation`, sampled on the grid of whole
/// multiples of `cell_m` and interpolated linearly in two triangles a cell, split along the
/// diagonal of growing x + z.
struct GroundMesh {
  explicit GroundMesh(HeightSurface s, Undulation u = {})
      : surface(std::move(s)), undulation(std::move(u)), cell_m(undulation.empty() ? 2 : 1) {}
  HeightSurface surface;
  Undulation undulation;
  double cell_m;

  /// Height at a point of the grid.
  double vertex_height(double x, double z) const {
    return surface.height(x, z) + undulation.height(x, z);
  }
  double height(double x, double z) const;
  double undulation_at(double x, double z) const;  ///< the undulation's part of `height`
};

}  // namespace placegraph::synthetic
