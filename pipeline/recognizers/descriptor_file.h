#pragma once
#include <placegraph/frontend/places/descriptors/image_describer.h>
#include <placegraph/io/files/npy_array.h>

#include <string>

namespace placegraph {

/// Takes descriptors from a `.npy` file of numpy: row i is that of image or frame i.
class DescriptorFile : public ImageDescriber {
 public:
  /// Reads N x D floats of 4 or 8 bytes. Throws FileError for another content, or with the row of
  /// a value that is not finite.
  explicit DescriptorFile(const std::string& path);

  /// Row `frame`; throws FileError if there is none.
  std::vector<float> describe(const Image& image, FrameId frame) override;

 private:
  std::string path_;
  NpyArray rows_;
};

}  // namespace placegraph
