#pragma once
#include <placegraph/io/internal/datasets/dataset_summary.h>

#include <cstddef>
#include <optional>
#include <string>

namespace placegraph::apps {

struct InspectArguments {
  std::string path;       ///< folder or video
  bool read_all = false;  ///< read every image and count those that fail
};

/// Frames that cannot be read, and the message of the first.
struct UnreadableFrames {
  std::size_t count = 0;
  std::string first;
};

struct InspectResult {
  std::string path;                            ///< as given; of mere images the folder they are in
  DatasetSummary summary;                      ///< of a sequence
  std::optional<UnreadableFrames> unreadable;  ///< if all were read
  std::optional<std::string> no_sequence;      ///< a folder of images that are none: why
  std::size_t images = 0;                      ///< of such a folder
};

/// `placegraph inspect`: what a folder or video is taken for, and what run would use of it. Throws
/// FileError, and UnknownLayout where it holds no images either.
InspectResult inspect(const InspectArguments& arguments);

std::string to_text(const InspectResult& result);
std::string to_json(const InspectResult& result);

}  // namespace placegraph::apps
