#include "apps/scene/scene_pictures.h"

#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/parallel.h>
#include <placegraph/io/files/image_file.h>
#include <placegraph/io/files/image_list.h>

#include <CLI/CLI.hpp>
#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <opencv2/core/utility.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <set>

#include "apps/support/image_folder_of.h"
#include "apps/support/output.h"
#include "apps/support/progress.h"
#include "apps/support/usage.h"

namespace placegraph::apps {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> pictures_of(const std::string& input) {
  if (fs::is_directory(input)) return list_images(image_folder_of(input));
  return {input};
}

struct Tally {
  std::vector<std::int64_t> pixels;  ///< of each class, then unknown ones
  double ms = 0;                     ///< of the processor
};

Tally label_picture(const std::string& path, const ScenePictureArguments& a, std::size_t classes,
                    const std::function<SceneLabels(const SceneView&)>& label) {
  const GreyAndColour read = read_image(path);
  const Image picture = read.colour.empty() ? read.grey : read.colour;
  SceneLabels found;
  try {
    found = label(view_scene(picture));
  } catch (const ArgumentError& error) {
    throw FileError(path, error.what());
  }
  Tally tally{std::vector<std::int64_t>(classes + 1, 0), 0};
  for (int v = 0; v < found.labels.rows; ++v)
    for (int u = 0; u < found.labels.cols; ++u) ++tally.pixels[found.labels.at<std::uint8_t>(v, u)];
  const fs::path out = fs::path(a.out) / fs::path(path).stem();
  write_png(out.string() + ".png", found.labels);
  if (a.confidence) {
    Image bytes;
    found.confidence.convertTo(bytes, CV_8U, 255);
    write_png(out.string() + ".confidence.png", bytes);
  }
  if (a.draw) {
    Image bgr = picture;
    if (bgr.channels() == 1) cv::cvtColor(picture, bgr, cv::COLOR_GRAY2BGR);
    write_png(out.string() + ".drawn.png",
              draw_labels(bgr, found.labels, static_cast<int>(classes)));
  }
  return tally;
}

void print_tally(const Tally& all, const ScenePictureArguments& a,
                 const std::vector<std::string>& classes, std::size_t pictures) {
  double sum = 0;
  for (const std::int64_t pixels : all.pixels) sum += static_cast<double>(pixels);
  nlohmann::json report = {{"pictures", pictures},
                           {"ms_per_picture", all.ms / static_cast<double>(pictures)}};
  std::string text = fmt::format("{} pictures, {:.0f} ms of the processor each:", pictures,
                                 all.ms / static_cast<double>(pictures));
  for (std::size_t c = 0; c <= classes.size(); ++c) {
    const std::string name = c < classes.size() ? classes[c] : "unknown";
    const double share = static_cast<double>(all.pixels[c]) / sum;
    report["shares"][name] = share;
    if (all.pixels[c] > 0) text += fmt::format(" {} {:.3f}", name, share);
  }
  if (a.json)
    fmt::print("{}\n", report.dump(2));
  else
    fmt::print("{}, written to {}\n", text, a.out);
}

}  // namespace

void write_png(const std::string& path, const Image& image) {
  std::vector<std::uint8_t> bytes;
  cv::imencode(".png", image, bytes);
  write_file(path, {bytes.begin(), bytes.end()});
}

Image draw_labels(const Image& bgr, const Image& labels, int classes) {
  Image table(1, 256, CV_8UC3, cv::Scalar::all(0));
  for (int c = 0; c < classes; ++c) {
    Image colour(1, 1, CV_8UC3, cv::Scalar(c * 180.0 / classes, 200, 230));
    cv::cvtColor(colour, colour, cv::COLOR_HSV2BGR);
    table.at<cv::Vec3b>(0, c) = colour.at<cv::Vec3b>(0, 0);
  }
  Image three, colours, drawn;
  cv::merge(std::array<Image, 3>{labels, labels, labels}, three);
  cv::LUT(three, table, colours);
  cv::addWeighted(bgr, 0.5, colours, 0.5, 0, drawn);
  return drawn;
}

void add_scene_picture_options(CLI::App& command, ScenePictureArguments& a) {
  command.add_option("INPUT", a.input, "an image, or a folder of them (or with them in images/)")
      ->required();
  command.add_option("--out", a.out, "folder for NAME.png, a class number a pixel")->required();
  command.add_option("--model", a.model, "in place of the one that came with the program");
  command
      .add_option("--unknown-below", a.unknown_below,
                  "less sure pixels get the number after the last class")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  command.add_flag("--relations", a.relations,
                   "let the table of what lies above and beside what count too");
  command.add_flag("--confidence", a.confidence, "write NAME.confidence.png too, 255 = certain");
  command.add_flag("--draw", a.draw, "write NAME.drawn.png too, the classes in colours");
  command.add_option("--threads", a.threads, "pictures at a time")
      ->check(CLI::Range(1, 64))
      ->capture_default_str();
  command.add_flag("--json", a.json, "a report for machines");
  command.add_flag("--force", a.force, "write into a folder that is not empty");
}

void label_pictures(const ScenePictureArguments& a, const std::vector<std::string>& classes,
                    const std::function<SceneLabels(const SceneView&)>& label) {
  cv::setNumThreads(1);
  const std::vector<std::string> pictures = pictures_of(a.input);
  std::set<std::string> names;
  for (const std::string& path : pictures)
    if (!names.insert(fs::path(path).stem().string()).second)
      throw FileError(path, "another picture has the same name");
  require_free_folder(a.out, a.force);
  const OutputFolder folder(a.out);
  const Stopwatch watch;
  std::vector<Tally> tallies(pictures.size());
  Progress progress("labelling", static_cast<std::int64_t>(pictures.size()), "pictures");
  const auto part = static_cast<std::size_t>(4 * a.threads);
  for (std::size_t begin = 0; begin < pictures.size(); begin += part) {
    const std::size_t count = std::min(part, pictures.size() - begin);
    parallel_for(static_cast<int>(count), a.threads, [&](int k) {
      const std::size_t at = begin + static_cast<std::size_t>(k);
      tallies[at] = label_picture(pictures[at], a, classes.size(), label);
    });
    progress.update(static_cast<std::int64_t>(begin + count));
  }
  Tally all{std::vector<std::int64_t>(classes.size() + 1, 0), 0};
  for (const Tally& tally : tallies)
    for (std::size_t c = 0; c < all.pixels.size(); ++c) all.pixels[c] += tally.pixels[c];
  all.ms = watch.cpu_ms();
  print_tally(all, a, classes, pictures.size());
}

}  // namespace placegraph::apps
