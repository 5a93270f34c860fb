// What recognizing a place costs: describing an image, finding it among N stored views, and the
// filter over past images; and the memory of a view. bench_place_study FOLDER [--plot FILE] [N...]
// How the tiny image stands zoom and shift: bench_place_study FOLDER --robustness
#include <fmt/format.h>
#include <placegraph/eval/drawing/picture_bytes.h>
#include <placegraph/eval/plots/growth_plot.h>
#include <placegraph/frontend/places/cues/cue_grid.h>
#include <placegraph/frontend/places/place_recognizer.h>
#include <placegraph/frontend/places/place_view.h>
#include <placegraph/frontend/places/sequence_filter.h>
#include <placegraph/graph/core/random.h>
#include <placegraph/io/files/atomic_file.h>
#include <placegraph/io/files/image_file.h>
#include <placegraph/io/files/image_list.h>

#include <malloc.h>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <opencv2/core/utility.hpp>
#include <string>

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
  return bytes_of(view.tiny.front()) + bytes_of(view.gradients.front()) + bytes_of(view.colour) +
         bytes_of(view.coarse) + bytes_of(view.gabor) +
         2 * view.thumbnail.size() * sizeof(std::int16_t) +
         view.corners.size() * sizeof(Feature);
}

// A view like this one, not the same: a graph of copies would be no graph.
PlaceView another(PlaceView view, std::uint64_t number) {
  Random random(7, number);
  for (std::int16_t& value : view.thumbnail)
    value = static_cast<std::int16_t>(value + random.normal(0, 100));
  return view;
}

std::vector<Image> read_images(const std::string& folder, std::size_t most) {
  std::vector<Image> images;
  const std::vector<std::string> paths = list_images(folder);
  const std::size_t stride = std::max<std::size_t>(1, paths.size() / most);
  for (std::size_t i = 0; i < paths.size() && images.size() < most; i += stride) {
    const GreyAndColour image = read_image(paths[i]);
    images.push_back(image.colour.empty() ? image.grey : image.colour);
  }
  return images;
}

// A window of the image, `share` of its width and height, from `left` on (shares of what is left).
Image window(const Image& image, double share, double left, double top) {
  const int width = static_cast<int>(std::lround(share * image.cols));
  const int height = static_cast<int>(std::lround(share * image.rows));
  return image(cv::Rect(static_cast<int>(std::lround(left * (image.cols - width))),
                        static_cast<int>(std::lround(top * (image.rows - height))), width, height))
      .clone();
}

// Windows of 0.7 of the width are stored; queries are windows that are larger, smaller or beside,
// all of them of real pixels. Right is the same image or its neighbour in the folder.
void robustness(const std::string& folder) {
  constexpr double kShare = 0.7;
  const std::vector<Image> images = read_images(folder, 100);
  PlaceRecognizerOptions searching;
  searching.cues.colour = searching.cues.gradients = searching.cues.corners = 0;
  searching.cues.gabor = 0;
  const auto recall = [&](double left, double share, double query_left, bool search) {
    PlaceCueOptions cues = searching.cues;
    if (!search) cues.zoom = 1;
    std::vector<PlaceView> stored;
    for (const Image& image : images)
      stored.push_back(describe_place(window(image, kShare, left, 0.5), cues, false));
    int right = 0;
    for (std::size_t i = 0; i < images.size(); ++i) {
      const PlaceView query = describe_place(window(images[i], share, query_left, 0.5), cues, true);
      double most = -2;
      std::size_t best = 0;
      for (std::size_t k = 0; k < stored.size(); ++k) {
        const double similarity =
            search ? grid_similarity(query, stored[k], cues).tiny
                   : best_alignment(query.tiny.front(), stored[k].tiny.front(), {});
        if (similarity > most) {
          most = similarity;
          best = k;
        }
      }
      right += best + 1 >= i && best <= i + 1;
    }
    return static_cast<double>(right) / static_cast<double>(images.size());
  };
  for (const double zoom : {0.7, 0.8, 0.9, 1.0, 1.1, 1.2, 1.3, 1.4})
    fmt::print("zoom {:.1f}: pyramid {:.3f}, where it stands {:.3f}\n", zoom,
               recall(0.5, kShare / zoom, 0.5, true), recall(0.5, kShare / zoom, 0.5, false));
  for (const double shift : {0.0, 0.1, 0.2, 0.3, 0.4}) {
    const double left = shift * kShare / (1 - kShare);
    fmt::print("shift {:.0f} %: pyramid {:.3f}, where it stands {:.3f}\n", 100 * shift,
               recall(0, kShare, left, true), recall(0, kShare, left, false));
  }
}

void study(const std::string& folder, const std::vector<int>& sizes, const std::string& plot) {
  const PlaceRecognizerOptions options;
  const std::vector<Image> images = read_images(folder, kImages);
  const int count = static_cast<int>(images.size());
  std::vector<PlaceView> views(images.size());
  const double describing = cost_ms(
      count, [&](std::size_t i) { views[i] = describe_place(images[i], options.cues, true); });
  fmt::print("{} images {}x{}; describing one {:.2f} ms; a stored view {:.1f} kB\n", count,
             images.front().cols, images.front().rows, describing,
             1e-3 * static_cast<double>(bytes_of(views.front())));
  PlaceRecognizer recognizer(options);
  GrowthCurve all{"all", {}, {}}, looking{"query", {}, {}}, past{"filter", {}, {}};
  for (const int size : sizes) {
    while (recognizer.size() < size)
      recognizer.add(another(views[static_cast<std::size_t>(recognizer.size()) % views.size()],
                             static_cast<std::uint64_t>(recognizer.size())));
    std::vector<PlaceSimilarity> list;
    const double query =
        cost_ms(count, [&](std::size_t i) { list = recognizer.query(views[i], 0, size - 1); });
    // The views that come next, which the graph takes in; the size is the next one's begin.
    const double adding = cost_ms(count, [&](std::size_t i) {
      recognizer.add(another(views[i], static_cast<std::uint64_t>(recognizer.size())));
    });
    SequenceFilter filter{SequenceFilterOptions{}};
    const double filtering =
        cost_ms(count, [&](std::size_t) { (void)filter.update(list, 0, size - 1); });
    fmt::print("{:>7} views: query {:.2f} ms, filter {:.2f} ms, adding {:.2f} ms, all {:.2f} ms\n",
               size, query, filtering, adding, describing + query + filtering + adding);
    for (GrowthCurve* curve : {&all, &looking, &past}) curve->sizes.push_back(size);
    all.values.push_back(describing + query + filtering + adding);
    looking.values.push_back(query);
    past.values.push_back(filtering);
  }
  if (!plot.empty()) {
    AtomicFile file(plot);
    const std::string svg =
        to_svg(GrowthPlot{"What recognizing a place costs",
                          "stored views",
                          {{"CPU time of an image [ms]", {all, looking, past}}}});
    file.stream() << picture_bytes(svg, plot);
    file.commit();
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
  if (argc == 3 && std::string(argv[2]) == "--robustness") {
    placegraph::robustness(argv[1]);
    return 0;
  }
  std::vector<int> sizes;
  std::string plot;
  for (int i = 2; i < argc; ++i)
    if (std::string(argv[i]) == "--plot" && i + 1 < argc)
      plot = argv[++i];
    else
      sizes.push_back(std::atoi(argv[i]));
  if (sizes.empty()) sizes = {1000, 10000, 100000};
  placegraph::study(argv[1], sizes, plot);
  return 0;
}
