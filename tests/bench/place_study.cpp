// What recognizing a place costs: describing an image, finding it among N stored views, and the
// filter over past images; and the memory of a view. bench_place_study FOLDER [N...]
#include <fmt/format.h>
#include <placegraph/frontend/places/place_recognizer.h>
#include <placegraph/frontend/places/sequence_filter.h>
#include <placegraph/io/image_file.h>
#include <placegraph/io/image_list.h>

#include <malloc.h>
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <opencv2/core/utility.hpp>

namespace placegraph {
namespace {

constexpr int kImages = 60;

double cpu_ms() { return 1e3 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

// The median CPU time over the images.
template <class Body>
double cost_ms(int images, const Body& body) {
  std::vector<double> times;
  for (int i = 0; i < images; ++i) {
    const double begin = cpu_ms();
    body(static_cast<std::size_t>(i));
    times.push_back(cpu_ms() - begin);
  }
  return median(times);
}

std::size_t bytes_of(const CueGrid& grid) {
  return grid.values.size() * sizeof(std::int16_t) + grid.energy.size() * sizeof(std::int64_t);
}

std::size_t bytes_of(const PlaceView& view) {
  std::size_t bytes = bytes_of(view.tiny.front()) + bytes_of(view.gradients.front()) +
                      bytes_of(view.colour) + bytes_of(view.coarse);
  return bytes + 2 * view.glance.size() * sizeof(std::int16_t) +
         view.corners.size() * sizeof(Feature);
}

void study(const std::string& folder, const std::vector<int>& sizes) {
  const PlaceRecognizerOptions options;
  std::vector<Image> images;
  const std::vector<std::string> paths = list_images(folder);
  const std::size_t stride = std::max<std::size_t>(1, paths.size() / kImages);
  for (std::size_t i = 0; i < paths.size() && images.size() < kImages; i += stride) {
    const GreyAndColour image = read_image(paths[i]);
    images.push_back(image.colour.empty() ? image.grey : image.colour);
  }
  const int count = static_cast<int>(images.size());
  std::vector<PlaceView> views(images.size());
  const double describing = cost_ms(
      count, [&](std::size_t i) { views[i] = describe_place(images[i], options.cues, true); });
  fmt::print("{} images {}x{}; describing one {:.2f} ms; a stored view {:.1f} kB\n", count,
             images.front().cols, images.front().rows, describing,
             1e-3 * static_cast<double>(bytes_of(views.front())));
  PlaceRecognizer recognizer(options);
  for (const int size : sizes) {
    while (recognizer.size() < size)
      recognizer.add(views[static_cast<std::size_t>(recognizer.size()) % views.size()]);
    std::vector<PlaceLikeness> list;
    const double query =
        cost_ms(count, [&](std::size_t i) { list = recognizer.query(views[i], 0, size - 1); });
    SequenceFilter filter{SequenceFilterOptions{}};
    const double filtering =
        cost_ms(count, [&](std::size_t) { (void)filter.update(list, 0, size - 1); });
    fmt::print("{:>7} views: query {:.2f} ms, filter {:.2f} ms, all {:.2f} ms\n", size, query,
               filtering, describing + query + filtering);
  }
}

}  // namespace
}  // namespace placegraph

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fputs("bench_place_study FOLDER [VIEWS...]\n", stderr);
    return 2;
  }
  mallopt(M_MMAP_THRESHOLD, 64 << 20);  // as the program does
  mallopt(M_TRIM_THRESHOLD, 256 << 20);
  cv::setNumThreads(1);
  std::vector<int> sizes;
  for (int i = 2; i < argc; ++i) sizes.push_back(std::atoi(argv[i]));
  if (sizes.empty()) sizes = {1000, 10000};
  placegraph::study(argv[1], sizes);
  return 0;
}
