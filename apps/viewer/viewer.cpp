#include "apps/viewer/viewer.h"

#include <fcntl.h>
#include <placegraph/pipeline/report/served_page.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <exception>
#include <nlohmann/json.hpp>
#include <thread>

#include "apps/support/output.h"

namespace placegraph::apps {
namespace {

/// The page, whose scripts alone may run: they carry a number that is new for every answer.
HttpResponse page_response(const nlohmann::json& start) {
  const std::string nonce = new_token();
  HttpResponse response;
  response.type = "text/html; charset=utf-8";
  response.body =
      served_page(start.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace), nonce);
  response.headers = {
      {"Content-Security-Policy",
       "default-src 'none'; script-src 'nonce-" + nonce +
           "'; style-src 'unsafe-inline'; img-src 'self' data: blob:; connect-src 'self'; "
           "base-uri 'none'; form-action 'none'; frame-ancestors 'none'"}};
  return response;
}

/// What every answer says: nothing is kept, guessed, embedded or passed on.
HttpResponse with_headers(HttpResponse response) {
  response.headers.insert(response.headers.end(), {{"Cache-Control", "no-store"},
                                                   {"X-Content-Type-Options", "nosniff"},
                                                   {"X-Frame-Options", "DENY"},
                                                   {"Referrer-Policy", "no-referrer"},
                                                   {"Cross-Origin-Resource-Policy", "same-origin"},
                                                   {"Cross-Origin-Opener-Policy", "same-origin"}});
  return response;
}

}  // namespace

Viewer::Viewer(const ViewerOptions& options, nlohmann::json start, Responder respond) {
  identity_.token = new_token();
  HttpHandlers handlers;
  handlers.refuse = [this](const HttpRequest& request) -> std::optional<HttpResponse> {
    auto refused = refusal_of(request, identity_);
    if (!refused) return std::nullopt;
    return with_headers(std::move(*refused));
  };
  handlers.respond = [this, start = std::move(start),
                      respond = std::move(respond)](const HttpRequest& request) {
    const std::string path = path_of(request, identity_);
    if (path.empty() && request.method == "GET") return with_headers(page_response(start));
    try {
      return with_headers(respond(request, path));
    } catch (const std::exception& error) {
      const std::string message = failure_of(error).message;
      warn("the viewer: " + message);
      return with_headers(text_response(500, message));
    }
  };
  server_ = bind_http(options.port, std::move(handlers));
  identity_.port = server_->port();
  server_->start();
  if (options.open) open_in_browser(address());
}

void open_in_browser(const std::string& address) {
  std::string program = "xdg-open", argument = address;
  char* arguments[] = {program.data(), argument.data(), nullptr};
  // The browser outlives Ctrl-C and writes nothing among the output of the program.
  posix_spawnattr_t attributes;
  posix_spawn_file_actions_t files;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  posix_spawn_file_actions_init(&files);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    posix_spawn_file_actions_addopen(&files, stream, "/dev/null", O_RDWR, 0);
  pid_t process = 0;
  const int failed =
      posix_spawnp(&process, program.c_str(), &files, &attributes, arguments, environ);
  posix_spawn_file_actions_destroy(&files);
  posix_spawnattr_destroy(&attributes);
  if (failed) {
    warn("--open: xdg-open cannot be started; open the address yourself");
    return;
  }
  std::thread([process] { waitpid(process, nullptr, 0); }).detach();
}

}  // namespace placegraph::apps
