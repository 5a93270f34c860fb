#include "apps/support/label_file.h"
#include <placegraph/graph/core/error.h>
#include <placegraph/io/files/text_file.h>

#include <vector>

namespace placegraph::apps {

std::map<FrameId, int> read_labels(const std::string& path) {
  constexpr std::int64_t kLargest = 1'000'000'000;
  TextFile file(path);
  std::map<FrameId, int> labels;
  std::string_view line;
  std::vector<std::string_view> fields;
  while (file.next_data(line)) {
    split_blank(line, fields);
    if (fields.size() != 2)
      file.fail(std::to_string(fields.size()) + " columns, expected: image label");
    const std::int64_t image = file.integer(fields[0], "image");
    const std::int64_t label = file.integer(fields[1], "label");
    if (image < 0 || image > kLargest)
      file.fail("image: " + in_quotes(fields[0]) + " is out of range");
    if (label < 0 || label > kLargest)
      file.fail("label: " + in_quotes(fields[1]) + " is out of range");
    if (!labels.emplace(FrameId(image), static_cast<int>(label)).second)
      file.fail("image " + std::to_string(image) + " is labelled already");
  }
  if (labels.empty()) throw FileError(path, "no label in it");
  return labels;
}

}  // namespace placegraph::apps
