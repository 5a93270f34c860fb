#include "apps/image/scene/scene_images.h"

#include <fmt/format.h>
#include <placegraph/eval/drawing/picture_bytes.h>
#include <placegraph/eval/drawing/picture_legend.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/parallel.h>
#include <placegraph/graph/scene/street_map.h>
#include <placegraph/graph/text/json_text.h>
#include <placegraph/io/files/image_file.h>
#include <placegraph/io/files/image_list.h>
#include <placegraph/io/files/picture_file.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <opencv2/core/utility.hpp>
#include <opencv2/imgproc.hpp>
#include <set>
#include <utility>

#include "apps/support/image_range.h"
#include "apps/support/output.h"
#include "apps/support/progress.h"
#include "apps/support/usage.h"

namespace placegraph::apps {
namespace {

namespace fs = std::filesystem;

/// Number of pixels of each class, then of unknown ones.
std::vector<std::int64_t> pixels_by_class(const Image& labels, std::size_t classes) {
  std::vector<std::int64_t> pixels(classes + 1, 0);
  for (int v = 0; v < labels.rows; ++v)
    for (int u = 0; u < labels.cols; ++u) ++pixels[labels.at<std::uint8_t>(v, u)];
  return pixels;
}

/// Labels an image and writes its files; as pixels_by_class().
std::vector<std::int64_t> label_image(const std::string& path, const SceneImageArguments& a,
                                      const std::vector<std::string>& classes,
                                      const std::function<SceneLabels(const Image&)>& label) {
  const GreyAndColour read = read_image(path);
  const Image image = read.colour.empty() ? read.grey : read.colour;
  SceneLabels found;
  try {
    found = label(image);
  } catch (const ArgumentError& error) {
    throw FileError(path, error.what());
  }
  const std::string out = (fs::path(a.out) / fs::path(path).stem()).string();
  const bool ids = a.ids || a.draw;
  if (ids) write_png(out + ".png", found.labels);
  if (a.confidence) {
    Image bytes;
    found.confidence.convertTo(bytes, CV_8U, 255);
    write_png(out + ".confidence.png", bytes);
  }
  if (!ids || a.draw) {
    const std::string file = out + (ids ? ".drawn.png" : ".png");
    Image bgr = image;
    if (bgr.channels() == 1) cv::cvtColor(image, bgr, cv::COLOR_GRAY2BGR);
    write_png(file, draw_labels(bgr, found.labels, classes, file));
  }
  return pixels_by_class(found.labels, classes.size());
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

Image draw_labels(const Image& bgr, const Image& labels, const std::vector<std::string>& classes,
                  const std::string& wanted) {
  const std::vector<std::int64_t> pixels = pixels_by_class(labels, classes.size());
  Image drawn = bgr.clone();
  std::vector<LegendEntry> legend;
  const auto add_entry = [&](const std::string& name, std::int64_t count, Colour colour) {
    const double share = 100.0 * static_cast<double>(count) / static_cast<double>(labels.total());
    const std::string text = share < 1 ? "< 1" : fmt::format("{:.0f}", share);
    if (count > 0) legend.push_back(area_entry(fmt::format("{} {} %", name, text), colour));
  };
  for (std::size_t c = 0; c < classes.size(); ++c) {
    const auto rgb = class_colour(classes[c], static_cast<int>(c));
    const cv::Vec3b colour(rgb[2], rgb[1], rgb[0]);
    for (int v = 0; v < labels.rows; ++v)
      for (int u = 0; u < labels.cols; ++u)
        if (labels.at<std::uint8_t>(v, u) == c) {
          constexpr double kShare = 0.6;
          auto& pixel = drawn.at<cv::Vec3b>(v, u);
          for (int k = 0; k < 3; ++k)
            pixel[k] = cv::saturate_cast<uchar>(kShare * colour[k] + (1 - kShare) * pixel[k]);
        }
    add_entry(classes[c], pixels[c], {rgb[0], rgb[1], rgb[2]});
  }
  add_entry("unknown (not coloured)", pixels.back(), {255, 255, 255});
  return with_legend(drawn, legend, wanted);
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
  if (!a.ids || a.draw) require_drawings(a.out);
  const OutputFolder folder(a.out);
  const Stopwatch watch;
  std::vector<std::vector<std::int64_t>> pixels(images.size());
  Progress progress("labelling", static_cast<std::int64_t>(images.size()), "images");
  const auto part = static_cast<std::size_t>(4 * a.threads);
  for (std::size_t begin = 0; begin < images.size(); begin += part) {
    const std::size_t count = std::min(part, images.size() - begin);
    parallel_for(static_cast<int>(count), a.threads, [&](int k) {
      const std::size_t at = begin + static_cast<std::size_t>(k);
      pixels[at] = label_image(images[at], a, classes,
                               [&](const Image& picture) { return label(at, picture); });
    });
    progress.update(static_cast<std::int64_t>(begin + count));
  }
  SceneImageResult result{a.out, a.ids || a.draw, classes,
                          std::vector<std::int64_t>(classes.size() + 1, 0), images.size()};
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
  return fmt::format("{}, written to {} {}\n", text, result.out,
                     result.ids ? "as class numbers (dark images)" : "in colours (--ids: numbers)");
}

std::string to_json(const SceneImageResult& result) {
  nlohmann::json report = {{"pictures", result.images}, {"ms_per_picture", result.cpu_ms_an_image}};
  for (const auto& [name, share] : shares_of(result)) report["shares"][name] = share;
  return json_text(report, 2);
}

}  // namespace placegraph::apps
