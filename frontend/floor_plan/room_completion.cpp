#include <placegraph/frontend/floor_plan/room_completion.h>

#include <algorithm>
#include <map>
#include <opencv2/imgproc.hpp>

namespace placegraph {
namespace {

/// Mask extended by all cells between two of its cells along an axis, without a barrier in between,
/// wide enough for a neck.
cv::Mat1b span(const cv::Mat1b& own, const cv::Mat1b& barrier, const Image& neck) {
  cv::Mat1b grown = own.clone();
  const auto join = [&](cv::Mat1b& joined, cv::Point p, cv::Point step, int length) {
    for (int i = 0, last = -1; i < length; ++i, p += step) {
      if (barrier(p)) last = -1;
      if (!grown(p)) continue;
      if (last >= 0)
        for (int k = last + 1; k < i; ++k) joined(p - (i - k) * step) = 255;
      last = i;
    }
  };
  for (int before = -1, now = cv::countNonZero(grown); now != before;) {
    cv::Mat1b joined = grown.clone();
    for (int r = 0; r < own.rows; ++r) join(joined, {0, r}, {1, 0}, own.cols);
    for (int c = 0; c < own.cols; ++c) join(joined, {c, 0}, {0, 1}, own.rows);
    cv::morphologyEx(joined, joined, cv::MORPH_OPEN, neck);
    grown |= joined;
    before = now, now = cv::countNonZero(grown);
  }
  return grown;
}

/// Number of the strip between cuts for every column or row; -1 outside of all.
std::vector<int> strips(std::vector<int> cuts, int size) {
  std::sort(cuts.begin(), cuts.end());
  std::vector<int> strip(static_cast<std::size_t>(size), -1);
  for (int i = 0; i < size; ++i) {
    const auto next = std::upper_bound(cuts.begin(), cuts.end(), i);
    if (next != cuts.begin() && next != cuts.end())
      strip[i] = static_cast<int>(next - cuts.begin());
  }
  return strip;
}

}  // namespace

void fill_shadows(RoomGrid& grid, int room, const Image& neck, double walled_share) {
  const cv::Mat1b own = grid.rooms == room;
  cv::Mat1b barrier = grid.blocked.clone();
  for (std::size_t k = 1; k < grid.entered.size(); ++k)
    if (grid.entered[k] && static_cast<int>(k) != room)
      barrier.setTo(255, grid.rooms == static_cast<int>(k));
  const cv::Mat1b shadows = span(own, barrier, neck) & ~own;
  cv::Mat1i parts;
  const auto count = static_cast<std::size_t>(cv::connectedComponents(shadows, parts, 4, CV_32S));
  std::vector<int> open(count, 0), wall(count, 0), unseen(count, 0);
  for (int r = 1; r + 1 < grid.rooms.rows; ++r)
    for (int c = 1; c + 1 < grid.rooms.cols; ++c)
      if (const int part = parts(r, c))
        for (const cv::Point& d : kSideBySide) {
          const cv::Point q = cv::Point(c, r) + d;
          if (parts(q) != part) ++(grid.blocked(q) ? wall : own(q) ? open : unseen)[part];
        }
  for (int r = 0; r < grid.rooms.rows; ++r)
    for (int c = 0; c < grid.rooms.cols; ++c)
      if (const int part = parts(r, c); part && open[part] > unseen[part] &&
                                        wall[part] <= walled_share * (wall[part] + open[part]))
        grid.rooms(r, c) = room;
}

void fill_boxes(RoomGrid& grid, const std::array<std::vector<int>, 2>& cuts,
                double completed_share) {
  const std::vector<int> column = strips(cuts[0], grid.rooms.cols),
                         row = strips(cuts[1], grid.rooms.rows);
  std::map<std::pair<int, int>, std::map<int, int>> boxes;  // cells by room, -1: all
  for (int r = 0; r < grid.rooms.rows; ++r)
    for (int c = 0; c < grid.rooms.cols; ++c) {
      if (column[c] < 0 || row[r] < 0 || grid.blocked(r, c)) continue;
      auto& box = boxes[{column[c], row[r]}];
      ++box[-1];
      if (grid.rooms(r, c) > 0) ++box[grid.rooms(r, c)];
    }
  for (int r = 0; r < grid.rooms.rows; ++r)
    for (int c = 0; c < grid.rooms.cols; ++c) {
      if (column[c] < 0 || row[r] < 0 || grid.blocked(r, c) || grid.rooms(r, c)) continue;
      const auto& box = boxes[{column[c], row[r]}];
      for (const auto& [room, cells] : box)
        if (room > 0 && grid.entered[room] && cells > completed_share * box.at(-1))
          grid.rooms(r, c) = room;
    }
}

}  // namespace placegraph
