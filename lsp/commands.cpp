// workspace/executeCommand: a translation, a page with the tool path, the page of a code.
#include <nlohmann/json.hpp>

#include "lsp/answers.h"
#include "translator/report/code_pages.h"
#include "translator/report/report.h"

namespace cnctrans::lsp {

namespace {

using nlohmann::json;

json texts_of(const translator::TranslateResult& result) {
  json out = json::array();
  for (const auto& o : result.outputs) out.push_back({{"name", o.name}, {"text", to_utf8(o.bytes)}, {"main", o.main}});
  return out;
}

/// Arguments: URI, name of the other language.
Answer translate_command(const json& arguments, Workspace& workspace) {
  Analysis* analysis = workspace.analysis(arguments.at(0));
  if (analysis == nullptr) return {"null", "this document is no part program that is known", {}};
  translator::TranslateOptions options;
  const auto result = analysis->translate(arguments.at(1), options);
  if (!result.error.empty()) return {"null", result.error, {}};
  json messages = json::array();
  for (const auto& d : result.diagnostics.all()) {
    messages.push_back({{"code", d.code},
                        {"severity", severity_text(d.severity)},
                        {"line", d.span.line},
                        {"message", d.message},
                        {"hint", d.hint}});
  }
  const json out = {{"refused", result.refused},
                    {"held_back", result.held_back},
                    {"verdict", translator::proof_text(result, result.target_files)},
                    {"outputs", result.refused ? json::array() : texts_of(result)},
                    {"messages", messages}};
  return {out.dump(-1, ' ', false, json::error_handler_t::replace), {}, {}};
}

/// Arguments: URI, and the language whose translation is drawn beside it; without one its own.
Answer tool_path(const json& arguments, Workspace& workspace) {
  Analysis* analysis = workspace.analysis(arguments.at(0));
  if (analysis == nullptr) return {"null", "this document is no part program that is known", {}};
  translator::TranslateOptions options;
  options.keep_traces = true;
  const std::string to =
      arguments.size() > 1 ? arguments.at(1).get<std::string>() : std::string(analysis->dialect().name);
  const auto result = analysis->translate(to, options);
  if (!result.error.empty()) return {"null", result.error, {}};
  const auto report = translator::make_report(analysis->source()->name(), options, result);
  return {json{{"html", (*translator::report_writer("report.html"))(report)}}.dump(-1, ' ', false,
                                                                                   json::error_handler_t::replace),
          {},
          {}};
}

Answer explain_command(const json& arguments) {
  const auto page = translator::code_page(arguments.at(0).get<std::string>());
  if (page.text.empty()) return {"null", "there is no such code", {}};
  return {json{{"heading", page.heading}, {"markdown", page.text}}.dump(), {}, {}};
}

}  // namespace

Answer execute(const std::string& parameters, Workspace& workspace) {
  const json p = json::parse(parameters);
  const std::string command = p.at("command");
  const json arguments = p.value("arguments", json::array());
  if (command == "cnctrans.translate") return translate_command(arguments, workspace);
  if (command == "cnctrans.toolPath") return tool_path(arguments, workspace);
  if (command == "cnctrans.explain") return explain_command(arguments);
  return {"null", "there is no command " + command, {}};
}

}  // namespace cnctrans::lsp
