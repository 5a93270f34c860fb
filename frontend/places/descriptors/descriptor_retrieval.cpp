#include <placegraph/frontend/places/descriptors/descriptor_retrieval.h>
#include <placegraph/graph/core/error.h>

#include <cmath>
#include <limits>
#include <string>

namespace placegraph {

DescriptorRetrieval::DescriptorRetrieval(std::shared_ptr<ImageDescriber> describer, bool normalize)
    : describer_(std::move(describer)), normalize_(normalize) {
  require(describer_ != nullptr, "DescriptorRetrieval: there is no describer");
}

void DescriptorRetrieval::clear() {
  described_.reset();
  index_.reset();
}

/// The index, after the image was described in `descriptor_`.
DenseIndex& DescriptorRetrieval::index_with(const Image& image) {
  if (described_ == frame_) return *index_;
  described_.reset();
  descriptor_ = describer_->describe(image, frame_);
  const std::string of = "recognizer: the descriptor of image " + std::to_string(frame_.value());
  require(!descriptor_.empty(), of + " is empty");
  require(!index_ || descriptor_.size() == static_cast<std::size_t>(index_->dimension()),
          of + " has " + std::to_string(descriptor_.size()) + " values, those before have " +
              std::to_string(index_ ? index_->dimension() : 0));
  double squares = 0;
  for (const float value : descriptor_) squares += static_cast<double>(value) * value;
  require(std::isfinite(squares), of + " has a value that is not finite");
  require(!normalize_ || squares > 0, of + " is zero");
  if (normalize_)
    for (float& value : descriptor_) value = static_cast<float>(value / std::sqrt(squares));
  // A graph of neighbours needs vectors of unit length.
  constexpr int kAlwaysExact = std::numeric_limits<int>::max();
  if (!index_)
    index_.emplace(static_cast<int>(descriptor_.size()),
                   normalize_ ? DenseIndex::kExactBelow : kAlwaysExact);
  described_ = frame_;
  return *index_;
}

void DescriptorRetrieval::add(const Image& image) { index_with(image).add(descriptor_); }

std::vector<PlaceSimilarity> DescriptorRetrieval::query(const Image& image, int first, int last) {
  return index_with(image).query(descriptor_, kShortList, first, last);
}

double DescriptorRetrieval::similarity(const Image& image, int view) {
  const std::vector<PlaceSimilarity> one = index_with(image).query(descriptor_, 1, view, view);
  require(!one.empty(), "DescriptorRetrieval: there is no such image");
  return one.front().score;
}

}  // namespace placegraph
