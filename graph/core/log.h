#pragma once
#include <fmt/core.h>
#include <placegraph/graph/core/id_format.h>

#include <functional>
#include <string>
#include <utility>

namespace placegraph {

enum class LogLevel { kDebug, kInfo, kWarning };

/// Where messages go: handed to whoever wants to speak, never global. Empty means silence.
using LogSink = std::function<void(LogLevel, const std::string&)>;

/// Formats the message, in the way of std::format, and hands it over, if there is a sink.
template <class... Args>
void log(const LogSink& sink, LogLevel level, fmt::format_string<Args...> message, Args&&... args) {
  if (sink) sink(level, fmt::format(message, std::forward<Args>(args)...));
}

}  // namespace placegraph
