#include "apps/scene/cmd_scene_check.h"

#include <fmt/format.h>
#include <placegraph/eval/scene/label_check.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/files/image_file.h>
#include <placegraph/io/measurements/class_list.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "apps/support/labelled_set.h"

namespace placegraph::apps {
namespace {

namespace fs = std::filesystem;

struct SceneCheckArguments {
  std::string labels, data, classes;
  bool surfaces = false, confusion = false, json = false;
};

/// The names that stand behind the numbers of a label image.
std::vector<std::string> names_of(const std::vector<SceneClass>& classes, bool surfaces) {
  std::vector<std::string> names;
  for (int s = 0; surfaces && s < kSurfaceCount; ++s)
    names.push_back(surface_name(static_cast<Surface>(s)));
  for (const SceneClass& c : classes)
    if (!surfaces && c.surface && !std::count(names.begin(), names.end(), c.name))
      names.push_back(c.name);
  return names;
}

Image confidence_of(const fs::path& path, const Image& labels) {
  if (!fs::exists(path)) return {};
  const Image bytes = read_image(path.string()).grey;
  require_size(path.string(), bytes, labels.cols, labels.rows);
  Image confidence;
  bytes.convertTo(confidence, CV_32F, 1 / 255.0);
  return confidence;
}

LabelCheck compare(const SceneCheckArguments& a, const LabelledSet& set,
                   const std::vector<std::string>& names) {
  LabelCheck check(static_cast<int>(names.size()));
  for (const LabelledPicture& picture : set.train) {
    const std::string name = fs::path(picture.image).stem().string();
    const fs::path path = fs::path(a.labels) / (name + ".png");
    if (!fs::exists(path))
      throw FileError(path.string(), "missing: the labels of " + picture.image);
    const Image labels = read_image_as_stored(path.string());
    if (labels.type() != CV_8UC1)
      throw FileError(path.string(), "no label image: one channel of 8 bits is needed");
    const Image truth = read_class_image(picture.labels, set.classes, names, a.surfaces);
    require_size(path.string(), labels, truth.cols, truth.rows);
    check.add(truth, labels,
              confidence_of(fs::path(a.labels) / (name + ".confidence.png"), labels));
  }
  return check;
}

void check_labels(const SceneCheckArguments& a) {
  const LabelledSet set = read_labelled_set(a.data);
  const std::vector<std::string> names =
      names_of(a.classes.empty() ? set.classes : read_class_list(a.classes), a.surfaces);
  const LabelCheck check = compare(a, set, names);
  nlohmann::json report = {{"pictures", set.train.size()},
                           {"pixels", check.pixels()},
                           {"pixel_accuracy", check.pixel_accuracy()},
                           {"class_accuracy", check.class_accuracy()},
                           {"mean_iou", check.mean_iou()}};
  if (!std::isnan(check.calibration_error()))
    report["calibration_error"] = check.calibration_error();
  const int n = check.classes();
  for (int c = 0; c < n; ++c) {
    const std::string& name = names[static_cast<std::size_t>(c)];
    if (!std::isnan(check.iou(c))) report["iou"][name] = check.iou(c);
    for (int d = 0; a.confusion && d <= n; ++d)
      report["confusion"][name].push_back(check.count(c, d));
  }
  if (a.json) {
    fmt::print("{}\n", report.dump(2));
    return;
  }
  fmt::print("{} pictures: pixel accuracy {:.4f}, class accuracy {:.4f}, mean IoU {:.4f}",
             set.train.size(), check.pixel_accuracy(), check.class_accuracy(), check.mean_iou());
  if (report.contains("calibration_error"))
    fmt::print(", calibration error {:.4f}", check.calibration_error());
  fmt::print("\n");
  for (int c = 0; c < n; ++c) {
    if (std::isnan(check.iou(c))) continue;
    fmt::print("{:12} IoU {:.3f}", names[static_cast<std::size_t>(c)], check.iou(c));
    for (int d = 0; a.confusion && d <= n; ++d) fmt::print(" {:9}", check.count(c, d));
    fmt::print("\n");
  }
}

}  // namespace

void add_scene_check_command(CLI::App& scene) {
  CLI::App* command = scene.add_subcommand("check", "Judge label images by those that people made");
  command->footer("placegraph scene check labels camvid/val");
  auto arguments = std::make_shared<SceneCheckArguments>();
  SceneCheckArguments& a = *arguments;
  command
      ->add_option("LABELS", a.labels,
                   "folder of `scene label` or `scene surfaces`; confidences in it are judged too")
      ->required()
      ->check(CLI::ExistingDirectory);
  command
      ->add_option("DATA", a.data, "folder with images/ and labels/, CLASSES.txt in it or above it")
      ->required()
      ->check(CLI::ExistingDirectory);
  command
      ->add_option("--classes", a.classes,
                   "CLASSES.txt by which LABELS are numbered, where it is not that of DATA")
      ->check(CLI::ExistingFile);
  command->add_flag("--surfaces", a.surfaces, "LABELS are surfaces");
  command->add_flag("--confusion", a.confusion, "pixels of each class by what they are called");
  command->add_flag("--json", a.json, "a report for machines");
  command->callback([arguments] { check_labels(*arguments); });
}

}  // namespace placegraph::apps
