#include <placegraph/graph/core/error.h>
#include <placegraph/io/synthetic/render/height_surface.h>

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>

namespace placegraph::synthetic {
namespace {

/// Normal equations of weighted rows over the control heights, nx x nz of them.
struct HeightEquations {
  int nx, nz;
  std::vector<Eigen::Triplet<double>> triplets{};  ///< the lower half
  Eigen::VectorXd b = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(nx) * nz);

  int id(int x, int z) const { return z * nx + x; }
  void add_row(const int* ids, const double* w, int count, double weight, double rhs) {
    for (int i = 0; i < count; ++i) {
      b[ids[i]] += weight * w[i] * rhs;
      for (int j = 0; j < count; ++j) {
        if (ids[j] <= ids[i]) triplets.emplace_back(ids[i], ids[j], weight * w[i] * w[j]);
      }
    }
  }
  /// A thin plate that resists being bent and twisted.
  void add_stiffness(double stiffness) {
    const double second[3] = {1, -2, 1}, twist[4] = {1, -1, -1, 1};
    for (int z = 0; z < nz; ++z) {
      for (int x = 0; x < nx; ++x) {
        if (x + 2 < nx) {
          const int ids[3] = {id(x, z), id(x + 1, z), id(x + 2, z)};
          add_row(ids, second, 3, stiffness, 0);
        }
        if (z + 2 < nz) {
          const int ids[3] = {id(x, z), id(x, z + 1), id(x, z + 2)};
          add_row(ids, second, 3, stiffness, 0);
        }
        if (x + 1 < nx && z + 1 < nz) {
          const int ids[4] = {id(x, z), id(x + 1, z), id(x, z + 1), id(x + 1, z + 1)};
          add_row(ids, twist, 4, 2 * stiffness, 0);
        }
        const int self = id(x, z);
        const double one = 1;
        add_row(&self, &one, 1, 1e-6, 0);  // level where there are no samples
      }
    }
  }
  Eigen::VectorXd solve() const {
    Eigen::SparseMatrix<double> A(b.size(), b.size());
    A.setFromTriplets(triplets.begin(), triplets.end());
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower> solver(A);
    require(solver.info() == Eigen::Success, "height surface: the fit is singular");
    return solver.solve(b);
  }
};

}  // namespace

HeightSurface::HeightSurface(const Eigen::Vector2d& low, const Eigen::Vector2d& high,
                             double spacing_m)
    : low_(low), spacing_m_(spacing_m) {
  const Eigen::Vector2d cells = (high - low) / spacing_m;
  nx_ = static_cast<int>(std::ceil(cells[0])) + 3;
  nz_ = static_cast<int>(std::ceil(cells[1])) + 3;
  control_.assign(static_cast<std::size_t>(nx_) * nz_, 0.0);
}

HeightSurface::Stencil HeightSurface::stencil(double x, double z) const {
  Stencil s;
  const auto axis = [](double at, int n, int& first, double* w) {
    at = std::clamp(at, 0.0, n - 2.000001);
    first = static_cast<int>(at);
    const double f = at - first;
    w[0] = 0.5 * (1 - f) * (1 - f);
    w[2] = 0.5 * f * f;
    w[1] = 1 - w[0] - w[2];
  };
  axis((x - low_[0]) / spacing_m_, nx_, s.x, s.wx);
  axis((z - low_[1]) / spacing_m_, nz_, s.z, s.wz);
  return s;
}

HeightSurface HeightSurface::fit(const std::vector<Eigen::Vector3d>& samples, double spacing_m,
                                 double stiffness, double margin_m) {
  require(!samples.empty(), "height surface: no samples");
  Eigen::Vector2d low(1e30, 1e30), high(-1e30, -1e30);
  double mean = 0;
  for (const Eigen::Vector3d& p : samples) {
    require(p.allFinite(), "height surface: sample is not finite");
    low = low.cwiseMin(Eigen::Vector2d(p[0], p[2]));
    high = high.cwiseMax(Eigen::Vector2d(p[0], p[2]));
    mean += p[1] / static_cast<double>(samples.size());
  }
  low.array() -= margin_m;
  high.array() += margin_m;
  HeightSurface out(low, high, spacing_m);
  HeightEquations equations{out.nx_, out.nz_};
  for (const Eigen::Vector3d& p : samples) {
    const Stencil s = out.stencil(p[0], p[2]);
    int ids[9];
    double w[9];
    for (int k = 0; k < 9; ++k) {
      ids[k] = equations.id(s.x + k % 3, s.z + k / 3);
      w[k] = s.wx[k % 3] * s.wz[k / 3];
    }
    equations.add_row(ids, w, 9, 1, p[1] - mean);
  }
  equations.add_stiffness(stiffness);
  const Eigen::VectorXd h = equations.solve();
  for (Eigen::Index i = 0; i < h.size(); ++i) out.control_[i] = h[i] + mean;
  return out;
}

HeightSurface HeightSurface::from_function(const Eigen::Vector2d& low, const Eigen::Vector2d& high,
                                           double spacing_m,
                                           const std::function<double(double, double)>& height) {
  HeightSurface out(low, high, spacing_m);
  for (int z = 0; z < out.nz_; ++z) {
    for (int x = 0; x < out.nx_; ++x)
      out.control_[static_cast<std::size_t>(z) * out.nx_ + x] =
          height(low[0] + (x - 0.5) * spacing_m, low[1] + (z - 0.5) * spacing_m);
  }
  return out;
}

double HeightSurface::height(double x, double z) const {
  const Stencil s = stencil(x, z);
  double sum = 0;
  for (int j = 0; j < 3; ++j) {
    const double* row = &control_[static_cast<std::size_t>(s.z + j) * nx_ + s.x];
    sum += s.wz[j] * (s.wx[0] * row[0] + s.wx[1] * row[1] + s.wx[2] * row[2]);
  }
  return sum;
}

Eigen::Vector3d HeightSurface::normal(double x, double z) const {
  constexpr double kStep_m = 0.5;
  const double dx = (height(x + kStep_m, z) - height(x - kStep_m, z)) / (2 * kStep_m);
  const double dz = (height(x, z + kStep_m) - height(x, z - kStep_m)) / (2 * kStep_m);
  return Eigen::Vector3d(dx, -1, dz).normalized();
}

namespace {

template <class Fn>
double interpolate(double x, double z, double cell_m, const Fn& vertex) {
  const double gx = std::floor(x / cell_m), gz = std::floor(z / cell_m);
  const double fx = x / cell_m - gx, fz = z / cell_m - gz;
  const auto at = [&](double i, double j) { return vertex((gx + i) * cell_m, (gz + j) * cell_m); };
  const double h00 = at(0, 0), h11 = at(1, 1);
  if (fx >= fz) {
    const double h10 = at(1, 0);
    return h00 + fx * (h10 - h00) + fz * (h11 - h10);
  }
  const double h01 = at(0, 1);
  return h00 + fz * (h01 - h00) + fx * (h11 - h01);
}

}  // namespace

double GroundMesh::height(double x, double z) const {
  return interpolate(x, z, cell_m, [&](double i, double j) { return vertex_height(i, j); });
}

double GroundMesh::undulation_at(double x, double z) const {
  return interpolate(x, z, cell_m, [&](double i, double j) { return undulation.height(i, j); });
}

}  // namespace placegraph::synthetic
