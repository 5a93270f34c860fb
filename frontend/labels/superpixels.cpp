#include <placegraph/frontend/labels/superpixels.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/image/picture_plugin.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace placegraph {

void SuperpixelOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, SuperpixelOptions& o) {
  field("side_px", o.side_px, "approximate side of a superpixel", {4, 200});
  field("ruler", o.ruler, "compactness of the superpixels; larger is more compact", {1, 200});
  field("iterations", o.iterations, "number of iterations of the search", {1, 50});
}

namespace {

struct Touch {
  std::uint64_t pair;  ///< a << 32 | b
  int kind;            ///< 0 beside, 1 a above b, 2 a below b
};

void add_touch(std::vector<Touch>& touches, int first, int second, bool vertical) {
  if (first == second) return;
  const auto a = static_cast<std::uint64_t>(std::min(first, second));
  const auto b = static_cast<std::uint64_t>(std::max(first, second));
  const int kind = !vertical ? 0 : first < second ? 1 : 2;
  touches.push_back({a << 32 | b, kind});
}

std::vector<SuperpixelBorder> borders_of(const Image& index) {
  std::vector<Touch> touches;
  for (int v = 0; v < index.rows; ++v) {
    const int* row = index.ptr<int>(v);
    const int* next = v + 1 < index.rows ? index.ptr<int>(v + 1) : nullptr;
    for (int u = 0; u < index.cols; ++u) {
      if (u + 1 < index.cols) add_touch(touches, row[u], row[u + 1], false);
      if (next) add_touch(touches, row[u], next[u], true);
    }
  }
  std::sort(touches.begin(), touches.end(),
            [](const Touch& x, const Touch& y) { return x.pair < y.pair; });
  std::vector<SuperpixelBorder> borders;
  std::uint64_t last = ~0ull;
  for (const Touch& touch : touches) {
    if (touch.pair != last)
      borders.push_back(
          {static_cast<int>(touch.pair >> 32), static_cast<int>(touch.pair & 0xffffffffu)});
    last = touch.pair;
    SuperpixelBorder& border = borders.back();
    ++(touch.kind == 0 ? border.beside : touch.kind == 1 ? border.above : border.below);
  }
  return borders;
}

std::vector<RegionShape> shapes_of(const Image& index, int count) {
  struct Sums {
    std::int64_t n = 0, u = 0, v = 0, uu = 0, uv = 0, vv = 0;
  };
  std::vector<Sums> sums(static_cast<std::size_t>(count));
  std::vector<RegionShape> shapes(sums.size());
  for (RegionShape& s : shapes) s.min_u = s.min_v = 1 << 30, s.max_u = s.max_v = -1;
  for (int v = 0; v < index.rows; ++v) {
    const int* row = index.ptr<int>(v);
    for (int u = 0; u < index.cols; ++u) {
      Sums& s = sums[static_cast<std::size_t>(row[u])];
      RegionShape& shape = shapes[static_cast<std::size_t>(row[u])];
      ++s.n;
      s.u += u, s.v += v, s.uu += u * u, s.uv += u * v, s.vv += v * v;
      shape.min_u = std::min(shape.min_u, u);
      shape.max_u = std::max(shape.max_u, u);
      shape.min_v = std::min(shape.min_v, v);
      shape.max_v = std::max(shape.max_v, v);
    }
  }
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const Sums& s = sums[i];
    const double n = static_cast<double>(std::max<std::int64_t>(1, s.n));
    const double u = static_cast<double>(s.u) / n, v = static_cast<double>(s.v) / n;
    shapes[i].area_px = static_cast<int>(s.n);
    shapes[i].u = static_cast<float>(u);
    shapes[i].v = static_cast<float>(v);
    shapes[i].uu = static_cast<float>(static_cast<double>(s.uu) / n - u * u);
    shapes[i].uv = static_cast<float>(static_cast<double>(s.uv) / n - u * v);
    shapes[i].vv = static_cast<float>(static_cast<double>(s.vv) / n - v * v);
  }
  return shapes;
}

/// Logarithms stretched to the whole range, so that dark regions have borders too.
Image brightened(const Image& bgr) {
  Image table(1, 256, CV_8UC1), result;
  const double most = std::log(1 + 255.0 / 20);
  for (int i = 0; i < 256; ++i)
    table.at<std::uint8_t>(0, i) =
        cv::saturate_cast<std::uint8_t>(255 * std::log(1 + i / 20.0) / most);
  cv::LUT(bgr, table, result);
  return result;
}

}  // namespace

Superpixels cut_superpixels(const Image& bgr, const SuperpixelOptions& options) {
  options.check();
  require(bgr.type() == CV_8UC3, "cut_superpixels: needs a CV_8UC3 image");
  require(std::min(bgr.rows, bgr.cols) >= 2 * options.side_px,
          "cut_superpixels: the image is smaller than two superpixels");
  Image lab;
  cv::cvtColor(brightened(bgr), lab, cv::COLOR_BGR2Lab);
  Image index;
  const int count = picture_plugin("superpixels")
                        .cut_superpixels(lab, options.side_px, static_cast<float>(options.ruler),
                                         options.iterations, index);
  if (count == 0) throw Error("cut_superpixels: the image has no superpixels");
  return superpixels_of_index(index, count);
}

Superpixels superpixels_of_index(const Image& index, int count) {
  require(index.type() == CV_32SC1 && !index.empty() && count > 0,
          "superpixels_of_index: needs a CV_32SC1 image");
  constexpr int kStep = Superpixels::kCoarse;
  Superpixels result;
  result.index = index;
  result.count = count;
  result.rows = index.rows;
  result.cols = index.cols;
  result.coarse = Image(std::max(1, index.rows / kStep), std::max(1, index.cols / kStep), CV_32SC1);
  for (int v = 0; v < result.coarse.rows; ++v)
    for (int u = 0; u < result.coarse.cols; ++u)
      result.coarse.at<int>(v, u) = index.at<int>(std::min(v * kStep + kStep / 2, index.rows - 1),
                                                  std::min(u * kStep + kStep / 2, index.cols - 1));
  result.shapes = shapes_of(index, count);
  result.borders = borders_of(index);
  return result;
}

}  // namespace placegraph
