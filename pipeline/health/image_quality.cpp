#include <fmt/format.h>
#include <placegraph/graph/core/median.h>
#include <placegraph/pipeline/health/image_quality.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace placegraph {
namespace {

// Grey levels that an image spans at least, and share of white pixels (docs/datasets.md). Chosen by
// the faults of group "fixed" (tests/faults/README.md).
constexpr double kBlankRange = 30, kOverexposedShare = 0.4;
// Sharp recordings have a detail of 0.13 to 0.4, slight motion blur reaches 0.1.
constexpr double kBlurredDetail = 0.09, kNoisyDetail = 0.6;
// Relative step of the mean grey level between two images. Chosen by the faults of group "fixed"
// (tests/faults/README.md).
constexpr double kBrightnessStep = 0.2;

}  // namespace

void ImageQuality::add(FrameId frame, const ImageStatistics& s) {
  ++frames_;
  const auto last = std::exchange(last_mean_, s.mean);
  if (s.range < kBlankRange) return count(kBlank, frame);
  if (s.white > kOverexposedShare) count(kOverexposed, frame);
  uniform_.emplace_back(frame, s.uniform);
  if (s.detail < kBlurredDetail) count(kBlurred, frame);
  if (s.detail > kNoisyDetail) count(kNoisy, frame);
  if (last && std::abs(std::log((s.mean + 1) / (*last + 1))) > kBrightnessStep)
    count(kFlickering, frame);
}

void ImageQuality::count(Defect defect, FrameId frame) {
  Count& count = counts_[defect];
  if (count.images++ == 0) count.first = frame;
}

/// Images of which far more has one grey level than is usual in the recording.
ImageQuality::Count ImageQuality::covered() const {
  // Share of pixels with one grey level: half, and well above the median of the run. Chosen by the
  // faults of group "fixed" (tests/faults/README.md).
  constexpr double kShare = 0.5, kMoreThanUsual = 0.3;
  std::vector<double> shares;
  for (const auto& [frame, share] : uniform_) shares.push_back(share);
  Count count;
  if (shares.empty()) return count;
  const double most = std::max(kShare, median_of(std::move(shares)) + kMoreThanUsual);
  for (const auto& [frame, share] : uniform_)
    if (share > most && count.images++ == 0) count.first = frame;
  return count;
}

bool ImageQuality::frequent(const Count& count) const {
  // Odd images that are reported: more than two and 3 %. Chosen by the faults of group "fixed"
  // (tests/faults/README.md).
  constexpr int kFew = 2;
  constexpr double kShare = 0.03;
  return count.images > kFew && count.images > kShare * frames_;
}

std::optional<DataNote> ImageQuality::note() const {
  struct Text {
    const char *what, *advice;
  };
  constexpr std::array<Text, kDefects> kTexts{
      {{"blank: their grey levels span less than 30 of 255", "check exposure, lens cap and light"},
       {"overexposed: over 40 % of their pixels are white", "shorten the exposure"},
       {"covered: over half of their pixels have the same grey level, unlike the others",
        "look for what covers the lens"},
       {"blurred: they are smooth over 8 pixels", "focus the lens, or shorten the exposure"},
       {"noise for the most part", "add light, or lengthen the exposure"},
       {"brighter or darker than the one before by over 20 %", "fix exposure and gain"}}};
  std::array<Count, kDefects> counts = counts_;
  counts[kCovered] = covered();
  const auto worst = std::ranges::max_element(counts, {}, &Count::images);
  if (!frequent(*worst)) return std::nullopt;
  std::string text;
  for (std::size_t i = 0; i < kDefects; ++i)
    if (frequent(counts[i]))
      text +=
          fmt::format("{}{} of {} {} (from frame {} on) are {}", text.empty() ? "" : "; ",
                      counts[i].images, frames_, images_, counts[i].first.value(), kTexts[i].what);
  return DataNote{text, false, cause_,
                  kTexts[static_cast<std::size_t>(worst - counts.begin())].advice};
}

}  // namespace placegraph
