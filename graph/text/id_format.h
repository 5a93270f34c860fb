#pragma once
#include <fmt/core.h>
#include <placegraph/graph/core/ids.h>

/// Formats an id as its number, without a format specification: fmt::format("{}", id).
template <class Tag>
struct fmt::formatter<placegraph::Id<Tag>> {
  constexpr auto parse(fmt::format_parse_context& context) { return context.begin(); }
  template <class Context>
  auto format(placegraph::Id<Tag> id, Context& context) const {
    return fmt::format_to(context.out(), "{}", id.value());
  }
};
