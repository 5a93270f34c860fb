#include <placegraph/frontend/places/code_database.h>
#include <placegraph/frontend/places/llc_codes.h>
#include <placegraph/graph/core/error.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <numeric>

namespace placegraph {
namespace {

void pool(const LlcCode& code, Eigen::Ref<Eigen::VectorXf> pooled) {
  for (std::size_t i = 0; i < code.words.size(); ++i) {
    float& largest = pooled[code.words[i]];
    largest = std::max(largest, code.shares[static_cast<Eigen::Index>(i)]);
  }
}

Eigen::VectorXf of_unit_length(const Eigen::VectorXf& vector) {
  const float length = vector.norm();
  return length > 0 ? Eigen::VectorXf(vector / length) : vector;
}

}  // namespace

Eigen::VectorXf local_shares(const Eigen::Ref<const FloatDescriptors>& words,
                             const Eigen::Ref<const Eigen::RowVectorXf>& descriptor, double ridge) {
  require(words.rows() > 0 && words.cols() == descriptor.size(),
          "local_shares: words and descriptor of equal length needed");
  const Eigen::MatrixXd differences = (words.rowwise() - descriptor).cast<double>();
  Eigen::MatrixXd covariance = differences * differences.transpose();
  // If all words equal the descriptor, only the ridge determines the shares: they are equal.
  constexpr double kLeastTrace = 1e-12;
  covariance.diagonal().array() += ridge * std::max(covariance.trace(), kLeastTrace);
  const Eigen::VectorXd shares = covariance.ldlt().solve(Eigen::VectorXd::Ones(words.rows()));
  return (shares / shares.sum()).cast<float>();
}

std::vector<LlcCode> llc_codes(const FloatDescriptors& words, const FloatDescriptors& descriptors,
                               const LlcOptions& options) {
  options.check();
  require(words.rows() > 0 && (descriptors.rows() == 0 || words.cols() == descriptors.cols()),
          "llc_codes: words and descriptors of equal length needed");
  std::vector<LlcCode> codes(static_cast<std::size_t>(descriptors.rows()));
  if (codes.empty()) return codes;
  const auto k = std::min<Eigen::Index>(options.neighbours, words.rows());
  // |b - x|^2 less |x|^2, which is the same for all words.
  FloatDescriptors distances = -2 * descriptors * words.transpose();
  distances.rowwise() += words.rowwise().squaredNorm().transpose();
  std::vector<int> order(static_cast<std::size_t>(words.rows()));
  FloatDescriptors nearest(k, words.cols());
  for (Eigen::Index i = 0; i < descriptors.rows(); ++i) {
    std::iota(order.begin(), order.end(), 0);
    const auto row = distances.row(i);
    std::partial_sort(order.begin(), order.begin() + k, order.end(),
                      [&](int a, int b) { return row[a] != row[b] ? row[a] < row[b] : a < b; });
    LlcCode& code = codes[static_cast<std::size_t>(i)];
    code.words.assign(order.begin(), order.begin() + k);
    for (Eigen::Index n = 0; n < k; ++n)
      nearest.row(n) = words.row(code.words[static_cast<std::size_t>(n)]);
    code.shares = local_shares(nearest, descriptors.row(i), options.ridge);
  }
  return codes;
}

Eigen::VectorXf max_pooled(const std::vector<LlcCode>& codes, int words) {
  Eigen::VectorXf pooled = Eigen::VectorXf::Zero(words);
  for (const LlcCode& code : codes) pool(code, pooled);
  return of_unit_length(pooled);
}

Eigen::VectorXf max_pooled(const std::vector<LlcCode>& codes, int words,
                           const std::vector<int>& cell_of, int cells) {
  require(codes.size() == cell_of.size(), "max_pooled: a cell per code needed");
  Eigen::VectorXf pooled = Eigen::VectorXf::Zero(static_cast<Eigen::Index>(words) * (cells + 1));
  for (std::size_t i = 0; i < codes.size(); ++i) {
    pool(codes[i], pooled.head(words));
    pool(codes[i], pooled.segment(static_cast<Eigen::Index>(words) * (cell_of[i] + 1), words));
  }
  return of_unit_length(pooled);
}

std::vector<int> pyramid_cells(const FloatFeatures& features, int rows) {
  std::vector<int> cells;
  cells.reserve(features.position.size());
  for (const Eigen::Vector2f& position : features.position) {
    const auto at = [&](float share) {
      return std::clamp(static_cast<int>(share * static_cast<float>(rows)), 0, rows - 1);
    };
    cells.push_back(at(position.y() / features.height) * rows + at(position.x()));
  }
  return cells;
}

}  // namespace placegraph
