#pragma once
#include <placegraph/graph/core/ids.h>

#include <cstdint>
#include <map>
#include <string>

namespace placegraph::apps {

/// Reads the place that each image of a set shows.
/// There are `image label` lines, both whole numbers from 0. Throws FileError with the line:
/// another format, numbers beyond 1e9, an image labelled twice; or if there is no label.
std::map<FrameId, int> read_labels(const std::string& path);

}  // namespace placegraph::apps
