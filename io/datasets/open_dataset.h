#pragma once
#include <placegraph/graph/core/error.h>
#include <placegraph/io/datasets/dataset.h>

namespace [[gnu::visibility("default")]] placegraph {

/// Nothing at a path is of a known layout.
class UnknownLayout : public FileError {
 public:
  using FileError::FileError;
};

/// Recognizes what lies at `path` and opens it; see docs/datasets.md for the layouts. Throws
/// UnknownLayout saying what was looked for if nothing is recognized, FileError if what was is
/// broken.
std::unique_ptr<Dataset> open_dataset(const std::string& path);

}  // namespace placegraph
