#pragma once
#include <placegraph/graph/loop.h>

namespace placegraph {

/// A loop when the lengths at its match, its query or both are multiplied by `factor`.
Loop rescaled_loop(Loop loop, bool at_match, bool at_query, double factor);

}  // namespace placegraph
