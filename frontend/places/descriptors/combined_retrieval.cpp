#include <placegraph/frontend/places/descriptors/combined_retrieval.h>
#include <placegraph/frontend/places/place_similarity.h>
#include <placegraph/graph/core/random.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace placegraph {
namespace {

double median_of(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

void StrangerScale::standardize(std::vector<double>& similarities) const {
  if (values_.empty()) {
    std::ranges::fill(similarities, 0);
    return;
  }
  const double median = median_of(values_);
  std::vector<double> distances;
  for (const double value : values_) distances.push_back(std::abs(value - median));
  // 1.4826 makes the median absolute deviation a standard deviation of normal values. The floor,
  // the rounding of single precision, keeps equal similarities from dividing by zero.
  constexpr double kToSigma = 1.4826, kFloor = 1e-6;
  const double sigma = kToSigma * median_of(std::move(distances)) + kFloor;
  for (double& similarity : similarities) similarity = (similarity - median) / sigma;
}

CombinedRetrieval::CombinedRetrieval(std::shared_ptr<ImageDescriber> describer, bool normalize,
                                     const PlaceRecognizerOptions& options)
    : descriptors_(std::move(describer), normalize), cues_(options) {}

void CombinedRetrieval::begin_frame(FrameId frame) {
  frame_ = frame;
  descriptors_.begin_frame(frame);
}

void CombinedRetrieval::clear() {
  descriptors_.clear();
  cues_ = PlaceRecognizer(cues_.options());
  described_.reset();
  by_descriptor_.clear();
  by_cues_.clear();
}

const PlaceView& CombinedRetrieval::view_of(const Image& image) {
  if (described_ != frame_) view_ = describe_place(image, cues_.options().cues, true);
  described_ = frame_;
  return view_;
}

void CombinedRetrieval::add(const Image& image) {
  descriptors_.add(image);
  cues_.add(described_ == frame_ ? view_ : describe_place(image, cues_.options().cues, false));
}

/// Compares the image with random views of the range, more of them for the first images.
void CombinedRetrieval::meet_strangers(const Image& image, int first, int last) {
  // Pairs an image, pairs that the first images complete, and pairs after which median and
  // deviation are known to a few percent. Chosen.
  constexpr std::size_t kEach = 4, kFirst = 40, kEnough = 2000;
  if (by_cues_.size() >= kEnough) return;
  const std::size_t missing = by_cues_.size() < kFirst ? kFirst - by_cues_.size() : 0;
  const int count = std::min(last - first + 1, static_cast<int>(std::max(kEach, missing)));
  Random random(0, "strangers", {frame_.value()});
  std::vector<int> views;
  random.sample(last - first + 1, count, views);
  for (const int view : views) {
    by_descriptor_.add(descriptors_.similarity(image, first + view));
    by_cues_.add(place_similarity(view_of(image), cues_.view(first + view), cues_.options().cues));
  }
}

std::vector<PlaceSimilarity> CombinedRetrieval::query(const Image& image, int first, int last) {
  first = std::max(first, 0);
  last = std::min(last, cues_.size() - 1);
  if (first > last) return {};
  meet_strangers(image, first, last);
  std::set<int> found;
  for (const PlaceSimilarity& each : descriptors_.query(image, first, last))
    found.insert(each.view);
  for (const PlaceSimilarity& each : cues_.query(view_of(image), first, last))
    found.insert(each.view);
  std::vector<double> by_descriptor, by_cues;
  for (const int view : found) {
    by_descriptor.push_back(descriptors_.similarity(image, view));
    by_cues.push_back(place_similarity(view_, cues_.view(view), cues_.options().cues));
  }
  by_descriptor_.standardize(by_descriptor);
  by_cues_.standardize(by_cues);
  std::vector<PlaceSimilarity> list;
  for (const int view : found)
    list.push_back({view, by_descriptor[list.size()] + by_cues[list.size()]});
  keep_best(list, cues_.options().short_list);
  return list;
}

}  // namespace placegraph
