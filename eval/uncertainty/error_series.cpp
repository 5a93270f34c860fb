#include <fmt/format.h>
#include <placegraph/eval/uncertainty/error_series.h>
#include <placegraph/graph/core/error.h>

#include <cmath>
#include <map>

namespace placegraph {
namespace {

std::vector<ErrorSeries> series_by_length(const std::vector<SegmentError>& segments,
                                          double SegmentError::* error) {
  std::map<double, ErrorSeries> by_length;
  for (const SegmentError& segment : segments)
    by_length[segment.length_m].errors.push_back(
        {segment.first_frame, segment.last_frame, segment.*error});
  std::vector<ErrorSeries> result;
  for (auto& [length_m, series] : by_length) {
    series.stretch = fmt::format("{:g} m", length_m);
    result.push_back(std::move(series));
  }
  return result;
}

}  // namespace

void ErrorSeries::check() const {
  require(!errors.empty(), "a series of errors over " + stretch + " is empty");
  const StretchError* before = nullptr;
  for (const StretchError& e : errors) {
    const bool ordered = e.last_frame >= e.first_frame &&
                         (!before || e.first_frame > before->first_frame);
    if (!ordered || !std::isfinite(e.error))
      throw ArgumentError(fmt::format("the error of frames {} to {} {}", e.first_frame,
                                      e.last_frame,
                                      ordered ? "is no finite number" : "is out of order"));
    before = &e;
  }
}

std::vector<ErrorSeries> translation_series(const std::vector<SegmentError>& segments) {
  return series_by_length(segments, &SegmentError::t_percent);
}

std::vector<ErrorSeries> rotation_series(const std::vector<SegmentError>& segments) {
  return series_by_length(segments, &SegmentError::r_deg_per_100m);
}

}  // namespace placegraph
