#pragma once
#include <functional>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "apps/server/http_server.h"
#include "apps/server/request_check.h"
#include "apps/server/viewer_options.h"

namespace placegraph::apps {

/// A server of the page and of what it asks for, under an address with a token.
class Viewer {
 public:
  /// Answers a request that was not refused; `path` is the part of the target behind the token.
  using Responder =
      std::function<HttpResponse(const HttpRequest& request, const std::string& path)>;

  /// `start`: what the page knows at its start, see page_served(). Throws as bind_http().
  Viewer(const ViewerOptions& options, nlohmann::json start, Responder respond);

  std::string address() const { return address_of(identity_); }

 private:
  ServerIdentity identity_;
  std::unique_ptr<HttpServer> server_;
};

/// Opens an address in the user's browser by xdg-open; warns if that cannot be started.
void open_in_browser(const std::string& address);

}  // namespace placegraph::apps
