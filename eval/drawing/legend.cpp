#include <placegraph/eval/drawing/figure.h>
#include <placegraph/eval/drawing/legend.h>
#include <placegraph/eval/drawing/plot_style.h>
#include <placegraph/eval/drawing/svg_canvas.h>
#include <placegraph/eval/drawing/text_width.h>

#include <algorithm>

namespace placegraph {
namespace {

using Eigen::Vector2d;

constexpr double kRow = 24, kMark = 34, kGap = 10, kBetween = 30;

double width_of(const LegendEntry& entry) { return kMark + kGap + text_width(entry.text, kTextPx); }

/// Left sides of the columns with this many rows, and behind the last one.
std::vector<double> columns_of(const std::vector<LegendEntry>& entries, std::size_t rows) {
  std::vector<double> left = {0};
  for (std::size_t begin = 0; begin < entries.size(); begin += rows) {
    double width = 0;
    for (std::size_t i = begin; i < std::min(begin + rows, entries.size()); ++i)
      width = std::max(width, width_of(entries[i]));
    left.push_back(left.back() + width + kBetween);
  }
  return left;
}

void draw_mark(SvgCanvas& canvas, const LegendEntry& entry, const Vector2d& at) {
  const Vector2d end = at + Vector2d(kMark, 0), middle = 0.5 * (at + end);
  switch (entry.mark) {
    case LegendMark::kLine:
      return canvas.line({at, end}, entry.stroke);
    case LegendMark::kRing:
      return canvas.disc(middle, entry.stroke.width_px, kWhite, entry.stroke.colour);
    case LegendMark::kDisc:
      return canvas.disc(middle, 4.5, entry.stroke.colour, kWhite, 1);
    case LegendMark::kArea:
      return canvas.rectangle(middle - Vector2d(11, 7), {22, 14}, entry.stroke.colour, kFrame);
    case LegendMark::kScale:
      constexpr int kParts = 8;
      for (int i = 0; i < kParts; ++i)
        canvas.line({at + i * (end - at) / kParts, at + (i + 1) * (end - at) / kParts},
                    {scale_colour((i + 0.5) / kParts), entry.stroke.width_px});
  }
}

}  // namespace

Legend::Legend(std::vector<LegendEntry> entries, double most_width_px)
    : entries_(std::move(entries)) {
  for (LegendEntry& entry : entries_)
    entry.text = fitted(entry.text, kTextPx, most_width_px - kMark - kGap);
  if (entries_.empty()) return;
  // The fewest rows with which all columns have room.
  for (rows_ = 1; rows_ < entries_.size(); ++rows_)
    if (columns_of(entries_, rows_).back() - kBetween <= most_width_px) break;
  column_px_ = columns_of(entries_, rows_);
}

double Legend::height_px() const { return kRow * static_cast<double>(rows_); }

void Legend::draw(SvgCanvas& canvas, const Vector2d& corner) const {
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    const Vector2d at =
        corner + Vector2d(column_px_[i / rows_], kRow * (static_cast<double>(i % rows_) + 0.5));
    draw_mark(canvas, entries_[i], at);
    canvas.text(at + Vector2d(kMark + kGap, 0.36 * kTextPx), entries_[i].text, kTextPx, kInk,
                TextAnchor::kLeft);
  }
}

}  // namespace placegraph
