#pragma once
#include <placegraph/io/datasets/open_dataset.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace placegraph::apps {

/// Grey images of a sequence in their order.
/// Images of a data set (see open_dataset) are undistorted and have a camera. Images of a bare
/// folder are taken as they are and have none.
class FrameSource {
 public:
  /// Throws FileError if `path` is neither a data set nor a folder of images.
  explicit FrameSource(const std::string& path);
  std::size_t size() const { return dataset_ ? dataset_->size() : images_.size(); }
  /// Nothing for a bare folder.
  std::optional<Camera> camera() const;
  /// Nothing for a bare folder.
  std::optional<std::int64_t> stamp_ns(std::size_t index) const;
  /// CV_8UC1. Throws FileError, for a bare folder also if its images differ in size.
  Image image(std::size_t index) const;

 private:
  std::unique_ptr<Dataset> dataset_;
  std::vector<std::string> images_;
  Image first_;  ///< first image of a bare folder
};

}  // namespace placegraph::apps
