#include "apps/scene/scene_images.h"

#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/internal/core/json_text.h>
#include <placegraph/graph/internal/core/parallel.h>
#include <placegraph/io/files/image_file.h>
#include <placegraph/io/internal/files/image_list.h>

#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <opencv2/core/utility.hpp>
#include <opencv2/imgproc.hpp>
#include <set>
#include <utility>

#include "apps/support/image_folder_of.h"
#include "apps/support/output.h"
#include "apps/support/progress.h"
#include "apps/support/usage.h"
#include "apps/support/write_png.h"

namespace placegraph::apps {
namespace {

namespace fs = std::filesystem;

/// Number of pixels of each class, then of unknown ones.
std::vector<std::int64_t> label_image(const std::string& path, const SceneImageArguments& a,
                                      std::size_t classes,
                                      const std::function<SceneLabels(const SceneView&)>& label) {
  const GreyAndColour read = read_image(path);
  const Image image = read.colour.empty() ? read.grey : read.colour;
  SceneLabels found;
  try {
    found = label(view_scene(image));
  } catch (const ArgumentError& error) {
    throw FileError(path, error.what());
  }
  std::vector<std::int64_t> pixels(classes + 1, 0);
  for (int v = 0; v < found.labels.rows; ++v)
    for (int u = 0; u < found.labels.cols; ++u) ++pixels[found.labels.at<std::uint8_t>(v, u)];
  const fs::path out = fs::path(a.out) / fs::path(path).stem();
  write_png(out.string() + ".png", found.labels);
  if (a.confidence) {
    Image bytes;
    found.confidence.convertTo(bytes, CV_8U, 255);
    write_png(out.string() + ".confidence.png", bytes);
  }
  if (a.draw) {
    Image bgr = image;
    if (bgr.channels() == 1) cv::cvtColor(image, bgr, cv::COLOR_GRAY2BGR);
    write_png(out.string() + ".drawn.png",
              draw_labels(bgr, found.labels, static_cast<int>(classes)));
  }
  return pixels;
}

/// Number of all pixels by class, then of unknown ones.
std::vector<std::pair<std::string, double>> shares_of(const SceneImageResult& result) {
  double sum = 0;
  for (const std::int64_t pixels : result.pixels) sum += static_cast<double>(pixels);
  std::vector<std::pair<std::string, double>> shares;
  for (std::size_t c = 0; c < result.pixels.size(); ++c)
    shares.emplace_back(c < result.classes.size() ? result.classes[c] : "unknown",
                        static_cast<double>(result.pixels[c]) / sum);
  return shares;
}

}  // namespace

std::vector<std::string> image_paths_of(const std::string& input) {
  if (fs::is_directory(input)) return list_images(image_folder_of(input));
  return {input};
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

SceneImageResult label_images(const SceneImageArguments& a, const std::vector<std::string>& classes,
                              const ImageLabeller& label) {
  cv::setNumThreads(1);
  const std::vector<std::string> images = image_paths_of(a.input);
  std::set<std::string> names;
  for (const std::string& path : images)
    if (!names.insert(fs::path(path).stem().string()).second)
      throw FileError(path, "another image has the same name");
  require_free_folder(a.out, a.force);
  const OutputFolder folder(a.out);
  const Stopwatch watch;
  std::vector<std::vector<std::int64_t>> pixels(images.size());
  Progress progress("labelling", static_cast<std::int64_t>(images.size()), "images");
  const auto part = static_cast<std::size_t>(4 * a.threads);
  for (std::size_t begin = 0; begin < images.size(); begin += part) {
    const std::size_t count = std::min(part, images.size() - begin);
    parallel_for(static_cast<int>(count), a.threads, [&](int k) {
      const std::size_t at = begin + static_cast<std::size_t>(k);
      pixels[at] = label_image(images[at], a, classes.size(),
                               [&](const SceneView& view) { return label(at, view); });
    });
    progress.update(static_cast<std::int64_t>(begin + count));
  }
  SceneImageResult result{a.out, classes, std::vector<std::int64_t>(classes.size() + 1, 0),
                          images.size()};
  for (const std::vector<std::int64_t>& of_image : pixels)
    for (std::size_t c = 0; c < of_image.size(); ++c) result.pixels[c] += of_image[c];
  result.cpu_ms_an_image = watch.cpu_ms() / static_cast<double>(images.size());
  return result;
}

std::string to_text(const SceneImageResult& result) {
  std::string text =
      fmt::format("{} images, {:.0f} ms CPU each:", result.images, result.cpu_ms_an_image);
  for (const auto& [name, share] : shares_of(result))
    if (share > 0) text += fmt::format(" {} {:.3f}", name, share);
  return fmt::format("{}, written to {} as class numbers (dark images; --draw: in colours)\n", text,
                     result.out);
}

std::string to_json(const SceneImageResult& result) {
  nlohmann::json report = {{"pictures", result.images}, {"ms_per_picture", result.cpu_ms_an_image}};
  for (const auto& [name, share] : shares_of(result)) report["shares"][name] = share;
  return json_text(report, 2);
}

}  // namespace placegraph::apps
