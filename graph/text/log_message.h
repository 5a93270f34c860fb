#pragma once
#include <fmt/core.h>
#include <placegraph/graph/core/log.h>
#include <placegraph/graph/text/id_format.h>

#include <utility>

namespace placegraph {

/// Formats the message as std::format does and passes it to the sink, if there is one.
template <class... Args>
void log(const LogSink& sink, LogLevel level, fmt::format_string<Args...> message, Args&&... args) {
  if (sink) sink(level, fmt::format(message, std::forward<Args>(args)...));
}

}  // namespace placegraph
