#include <placegraph/backend/elimination/front_covariance.h>
#include <placegraph/backend/elimination/front_kernels.h>
#include <placegraph/graph/core/parallel.h>

#include <algorithm>

namespace placegraph {

template <int D>
Eigen::MatrixXd covariance(const FrontForest<D>& forest, const std::vector<int>& variables) {
  using Front = typename FrontForest<D>::Front;
  // Solves H X = E: forward from the fronts of the variables up to the roots, then backward; other
  // fronts have no effect.
  std::vector<int> path;
  for (const int v : variables)
    for (int f = forest.variables[v].front; f >= 0; f = forest.fronts[f].parent) path.push_back(f);
  std::sort(path.begin(), path.end(), [&](int a, int b) { return forest.earlier(a, b); });
  path.erase(std::unique(path.begin(), path.end()), path.end());
  std::vector<int> place(forest.variables.size(), -1), members;
  for (const int f : path)
    for (const int v : forest.fronts[f].frontal) {
      place[v] = static_cast<int>(members.size());
      members.push_back(v);
    }
  const int count = static_cast<int>(variables.size());
  Eigen::MatrixXd X = Eigen::MatrixXd::Zero(members.size() * D, count * D);
  for (int i = 0; i < count; ++i)
    X.template block<D, D>(place[variables[i]] * D, i * D).setIdentity();
  const auto gather_and = [&](const Front& front, Eigen::Index column, auto&& solve) {
    Eigen::VectorXd x = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(front.blocks()) * D);
    int next = 0;
    for (const auto* part : {&front.frontal, &front.separator})
      for (const int v : *part)
        x.template segment<D>(next++ * D) = X.template block<D, 1>(place[v] * D, column);
    solve(front.matrix.data(), front.blocks() * D, static_cast<int>(front.frontal.size()) * D,
          x.data());
    next = 0;
    for (const auto* part : {&front.frontal, &front.separator})
      for (const int v : *part)
        X.template block<D, 1>(place[v] * D, column) = x.template segment<D>(next++ * D);
  };
  for (Eigen::Index column = 0; column < X.cols(); ++column) {
    check_interruption();
    for (auto f = path.begin(); f != path.end(); ++f)
      gather_and(forest.fronts[*f], column, FrontKernels<D>::forward);
    for (auto f = path.rbegin(); f != path.rend(); ++f)
      gather_and(forest.fronts[*f], column, FrontKernels<D>::backward);
  }
  Eigen::MatrixXd covariance(count * D, count * D);
  for (int i = 0; i < count; ++i)
    covariance.middleRows(i * D, D) = X.middleRows(place[variables[i]] * D, D);
  return covariance;
}

template Eigen::MatrixXd covariance(const FrontForest<3>&, const std::vector<int>&);
template Eigen::MatrixXd covariance(const FrontForest<6>&, const std::vector<int>&);
template Eigen::MatrixXd covariance(const FrontForest<7>&, const std::vector<int>&);

}  // namespace placegraph
