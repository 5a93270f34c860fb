#include "apps/image/scene/street_images.h"

#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/parallel.h>
#include <placegraph/io/files/image_file.h>
#include <placegraph/pipeline/environment.h>

#include <algorithm>
#include <opencv2/core/utility.hpp>

#include "apps/support/progress.h"

namespace placegraph::apps {
namespace {

/// A lens of about 58 degrees: the share of edges along a Manhattan frame, for which it matters,
/// has no weight.
Camera usual_camera(const Image& image) {
  Camera camera;
  camera.width = image.cols;
  camera.height = image.rows;
  camera.fx = camera.fy = 0.9 * camera.width;
  camera.cx = 0.5 * (camera.width - 1);
  camera.cy = 0.5 * (camera.height - 1);
  return camera;
}

EnvironmentProbabilities kinds_of(const std::string& path,
                                  const std::shared_ptr<const SceneModel>& surfaces) {
  const GreyAndColour image = read_image(path);
  try {
    Frame frame;
    frame.image = image.grey;
    frame.colour = image.colour;
    return built_in_environments().probabilities(
        evidence_of_view(frame, usual_camera(image.grey), surfaces));
  } catch (const ArgumentError& error) {
    throw FileError(path, error.what());
  }
}

}  // namespace

std::vector<double> street_probabilities(const std::vector<std::string>& images,
                                         const std::shared_ptr<const SceneModel>& surfaces,
                                         bool in_sequence, int threads) {
  constexpr std::size_t kFewest = 15, kLongest = 5;
  const std::size_t step =
      in_sequence ? std::clamp<std::size_t>(images.size() / kFewest, 1, kLongest) : 1;
  const std::size_t count = (images.size() + step - 1) / step;
  cv::setNumThreads(1);
  std::vector<EnvironmentProbabilities> kinds(count);
  Progress progress("judging the surroundings", static_cast<std::int64_t>(count), "images");
  const auto part = static_cast<std::size_t>(4 * threads);
  for (std::size_t begin = 0; begin < count; begin += part) {
    const std::size_t size = std::min(part, count - begin);
    parallel_for(static_cast<int>(size), threads, [&](int k) {
      const std::size_t at = begin + static_cast<std::size_t>(k);
      kinds[at] = kinds_of(images[at * step], surfaces);
    });
    progress.update(static_cast<std::int64_t>(begin + size));
  }
  if (in_sequence && count > 1) kinds = smoothed_kinds(kinds);
  std::vector<double> street;
  for (std::size_t i = 0; i < images.size(); ++i)
    street.push_back(street_probability(kinds[std::min((i + step / 2) / step, count - 1)]));
  return street;
}

}  // namespace placegraph::apps
