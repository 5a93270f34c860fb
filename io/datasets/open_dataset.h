#pragma once
#include <placegraph/io/datasets/dataset.h>

namespace placegraph {

/// Recognizes what lies at `path` and opens it; see docs/datasets.md for the layouts. Throws
/// FileError saying what was looked for if nothing is recognized.
std::unique_ptr<Dataset> open_dataset(const std::string& path);

}  // namespace placegraph
