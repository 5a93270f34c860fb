#include <fmt/format.h>
#include <placegraph/pipeline/internal/health/image_quality.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace placegraph {
namespace {

constexpr double kBlankRange = 30, kOverexposedShare = 0.4;
// Sharp recordings have a detail of 0.13 to 0.4, slight motion blur reaches 0.1.
constexpr double kBlurredDetail = 0.09, kNoisyDetail = 0.6;
constexpr double kBrightnessStep = 0.2;

}  // namespace

void ImageQuality::add(FrameId frame, const ImageStatistics& s) {
  ++frames_;
  const auto last = std::exchange(last_mean_, s.mean);
  if (s.range < kBlankRange) return count(kBlank, frame);
  if (s.white > kOverexposedShare) count(kOverexposed, frame);
  if (s.detail < kBlurredDetail) count(kBlurred, frame);
  if (s.detail > kNoisyDetail) count(kNoisy, frame);
  if (last && std::abs(std::log((s.mean + 1) / (*last + 1))) > kBrightnessStep)
    count(kFlickering, frame);
}

void ImageQuality::count(Defect defect, FrameId frame) {
  Count& count = counts_[defect];
  if (count.images++ == 0) count.first = frame;
}

bool ImageQuality::frequent(const Count& count) const {
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
       {"blurred: they are smooth over 8 pixels", "focus the lens, or shorten the exposure"},
       {"noise for the most part", "add light, or lengthen the exposure"},
       {"brighter or darker than the one before by over 20 %", "fix exposure and gain"}}};
  const auto worst = std::ranges::max_element(counts_, {}, &Count::images);
  if (!frequent(*worst)) return std::nullopt;
  std::string text;
  for (std::size_t i = 0; i < kDefects; ++i)
    if (frequent(counts_[i]))
      text += fmt::format("{}{} of {} {} (from frame {} on) are {}", text.empty() ? "" : "; ",
                          counts_[i].images, frames_, images_, counts_[i].first.value(),
                          kTexts[i].what);
  return DataNote{text, false, cause_,
                  kTexts[static_cast<std::size_t>(worst - counts_.begin())].advice};
}

}  // namespace placegraph
