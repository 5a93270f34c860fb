#pragma once
#include <placegraph/graph/core/stage_times.h>
#include <placegraph/graph/scene/scene_model.h>

#include <cstdint>
#include <memory>
#include <string>

#include "python/src/bindings.h"

namespace placegraph::python {

/// Share of the frames that must have a pose, as for `placegraph run`.
inline constexpr double kLeastPosed = 0.2;

/// A stamp [s] as nanoseconds. Throws ArgumentError, which names the argument, for no time.
std::int64_t nanoseconds(double stamp_s);

/// The model of surfaces in a file. Throws FileError, also for a model of another kind.
std::shared_ptr<const SceneModel> surfaces_in(const std::string& path);

/// CPU time [s] and calls of each stage, by its name.
nb::dict stage_table(const std::vector<StageTime>& stages);

}  // namespace placegraph::python
