#include <fmt/format.h>
#include <placegraph/io/exports/colmap_reader.h>
#include <placegraph/pipeline/exports/colmap_adjustment.h>
#include <placegraph/pipeline/exports/colmap_folder.h>
#include <placegraph/pipeline/map/colmap_bundle.h>

#include <algorithm>

namespace placegraph {

struct ColmapAdjustment::Impl {
  ColmapModel model;
  NumberForm form;
};

std::string describe_unused_cameras(const std::vector<std::uint32_t>& ids) {
  constexpr std::size_t kNamed = 8;
  const std::size_t named = std::min(ids.size(), kNamed);
  std::string text =
      fmt::format("{} camera{} that no image has: {}", ids.size(), ids.size() == 1 ? "" : "s",
                  fmt::join(ids.begin(), ids.begin() + static_cast<std::ptrdiff_t>(named), ", "));
  if (ids.size() > named) text += fmt::format(" and {} more", ids.size() - named);
  return text;
}

ColmapAdjustment::ColmapAdjustment(const std::string& folder)
    : impl_(new Impl{read_colmap(folder, ColmapLenses::kAny), colmap_form(folder)}) {}

ColmapAdjustment::~ColmapAdjustment() = default;

std::size_t ColmapAdjustment::images() const { return impl_->model.images.size(); }

std::size_t ColmapAdjustment::points() const { return impl_->model.points.size(); }

std::vector<std::uint32_t> ColmapAdjustment::unused_cameras() const {
  return unused_camera_ids(impl_->model);
}

ColmapAdjustmentReport ColmapAdjustment::adjust(const BundleOptions& options) {
  ColmapBundleReport report = adjust_colmap(impl_->model, options);
  impl_->model = std::move(report.model);
  return {report.outcome,         report.observations, report.cost_initial, report.cost_final,
          report.error_before_px, report.error_px,     report.iterations};
}

void ColmapAdjustment::write(const std::string& folder) const {
  write_colmap_folder(folder, impl_->model, impl_->form);
}

}  // namespace placegraph
