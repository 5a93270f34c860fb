#include "apps/places/train_vocabulary.h"

#include <fmt/format.h>
#include <placegraph/frontend/places/vocabulary_training.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/files/image_file.h>
#include <placegraph/io/files/image_list.h>
#include <placegraph/io/models/vocabulary_file.h>

#include <opencv2/core/utility.hpp>

#include "apps/support/choice.h"
#include "apps/support/image_range.h"
#include "apps/support/output.h"
#include "apps/support/progress.h"

namespace placegraph::apps {

const std::vector<std::string>& vocabulary_kinds() {
  static const std::vector<std::string> names = {"binary", "float"};
  return names;
}

namespace {

std::vector<std::string> all_images_of(const TrainVocabularyArguments& arguments) {
  std::vector<std::string> images;
  for (const std::string& folder : arguments.folders)
    for (std::string& image : list_images(image_folder_of(folder)))
      images.push_back(std::move(image));
  return images;
}

// Consecutive images are similar, so many descriptors of some images are better than few of all.
std::vector<std::string> thinned(std::vector<std::string> images, int descriptors) {
  constexpr std::size_t kOfAnImage = 150;
  const std::size_t stride = images.size() * kOfAnImage / static_cast<std::size_t>(descriptors) + 1;
  std::vector<std::string> kept;
  for (std::size_t i = 0; i < images.size(); i += stride) kept.push_back(std::move(images[i]));
  return kept;
}

}  // namespace

TrainVocabularyResult train_vocabulary(const TrainVocabularyArguments& arguments) {
  const auto kind = choice<WordTree::Kind>("--kind", vocabulary_kinds(), arguments.kind);
  require_free(arguments.out, arguments.force);
  cv::setNumThreads(1);
  const std::vector<std::string> images = thinned(all_images_of(arguments), arguments.descriptors);
  Progress progress("describing", static_cast<std::int64_t>(images.size()), "images");
  const auto grey_of = [&](std::size_t i) {
    progress.update(static_cast<std::int64_t>(i) + 1);
    return read_image(images[i]).grey;
  };
  const WordTree tree = placegraph::train_vocabulary(
      images.size(), grey_of, {kind, arguments.words, arguments.descriptors, arguments.seed});
  if (tree.words == 0)
    throw NoResult(kind == WordTree::Kind::kBinary ? "no image has a corner to learn words from"
                                                   : "no image has anything to learn words from");
  if (tree.words < arguments.words / 2)
    warn(fmt::format("{} words, not {}: the images show no more", tree.words, arguments.words));
  write_vocabulary(arguments.out, tree);
  return {arguments.out, arguments.kind, tree.words, images.size()};
}

std::string to_text(const TrainVocabularyResult& result) {
  return fmt::format("{} {} words learned from {} images, written to {}\n", result.words,
                     result.kind, result.images, result.out);
}

}  // namespace placegraph::apps
