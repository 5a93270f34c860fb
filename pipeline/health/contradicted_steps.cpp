#include <fmt/format.h>
#include <placegraph/pipeline/health/contradicted_steps.h>

namespace placegraph {

void ContradictedSteps::add(FrameId frame, bool contradicted) {
  if (!contradicted) return end_row();
  if (!row_) row_ = Row{frame, frame, 0};
  row_->last = frame;
  ++row_->steps;
}

std::optional<FrameId> ContradictedSteps::row() const {
  return row_ && row_->steps >= kSteps ? std::optional(row_->first) : std::nullopt;
}

std::optional<FrameId> ContradictedSteps::contradicted_from(FrameId begin) const {
  const auto first = row();
  return first && first->value() - begin.value() <= row_->steps ? std::optional(begin) : first;
}

void ContradictedSteps::end_row() {
  if (row()) found_.push_back(*row_);
  row_.reset();
}

std::optional<DataNote> ContradictedSteps::note() const {
  std::vector<Row> rows = found_;
  if (row()) rows.push_back(*row_);
  if (rows.empty()) return std::nullopt;
  const std::string others =
      rows.size() > 1 ? fmt::format(", and of {} later stretches", rows.size() - 1) : "";
  return DataNote{fmt::format("the images contradict the rotations of frames {} to {}{}: lengths "
                              "before and after them may differ in scale",
                              rows.front().first.value(), rows.front().last.value(), others),
                  false, NoteCause::kScale,
                  "use more images a second, or move the camera more slowly there"};
}

}  // namespace placegraph
