#pragma once
#include <placegraph/graph/core/parallel.h>

namespace placegraph::synthetic {

using placegraph::parallel_for;

}  // namespace placegraph::synthetic
