#include <faiss/IndexHNSW.h>
#include <omp.h>
#include <placegraph/frontend/places/dense_index.h>
#include <placegraph/graph/core/error.h>

#include <Eigen/Core>
#include <algorithm>

namespace placegraph {
namespace {

/// FAISS asks OpenMP for threads; during the life of this object it gets one, on this thread alone.
class OneThread {
 public:
  OneThread() : before_(omp_get_max_threads()) { omp_set_num_threads(1); }
  ~OneThread() { omp_set_num_threads(before_); }
  OneThread(const OneThread&) = delete;
  OneThread& operator=(const OneThread&) = delete;

 private:
  int before_;
};

// Links of a node and efforts (HNSW, Malkov 2018). Chosen.
constexpr int kLinks = 16, kBuildEffort = 40, kLeastSearchEffort = 64;

}  // namespace

struct DenseIndex::Graph {
  explicit Graph(int dimension) : index(dimension, kLinks) {
    index.hnsw.efConstruction = kBuildEffort;
  }
  const float* vectors() const {
    return static_cast<const faiss::IndexFlat*>(index.storage)->get_xb();
  }
  faiss::IndexHNSWFlat index;
};

DenseIndex::DenseIndex(int dimension, int exact_below)
    : dimension_(dimension), exact_below_(exact_below) {
  require(dimension > 0, "DenseIndex: dimension > 0 needed");
  graph_ = std::make_unique<Graph>(dimension);
}

DenseIndex::~DenseIndex() = default;
DenseIndex::DenseIndex(DenseIndex&&) noexcept = default;
DenseIndex& DenseIndex::operator=(DenseIndex&&) noexcept = default;

int DenseIndex::size() const { return static_cast<int>(graph_->index.ntotal); }

int DenseIndex::add(std::span<const float> vector) {
  require(vector.size() == static_cast<std::size_t>(dimension_),
          "DenseIndex: a vector of another dimension");
  const OneThread one;
  graph_->index.add(1, vector.data());
  return size() - 1;
}

std::vector<PlaceSimilarity> DenseIndex::query(std::span<const float> vector, int count, int first,
                                               int last) const {
  require(vector.size() == static_cast<std::size_t>(dimension_),
          "DenseIndex: a vector of another dimension");
  first = std::max(first, 0);
  last = std::min(last, size() - 1);
  std::vector<PlaceSimilarity> list;
  if (first > last || count < 1) return list;
  const int inside = last - first + 1, outside = size() - inside;
  if (inside <= exact_below_ || outside > inside) {
    const Eigen::Map<const Eigen::VectorXf> query(vector.data(), dimension_);
    for (int i = first; i <= last; ++i)
      list.push_back(
          {i, query.dot(Eigen::Map<const Eigen::VectorXf>(
                  graph_->vectors() + static_cast<std::ptrdiff_t>(i) * dimension_, dimension_))});
    keep_best(list, count);
    return list;
  }
  // Vectors outside the range may be the nearest of all, like the images just before this one.
  const int asked = std::min(size(), count + outside);
  std::vector<float> distances(static_cast<std::size_t>(asked));
  std::vector<faiss::Index::idx_t> found(distances.size(), -1);
  faiss::SearchParametersHNSW effort;
  effort.efSearch = std::max(kLeastSearchEffort, asked);
  const OneThread one;
  graph_->index.search(1, vector.data(), asked, distances.data(), found.data(), &effort);
  for (std::size_t i = 0; i < found.size(); ++i)
    if (found[i] >= first && found[i] <= last)
      list.push_back({static_cast<int>(found[i]), 1 - 0.5 * static_cast<double>(distances[i])});
  keep_best(list, count);
  return list;
}

}  // namespace placegraph
