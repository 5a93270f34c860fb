#include <placegraph/frontend/places/cues/colour_histogram.h>
#include <placegraph/frontend/places/cues/corner_agreement.h>
#include <placegraph/frontend/places/cues/cue_grid.h>
#include <placegraph/frontend/places/cues/gabor_statistics.h>
#include <placegraph/frontend/places/cues/gradient_layout.h>
#include <placegraph/frontend/places/cues/tiny_image.h>
#include <placegraph/frontend/places/place_view.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace placegraph {
namespace {

/// Number of corners that agree by chance (docs/place_recognition.md); as many or fewer add
/// nothing.
constexpr int kCornerFloor = 12;
/// Width of the shrunk image [px] (docs/place_recognition.md). Chosen.
constexpr int kTinyColumns = 24;
/// Loss of similarity for a shift by the whole image: a tenth (docs/place_recognition.md). Chosen.
constexpr double kShiftLoss = 0.1;

/// Shifts of a quarter of the tiny image's width and height, of a third of the gradients' cells.
constexpr int kTinyShiftX = 6, kTinyShiftY = 4, kGradientShiftX = 4, kGradientShiftY = 3;

double best_over_scales(const std::vector<CueGrid>& query, const CueGrid& stored,
                        const GridSearch& search) {
  double best = -1;
  for (const CueGrid& grid : query) best = std::max(best, best_alignment(grid, stored, search));
  return best;
}

/// Appends the mean over blocks of cells, of length `weight`.
void append_pooled(const CueGrid& grid, int columns, int rows, double weight,
                   std::vector<float>& code) {
  if (grid.empty()) return;
  std::vector<float> sums(static_cast<std::size_t>(columns * rows * grid.channels), 0);
  for (int y = 0; y < grid.rows; ++y)
    for (int x = 0; x < grid.columns; ++x) {
      const int block = y * rows / grid.rows * columns + x * columns / grid.columns;
      for (int c = 0; c < grid.channels; ++c)
        sums[static_cast<std::size_t>(block * grid.channels + c)] +=
            grid.values[static_cast<std::size_t>((y * grid.columns + x) * grid.channels + c)];
    }
  double squares = 0;
  for (const float sum : sums) squares += static_cast<double>(sum) * sum;
  const auto scale = static_cast<float>(weight / std::sqrt(std::max(squares, 1e-12)));
  for (const float sum : sums) code.push_back(sum * scale);
}

// Thumbnail with few cells, so that views from slightly different positions are similar; colours of
// the image as a whole.
std::vector<std::int16_t> thumbnail_of(const PlaceView& view) {
  std::vector<float> code;
  append_pooled(view.colour, 1, 1, 1, code);
  append_pooled(view.coarse, 4, 3, 1, code);
  if (!view.gradients.empty()) append_pooled(view.gradients.front(), 4, 3, 1, code);
  // 2^13 - 1. Chosen.
  constexpr float kUnit = 8191;
  std::vector<std::int16_t> thumbnail;
  thumbnail.reserve(code.size());
  for (const float value : code)
    thumbnail.push_back(static_cast<std::int16_t>(std::lround(value * kUnit)));
  return thumbnail;
}

}  // namespace

PlaceView describe_place(const Image& image, const PlaceCueOptions& options, bool query) {
  require(!image.empty() && (image.type() == CV_8UC1 || image.type() == CV_8UC3),
          "describe_place: grey or BGR image needed");
  cv::Mat grey = image;
  if (image.channels() == 3) cv::cvtColor(image, grey, cv::COLOR_BGR2GRAY);
  std::vector<double> scales = {1};
  if (query && options.zoom > 1) scales = {1, 1 / options.zoom, options.zoom};
  PlaceView view;
  // Large images are shrunk once: the grids use a hundred pixels of their width.
  constexpr int kWidth = 160;
  cv::Mat sized = image, sized_grey = grey;
  if (image.cols > kWidth) {
    const cv::Size size(kWidth, std::max(1, image.rows * kWidth / image.cols));
    cv::resize(image, sized, size, 0, 0, cv::INTER_AREA);
    cv::resize(grey, sized_grey, size, 0, 0, cv::INTER_AREA);
  }
  for (const double scale : scales) {
    if (options.tiny > 0) view.tiny.push_back(tiny_image_cue(sized, kTinyColumns, scale));
    if (options.gradients > 0) view.gradients.push_back(gradient_layout_cue(sized_grey, {}, scale));
  }
  view.coarse = tiny_image_cue(sized, kTinyColumns / 2);
  if (options.colour > 0 && image.channels() == 3) view.colour = colour_histogram_cue(sized);
  if (options.gabor > 0) view.gabor = gabor_cue(sized_grey);
  if (options.corners > 0) view.corners = corners_of_view(grey, options.corner_agreement);
  view.thumbnail = thumbnail_of(view);
  return view;
}

GridSimilarity grid_similarity(const PlaceView& query, const PlaceView& stored,
                               const PlaceCueOptions& options) {
  require(query.colour.empty() == stored.colour.empty(),
          "grid_similarity: one view is grey and one in colour");
  GridSimilarity similarity;
  if (options.tiny > 0)
    similarity.tiny =
        options.tiny *
        best_over_scales(
            query.tiny, stored.tiny.front(),
            {.shift_x = kTinyShiftX, .shift_y = kTinyShiftY, .step = 2, .loss = kShiftLoss});
  if (!query.colour.empty())
    similarity.colour =
        options.colour * best_alignment(query.colour, stored.colour, {.shift_x = 1, .shift_y = 1});
  if (options.gradients > 0)
    similarity.gradients =
        options.gradients *
        best_over_scales(
            query.gradients, stored.gradients.front(),
            {.shift_x = kGradientShiftX, .shift_y = kGradientShiftY, .loss = kShiftLoss});
  if (options.gabor > 0)
    similarity.gabor =
        options.gabor *
        best_alignment(query.gabor, stored.gabor, {.shift_x = 1, .shift_y = 1, .loss = kShiftLoss});
  return similarity;
}

double corner_similarity(const PlaceView& query, const PlaceView& stored,
                         const PlaceCueOptions& options) {
  const int agreeing = corner_agreement(query.corners, stored.corners, options.corner_agreement);
  return options.corners *
         std::log(static_cast<double>(std::max(agreeing, kCornerFloor)) / kCornerFloor);
}

double place_similarity(const PlaceView& query, const PlaceView& stored,
                        const PlaceCueOptions& options) {
  return grid_similarity(query, stored, options).sum() + corner_similarity(query, stored, options);
}

double coarse_similarity(const PlaceView& query, const PlaceView& stored,
                         const PlaceCueOptions& options) {
  double similarity =
      best_alignment(query.coarse, stored.coarse,
                     {.shift_x = kTinyShiftX / 2, .shift_y = kTinyShiftY / 2, .loss = kShiftLoss});
  if (!query.colour.empty() && !stored.colour.empty())
    similarity += options.colour * best_alignment(query.colour, stored.colour, {});
  return similarity;
}

}  // namespace placegraph
