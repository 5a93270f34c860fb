#include <placegraph/backend/robust/loop_leverage.h>
#include <placegraph/backend/solver/normal_equations.h>
#include <placegraph/backend/solver/odometry_chain.h>
#include <placegraph/graph/core/random.h>

#include <Eigen/Cholesky>
#include <algorithm>

namespace placegraph {
namespace {

constexpr int kBatch = 16;  // edges or samples solved for at a time

/// The covariance of relative poses from a factorized graph.
template <class Group>
class RelativeCovariance {
 public:
  using Jacobian = typename Group::Jacobian;
  static constexpr int kDof = Group::kDof;

  RelativeCovariance(const PackedGraph<Group>& graph, RotationError rotation_error)
      : graph_(graph), rotation_error_(rotation_error), equations_(graph) {
    equations_.linearize(graph, rotation_error);
    ok_ = equations_.matrix().factorize();
  }
  bool ok() const { return ok_; }

  RelativePoseLinearization<Group> linearize(int edge) const {
    const auto& e = graph_.edges[edge];
    return {e.T_to_from, graph_.poses[e.from], graph_.poses[e.to], rotation_error_};
  }

  /// J H^-1 J^T of every edge, by one solve for every column of J^T.
  std::vector<Jacobian> exact(const std::vector<int>& edges) const {
    std::vector<Jacobian> result;
    Eigen::MatrixXd columns;
    for (std::size_t begin = 0; begin < edges.size(); begin += kBatch) {
      const int count = std::min(kBatch, static_cast<int>(edges.size() - begin));
      columns.setZero(rows(), count * kDof);
      for (int k = 0; k < count; ++k) {
        const auto linear = linearize(edges[begin + k]);
        add_transposed(edges[begin + k], linear, Jacobian::Identity(),
                       columns.middleCols(k * kDof, kDof));
      }
      equations_.matrix().solve(columns);
      for (int k = 0; k < count; ++k) {
        const auto linear = linearize(edges[begin + k]);
        result.push_back(apply(edges[begin + k], linear, columns.middleCols(k * kDof, kDof)));
      }
    }
    return result;
  }

  /// An estimate from samples of the noise propagated to the poses: x = H^-1 J^T Omega^1/2 n has
  /// covariance H^-1.
  std::vector<Jacobian> sampled(const std::vector<int>& edges) const {
    // Samples of a covariance; kSafety below bounds what they miss. Chosen.
    constexpr int kSamples = 48;
    std::vector<Jacobian> result(edges.size(), Jacobian::Zero());
    Random random(1);
    Eigen::MatrixXd columns;
    for (int begin = 0; begin < kSamples; begin += kBatch) {
      columns.setZero(rows(), kBatch);
      Eigen::Matrix<double, kDof, kBatch> noise;
      for (std::size_t i = 0; i < graph_.edges.size(); ++i) {
        const auto& edge = graph_.edges[i];
        if (edge.weight <= 0) continue;
        for (double& n : noise.reshaped()) n = random.normal();
        const Eigen::LDLT<Jacobian> factor(edge.weight * edge.information);
        noise = factor.vectorD().cwiseMax(0).cwiseSqrt().asDiagonal() * noise;
        noise = factor.transpositionsP().transpose() * (factor.matrixL() * noise).eval();
        add_transposed(static_cast<int>(i), linearize(static_cast<int>(i)), noise, columns);
      }
      equations_.matrix().solve(columns);
      for (std::size_t i = 0; i < edges.size(); ++i) {
        const Eigen::Matrix<double, kDof, kBatch> e = apply(edges[i], linearize(edges[i]), columns);
        result[i] += e * e.transpose() / kSamples;
      }
    }
    return result;
  }

 private:
  Eigen::Index rows() const { return static_cast<Eigen::Index>(equations_.block_count()) * kDof; }
  /// columns += J^T b
  template <class B>
  void add_transposed(int edge, const RelativePoseLinearization<Group>& linear, const B& b,
                      Eigen::Ref<Eigen::MatrixXd> columns) const {
    const auto& e = graph_.edges[edge];
    if (const int block = equations_.block_of(e.from); block >= 0)
      columns.middleRows<kDof>(block * kDof) += linear.J_from.transpose() * b;
    if (const int block = equations_.block_of(e.to); block >= 0)
      columns.middleRows<kDof>(block * kDof) += linear.J_to.transpose() * b;
  }
  /// J columns
  Eigen::Matrix<double, kDof, Eigen::Dynamic> apply(
      int edge, const RelativePoseLinearization<Group>& linear,
      const Eigen::Ref<const Eigen::MatrixXd>& columns) const {
    const auto& e = graph_.edges[edge];
    Eigen::Matrix<double, kDof, Eigen::Dynamic> product =
        Eigen::Matrix<double, kDof, Eigen::Dynamic>::Zero(kDof, columns.cols());
    if (const int block = equations_.block_of(e.from); block >= 0)
      product += linear.J_from * columns.middleRows<kDof>(block * kDof);
    if (const int block = equations_.block_of(e.to); block >= 0)
      product += linear.J_to * columns.middleRows<kDof>(block * kDof);
    return product;
  }

  const PackedGraph<Group>& graph_;
  RotationError rotation_error_;
  NormalEquations<Group> equations_;
  bool ok_ = false;
};

template <class Group>
std::vector<double> costs(const PackedGraph<Group>& graph, const std::vector<int>& edges,
                          const RelativeCovariance<Group>& relative,
                          const std::vector<typename Group::Jacobian>& covariances) {
  std::vector<double> cost;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const typename Group::Jacobian sum =
        covariance_of(graph.edges[edges[i]].information) + covariances[i];
    const typename Group::Tangent e = relative.linearize(edges[i]).e;
    cost.push_back(e.dot(sum.llt().solve(e)));
  }
  return cost;
}

}  // namespace

template <class Group>
std::vector<double> cost_of_adding(const PackedGraph<Group>& graph, const std::vector<int>& edges,
                                   RotationError rotation_error, double enough) {
  // Largest ratio of a sampled estimate to the true cost: an eigenvalue of a sampled covariance is
  // below a third of the true one with a probability of about 1e-6.
  constexpr double kSafety = 4;
  // Fewer edges are computed exactly: the cost. Chosen.
  constexpr std::size_t kWorthSampling = 100;
  if (edges.empty()) return {};
  const RelativeCovariance<Group> relative(graph, rotation_error);
  if (!relative.ok()) return {};
  if (edges.size() < kWorthSampling || !graph.positions.empty())
    return costs(graph, edges, relative, relative.exact(edges));
  std::vector<double> cost = costs(graph, edges, relative, relative.sampled(edges));
  std::vector<int> open;
  for (std::size_t i = 0; i < edges.size(); ++i)
    if (cost[i] <= kSafety * enough) open.push_back(static_cast<int>(i));
  std::vector<int> open_edges;
  for (const int i : open) open_edges.push_back(edges[i]);
  const auto exact = costs(graph, open_edges, relative, relative.exact(open_edges));
  for (std::size_t i = 0; i < open.size(); ++i) cost[open[i]] = exact[i];
  return cost;
}

template std::vector<double> cost_of_adding(const PackedGraph<SE2>&, const std::vector<int>&,
                                            RotationError, double);
template std::vector<double> cost_of_adding(const PackedGraph<SE3>&, const std::vector<int>&,
                                            RotationError, double);
template std::vector<double> cost_of_adding(const PackedGraph<Sim3>&, const std::vector<int>&,
                                            RotationError, double);

}  // namespace placegraph
