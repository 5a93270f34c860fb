#pragma once
#include "apps/run/dataset_summary.h"

#include <cstddef>
#include <optional>
#include <string>

namespace placegraph::apps {

struct InspectArguments {
  std::string path;       ///< folder or video
  bool read_all = false;  ///< read every image and count the unreadable ones
};

/// Number of unreadable frames, and the message of the first.
struct UnreadableFrames {
  std::size_t count = 0;
  std::string first;
};

struct InspectResult {
  std::string path;                            ///< path as given; for bare images their folder
  DatasetSummary summary;                      ///< summary of a sequence
  std::optional<UnreadableFrames> unreadable;  ///< set if every image was read
  std::optional<std::string> no_sequence;      ///< reason if a folder of images is no sequence
  std::size_t images = 0;                      ///< number of images in such a folder
};

/// Describes how a folder or video is read and what `run` would use: `placegraph inspect`.
/// Throws FileError, and UnknownLayout if it has no images.
InspectResult inspect(const InspectArguments& arguments);

std::string to_text(const InspectResult& result);
std::string to_json(const InspectResult& result);

}  // namespace placegraph::apps
