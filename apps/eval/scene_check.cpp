#include "apps/eval/scene_check.h"

#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/text/json_text.h>
#include <placegraph/io/files/image_file.h>
#include <placegraph/io/measurements/class_list.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "apps/support/labelled_set.h"

namespace placegraph::apps {
namespace {

namespace fs = std::filesystem;

/// Names of the classes in a label image, by number.
std::vector<std::string> label_names(const std::vector<SceneClass>& classes, bool surfaces) {
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
  for (const LabelledImage& image : set.train) {
    const std::string name = fs::path(image.image).stem().string();
    const fs::path path = fs::path(a.labels) / (name + ".png");
    if (!fs::exists(path)) throw FileError(path.string(), "missing: the labels of " + image.image);
    const Image labels = read_image_as_stored(path.string());
    if (labels.type() != CV_8UC1)
      throw FileError(
          path.string(),
          "no label image: one channel of 8 bits is needed (--ids of `image labels` and "
          "`image surfaces` writes it)");
    const Image truth = read_class_image(image.labels, set.classes, names, a.surfaces);
    require_size(path.string(), labels, truth.cols, truth.rows);
    check.add(truth, labels,
              confidence_of(fs::path(a.labels) / (name + ".confidence.png"), labels));
  }
  return check;
}

}  // namespace

SceneCheckResult scene_check(const SceneCheckArguments& a) {
  const LabelledSet set = read_labelled_set(a.data);
  const std::vector<std::string> names =
      label_names(a.classes.empty() ? set.classes : read_class_list(a.classes), a.surfaces);
  return {set.train.size(), names, compare(a, set, names), a.confusion};
}

std::string to_json(const SceneCheckResult& result) {
  const LabelCheck& check = result.check;
  nlohmann::json report = {{"pictures", result.images},
                           {"pixels", check.pixels()},
                           {"pixel_accuracy", check.pixel_accuracy()},
                           {"class_accuracy", check.class_accuracy()},
                           {"mean_iou", check.mean_iou()}};
  if (!std::isnan(check.calibration_error()))
    report["calibration_error"] = check.calibration_error();
  const int n = check.classes();
  for (int c = 0; c < n; ++c) {
    const std::string& name = result.names[static_cast<std::size_t>(c)];
    if (!std::isnan(check.iou(c))) report["iou"][name] = check.iou(c);
    for (int d = 0; result.confusion && d <= n; ++d)
      report["confusion"][name].push_back(check.count(c, d));
  }
  return json_text(report, 2);
}

std::string to_text(const SceneCheckResult& result) {
  const LabelCheck& check = result.check;
  std::string text =
      fmt::format("{} images: pixel accuracy {:.4f}, class accuracy {:.4f}, mean IoU {:.4f}",
                  result.images, check.pixel_accuracy(), check.class_accuracy(), check.mean_iou());
  if (!std::isnan(check.calibration_error()))
    text += fmt::format(", calibration error {:.4f}", check.calibration_error());
  text += "\n";
  const int n = check.classes();
  for (int c = 0; c < n; ++c) {
    if (std::isnan(check.iou(c))) continue;
    text +=
        fmt::format("{:12} IoU {:.3f}", result.names[static_cast<std::size_t>(c)], check.iou(c));
    for (int d = 0; result.confusion && d <= n; ++d)
      text += fmt::format(" {:9}", check.count(c, d));
    text += "\n";
  }
  return text;
}

}  // namespace placegraph::apps
