#include "apps/places/cmd_vocabulary.h"

#include <fmt/format.h>
#include <placegraph/frontend/places/code_memory.h>
#include <placegraph/frontend/places/float_vocabulary.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/files/image_file.h>
#include <placegraph/io/files/image_list.h>
#include <placegraph/io/models/vocabulary_file.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <memory>
#include <opencv2/core/utility.hpp>

#include "apps/support/image_folder_of.h"
#include "apps/support/output.h"
#include "apps/support/progress.h"
#include "apps/support/usage.h"

namespace placegraph::apps {
namespace {

const std::vector<std::string> kKinds = {"binary", "float"};

struct VocabularyArguments {
  std::vector<std::string> folders;
  std::string out, kind = "binary";
  int words = 10000, descriptors = 200'000;
  std::uint64_t seed = 1;
  bool force = false;
};

/// Descriptors of all images, those of one beside each other.
template <class Descriptors>
struct Lesson {
  Descriptors descriptors;
  std::vector<int> end;  ///< of each image's descriptors
};

// As few levels as keep nodes small; each has as many children as gives the words asked for.
VocabularyOptions tree_of(int words) {
  constexpr double kChildren = 24;
  VocabularyOptions options;
  options.depth =
      std::clamp(static_cast<int>(std::ceil(std::log(words) / std::log(kChildren) - 1e-9)), 1, 6);
  options.branching =
      std::clamp(static_cast<int>(std::ceil(std::pow(words, 1.0 / options.depth) - 1e-9)), 2, 64);
  return options;
}

std::vector<std::string> images_of(const VocabularyArguments& arguments) {
  std::vector<std::string> images;
  for (const std::string& folder : arguments.folders)
    for (std::string& image : list_images(image_folder_of(folder)))
      images.push_back(std::move(image));
  return images;
}

// Images one after the other show much the same: rather many descriptors of some than few of all.
std::vector<std::string> thinned(std::vector<std::string> images, int descriptors) {
  constexpr std::size_t kOfAnImage = 150;
  const std::size_t stride = images.size() * kOfAnImage / static_cast<std::size_t>(descriptors) + 1;
  std::vector<std::string> kept;
  for (std::size_t i = 0; i < images.size(); i += stride) kept.push_back(std::move(images[i]));
  return kept;
}

/// log((1 + images) / (1 + images with the word)).
template <class WordOf>
std::vector<float> idf_of(const std::vector<int>& end, int words, const WordOf& word_of) {
  std::vector<int> images(static_cast<std::size_t>(words), 0), last(images.size(), -1);
  for (int image = 0, i = 0; image < static_cast<int>(end.size()); ++image)
    for (; i < end[static_cast<std::size_t>(image)]; ++i) {
      const auto word = static_cast<std::size_t>(word_of(i));
      if (last[word] != image) ++images[word];
      last[word] = image;
    }
  std::vector<float> idf;
  for (const int with : images)
    idf.push_back(static_cast<float>(
        std::log((1.0 + static_cast<double>(end.size())) / (1.0 + static_cast<double>(with)))));
  return idf;
}

WordTree train_binary(const VocabularyArguments& arguments, const std::vector<std::string>& images,
                      std::size_t share) {
  Lesson<std::vector<BinaryDescriptor>> lesson;
  Progress progress("describing", static_cast<std::int64_t>(images.size()), "images");
  CornerAgreementOptions options = PlaceCodeOptions{}.corners;
  options.max_corners = std::min(options.max_corners, static_cast<int>(share));
  for (std::size_t i = 0; i < images.size(); ++i) {
    for (const Feature& corner : corners_of_view(read_image(images[i]).grey, options))
      lesson.descriptors.push_back(corner.descriptor);
    lesson.end.push_back(static_cast<int>(lesson.descriptors.size()));
    progress.update(static_cast<std::int64_t>(i) + 1);
  }
  if (lesson.descriptors.empty()) throw NoAnswer("no image has a corner to learn words from");
  Random random(arguments.seed);
  Vocabulary vocabulary = Vocabulary::train(lesson.descriptors, tree_of(arguments.words), random);
  vocabulary.set_idf(idf_of(lesson.end, vocabulary.words(), [&](int i) {
    return vocabulary.word(lesson.descriptors[static_cast<std::size_t>(i)]);
  }));
  return vocabulary.tree();
}

// Of key-points and of the grid, half and half: one vocabulary serves words, codes and landmarks.
WordTree train_float(const VocabularyArguments& arguments, const std::vector<std::string>& images,
                     std::size_t share) {
  std::vector<FloatDescriptors> parts;
  Lesson<FloatDescriptors> lesson;
  Progress progress("describing", static_cast<std::int64_t>(images.size()), "images");
  FloatFeatureOptions options = PlaceCodeOptions{}.features;
  options.max_features = std::min(options.max_features, static_cast<int>((share + 1) / 2));
  int rows = 0;
  for (std::size_t i = 0; i < images.size(); ++i) {
    const Image grey = read_image(images[i]).grey;
    parts.push_back(float_features(grey, options).descriptors);
    rows += static_cast<int>(parts.back().rows());
    const FloatDescriptors dense = dense_float_features(grey).descriptors;
    const Eigen::Index stride = dense.rows() * 2 / static_cast<Eigen::Index>(share) + 1;
    FloatDescriptors thinned((dense.rows() + stride - 1) / stride, dense.cols());
    for (Eigen::Index k = 0; k < thinned.rows(); ++k) thinned.row(k) = dense.row(k * stride);
    rows += static_cast<int>(thinned.rows());
    parts.push_back(std::move(thinned));
    lesson.end.push_back(rows);
    progress.update(static_cast<std::int64_t>(i) + 1);
  }
  lesson.descriptors.resize(rows, kSiftNumbers);
  Eigen::Index row = 0;
  for (const FloatDescriptors& part : parts) {
    lesson.descriptors.middleRows(row, part.rows()) = part;
    row += part.rows();
  }
  if (rows == 0) throw NoAnswer("no image has anything to learn words from");
  Random random(arguments.seed);
  FloatVocabulary vocabulary =
      FloatVocabulary::train(lesson.descriptors, tree_of(arguments.words), random);
  vocabulary.set_idf(idf_of(lesson.end, vocabulary.words(),
                            [&](int i) { return vocabulary.word(lesson.descriptors.row(i)); }));
  return vocabulary.tree();
}

void train(const VocabularyArguments& arguments) {
  require_free(arguments.out, arguments.force);
  cv::setNumThreads(1);
  const std::vector<std::string> images = thinned(images_of(arguments), arguments.descriptors);
  const std::size_t share =
      std::max<std::size_t>(2, static_cast<std::size_t>(arguments.descriptors) / images.size());
  const WordTree tree = arguments.kind == "binary" ? train_binary(arguments, images, share)
                                                   : train_float(arguments, images, share);
  if (tree.words < arguments.words / 2)
    warn(fmt::format("{} words, not {}: the images show no more", tree.words, arguments.words));
  write_vocabulary(arguments.out, tree);
  fmt::print("{} {} words learned from {} images, written to {}\n", tree.words, arguments.kind,
             images.size(), arguments.out);
}

void show(const std::string& path) {
  const Stopwatch watch;
  const WordTree tree = read_vocabulary(path);
  const double ms = watch.wall_ms();
  fmt::print("{}: {} {} words, {} nodes, read in {:.0f} ms\n", path, tree.words,
             kKinds[tree.kind == WordTree::Kind::kBinary ? 0 : 1], tree.nodes.size(), ms);
}

}  // namespace

void add_vocabulary_command(CLI::App& app) {
  CLI::App* vocabulary = app.add_subcommand("vocabulary", "Visual words for `match --codes`");
  vocabulary->footer("placegraph vocabulary train streets houses --out words.pgw");
  vocabulary->require_subcommand(1);
  auto arguments = std::make_shared<VocabularyArguments>();
  VocabularyArguments& a = *arguments;
  CLI::App* command =
      vocabulary->add_subcommand("train", "Learn visual words from the images of some folders");
  command->footer("placegraph vocabulary train streets houses --out words.pgw --kind float");
  command
      ->add_option("IMAGES", a.folders,
                   "folders of images, or with them in images/ or image_0/: other places than "
                   "those to be told apart")
      ->required()
      ->check(CLI::ExistingDirectory);
  command->add_option("--out", a.out, "write the vocabulary")->required();
  command->add_option("--kind", a.kind, "words of binary descriptors or of SIFT")
      ->check(CLI::IsMember(kKinds))
      ->capture_default_str();
  command->add_option("--words", a.words, "how many, about; fewer where images show fewer")
      ->check(CLI::Range(2, 1'000'000))
      ->capture_default_str();
  command->add_option("--descriptors", a.descriptors, "to learn from, at most")
      ->check(CLI::Range(100, 100'000'000))
      ->capture_default_str();
  command->add_option("--seed", a.seed, "of the clustering")->capture_default_str();
  command->add_flag("--force", a.force, "overwrite files");
  command->callback([arguments] { train(*arguments); });

  auto path = std::make_shared<std::string>();
  CLI::App* info = vocabulary->add_subcommand("info", "What a vocabulary holds");
  info->footer("placegraph vocabulary info words.pgw");
  info->add_option("FILE", *path, "the vocabulary")->required();
  info->callback([path] { show(*path); });
}

}  // namespace placegraph::apps
