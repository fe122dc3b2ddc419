#include "lsp/server.h"

#include <exception>
#include <nlohmann/json.hpp>
#include <set>

#include "lsp/answers.h"
#include "lsp/wire.h"
#include "translator/version.h"

namespace cnctrans::lsp {

namespace {

using nlohmann::json;

constexpr int method_not_found = -32601, invalid_params = -32602, not_initialized = -32002, request_failed = -32803;

class Server {
 public:
  Server(std::FILE* in, std::FILE* out) : wire_(in, out) {}

  int run() {
    while (!exited_) {
      if (!unpublished_.empty() && wire_.idle()) publish();  // while nothing else is to be done
      const auto message = wire_.read();
      if (!message) break;
      take(*message);
    }
    return stopped_ ? 0 : 1;
  }

 private:
  void take(const std::string& text) {
    json message = json::parse(text, nullptr, false);
    if (!message.is_object() || !message.contains("method")) return;  // an answer to a request of ours, or nothing
    const std::string method = message.value("method", "");
    const json parameters = message.value("params", json::object());
    const bool request = message.contains("id");
    try {
      if (!request) return notice(method, parameters);
      reply(message.at("id"), method, parameters);
    } catch (const std::exception& e) {
      if (request) fail(message.at("id"), invalid_params, e.what());
    }
  }

  void notice(const std::string& method, const json& p) {
    if (method == "exit") exited_ = true;
    if (method == "textDocument/didOpen") {
      const json& d = p.at("textDocument");
      workspace_.open(d.at("uri"), d.value("languageId", ""), d.at("text"));
      unpublished_.insert(d.at("uri"));
    } else if (method == "textDocument/didChange") {
      change(p);
    } else if (method == "textDocument/didClose") {
      const std::string uri = p.at("textDocument").at("uri");
      workspace_.close(uri);
      unpublished_.erase(uri);
      send("textDocument/publishDiagnostics", json{{"uri", uri}, {"diagnostics", json::array()}}.dump());
    } else if (method == "workspace/didChangeConfiguration") {
      const json settings = p.value("settings", json::object());
      set(settings.is_object() && settings.contains("cnctrans") ? settings.at("cnctrans") : settings);
    } else if (method == "textDocument/didSave" || method == "workspace/didChangeWatchedFiles") {
      workspace_.all_changed();  // what others call may be another now
    }
  }

  void change(const json& p) {
    const std::string uri = p.at("textDocument").at("uri");
    Document* document = workspace_.find(uri);
    if (document == nullptr) return;
    for (const auto& c : p.at("contentChanges")) {
      if (!c.contains("range")) {
        document->replace(c.at("text"));
        continue;
      }
      const auto place = [](const json& j) { return Position{j.at("line"), j.at("character")}; };
      document->edit({place(c.at("range").at("start")), place(c.at("range").at("end"))},
                     c.at("text").get<std::string>());
    }
    workspace_.changed(uri);
    unpublished_.insert(uri);
  }

  void set(const json& settings) {
    if (!settings.is_object()) return;
    workspace_.settings.machine = settings.value("machine", "");
    workspace_.settings.libraries = settings.value("libraries", std::vector<std::string>{});
    workspace_.all_changed();
    for (const auto& [uri, document] : workspace_.documents()) unpublished_.insert(uri);
  }

  void reply(const json& id, const std::string& method, const json& p) {
    if (method == "initialize") {
      if (p.contains("initializationOptions")) set(p.at("initializationOptions"));
      initialized_ = true;
      return result(id, "{\"capabilities\":" + capabilities() +
                            ",\"serverInfo\":{\"name\":\"cnctrans\",\"version\":\"" + std::string(translator::version) +
                            "\"}}");
    }
    if (!initialized_) return fail(id, not_initialized, "initialize comes first");
    if (method == "shutdown") {
      stopped_ = true;
      return result(id, "null");
    }
    const auto answered = method == "workspace/executeCommand" ? std::optional(execute(p.dump(), workspace_))
                                                               : answer(method, p.dump(), workspace_);
    if (!answered) return fail(id, method_not_found, "there is no request " + method);
    if (!answered->error.empty()) return fail(id, request_failed, answered->error);
    if (!answered->shown.empty()) send("window/showMessage", json{{"type", 2}, {"message", answered->shown}}.dump());
    result(id, answered->result);
  }

  void publish() {
    const std::set<std::string> uris = std::move(unpublished_);
    unpublished_.clear();
    for (const auto& uri : uris) send("textDocument/publishDiagnostics", published_diagnostics(workspace_, uri));
  }
  void send(const std::string& method, const std::string& parameters) {
    wire_.write(R"({"jsonrpc":"2.0","method":")" + method + R"(","params":)" + parameters + "}");
  }
  void result(const json& id, const std::string& text) {
    wire_.write(R"({"jsonrpc":"2.0","id":)" + id.dump() + R"(,"result":)" + text + "}");
  }
  void fail(const json& id, int code, const std::string& why) {
    wire_.write(json{{"jsonrpc", "2.0"}, {"id", id}, {"error", {{"code", code}, {"message", why}}}}.dump(
        -1, ' ', false, json::error_handler_t::replace));
  }

  Wire wire_;
  Workspace workspace_;
  std::set<std::string> unpublished_;  ///< documents whose diagnostics are to be sent
  bool initialized_ = false, stopped_ = false, exited_ = false;
};

}  // namespace

int serve(std::FILE* in, std::FILE* out) {
  return Server(in, out).run();
}

}  // namespace cnctrans::lsp
