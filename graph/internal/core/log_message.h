#pragma once
#include <fmt/core.h>
#include <placegraph/graph/core/log.h>
#include <placegraph/graph/internal/core/id_format.h>

#include <utility>

namespace placegraph {

/// Formats the message, in the way of std::format, and hands it over, if there is a sink.
template <class... Args>
void log(const LogSink& sink, LogLevel level, fmt::format_string<Args...> message, Args&&... args) {
  if (sink) sink(level, fmt::format(message, std::forward<Args>(args)...));
}

}  // namespace placegraph
