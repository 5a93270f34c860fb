#pragma once
#include <placegraph/graph/core/error.h>
#include <placegraph/io/datasets/dataset.h>

namespace [[gnu::visibility("default")]] placegraph {

/// No sequence of a known layout was found at a path; the message lists the layouts.
class UnknownLayout : public FileError {
 public:
  using FileError::FileError;
};

/// Recognizes the layout of a folder or video file and opens it as a sequence.
///
/// docs/datasets.md describes the layouts. Throws UnknownLayout if none is recognized, FileError if
/// `path` does not exist or the recognized sequence is broken.
std::unique_ptr<Dataset> open_dataset(const std::string& path);

/// Whether the path is a sequence of one of these layouts, by the names in it.
bool is_sequence(const std::string& path);

}  // namespace placegraph
