#include "lsp/answers.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "base/text.h"
#include "lsp/across.h"
#include "lsp/complete.h"
#include "lsp/describe.h"
#include "lsp/edits.h"
#include "lsp/outline.h"
#include "lsp/words/tokens.h"
#include "translator/report/code_pages.h"

namespace cnctrans::lsp {

namespace {

using nlohmann::json;

json of(const Position& p) {
  return {{"line", p.line}, {"character", p.character}};
}
json of(const Range& r) {
  return {{"start", of(r.start)}, {"end", of(r.end)}};
}
Position position_in(const json& j) {
  return {j.at("line").get<std::uint32_t>(), j.at("character").get<std::uint32_t>()};
}
json of(const std::vector<Edit>& edits) {
  json out = json::array();
  for (const auto& e : edits) out.push_back({{"range", of(e.range)}, {"newText", e.text}});
  return out;
}
std::string uri_in(const json& p) {
  return p.at("textDocument").at("uri").get<std::string>();
}

/// A request at a place of a document.
struct At {
  const Document& document;
  Analysis& analysis;
  const json& parameters;
  Workspace& workspace;
  std::uint32_t line = 0, column = 0;
  const std::string& uri;
};

json location(const std::string& uri, const Document& document, const Span& span) {
  return {{"uri", uri}, {"range", of(document.range(span))}};
}

std::string file_of(const std::string& uri) {
  const std::string path = path_of_uri(uri);
  return path.substr(path.rfind('/') + 1);
}
std::string stem_of(const std::string& uri) {
  const std::string name = file_of(uri);
  return name.substr(0, name.rfind('.'));
}

/// The place where another file defines a subprogram.
json elsewhere(At& at, const Occurrence& name) {
  ir::RoutineName wanted;
  const std::string text = name.key.substr(1);
  if (name.numbered) {
    wanted.number = std::stoll(text);
  } else {
    wanted.text = text;
  }
  const ir::Program* found = at.analysis.loader().find(wanted);
  const ir::Routine* routine = found == nullptr ? nullptr : found->find(wanted);
  if (routine == nullptr) return nullptr;
  const FileId file = routine->header.span.known() ? routine->header.span.file : routine->file;
  const auto source = at.analysis.loader().files().source_ptr(file);
  if (!source) return nullptr;
  const Document other(uri_of_file(source->name()), {}, std::string(source->text()));
  const Span span = routine->header.span.known() ? routine->header.span : Span{file, 1, 1, 1, 1};
  return location(other.uri(), other, span);
}

Answer definition(At& at) {
  const Occurrence* name = at.analysis.name_at(at.line, at.column);
  if (name == nullptr) return {};
  json out = json::array();
  for (const auto& o : at.analysis.names()) {
    if (same_name(o, *name) && o.defines) out.push_back(location(at.uri, at.document, o.span));
  }
  if (out.empty() && name->kind == NameKind::routine) {
    if (json found = elsewhere(at, *name); !found.is_null()) out.push_back(std::move(found));
  }
  if (out.empty() && name->kind == NameKind::variable) {  // a numbered one: where it is written first
    for (const auto& o : at.analysis.names()) {
      if (!same_name(o, *name) || !o.writes) continue;
      out.push_back(location(at.uri, at.document, o.span));
      break;
    }
  }
  return {out.dump(), {}, {}};
}

Answer references(At& at) {
  const Occurrence* found = at.analysis.name_at(at.line, at.column);
  if (found == nullptr) return {};
  const Occurrence name = *found;
  const bool with_definition = at.parameters.value("/context/includeDeclaration"_json_pointer, true);
  json out = json::array();
  bool defined = false;
  const auto add = [&](const std::string& uri, const Document& document, Analysis& analysis) {
    for (const auto& o : analysis.names()) {
      defined = defined || (same_name(o, name) && o.defines);
      if (same_name(o, name) && (with_definition || !o.defines)) out.push_back(location(uri, document, o.span));
    }
  };
  add(at.uri, at.document, at.analysis);
  for (const auto& o : others_with(at.workspace, at.uri, at.analysis, name)) add(o.uri, *o.document, *o.analysis);
  if (with_definition && !defined && name.kind == NameKind::routine) {  // a program that its file's name is the name of
    if (json found_there = elsewhere(at, name); !found_there.is_null()) out.push_back(std::move(found_there));
  }
  return {out.dump(), {}, {}};
}

Answer highlight(At& at) {
  const Occurrence* name = at.analysis.name_at(at.line, at.column);
  if (name == nullptr) return {};
  json out = json::array();
  for (const auto& o : at.analysis.names()) {
    if (same_name(o, *name))
      out.push_back({{"range", of(at.document.range(o.span))}, {"kind", o.writes || o.defines ? 3 : 2}});
  }
  return {out.dump(), {}, {}};
}

/// The word at a place and what the tables say of it.
std::string word_text(At& at) {
  const auto told = [](const WordInfo& info) {
    return "`" + usage_of(info) + "`" + (info.title.empty() ? "" : " — " + info.title) + "\n\n" + parameter_list(info);
  };
  if (const WordInfo* cycle = cycle_of_lines(at.analysis, at.document, at.line)) return told(*cycle);
  const std::string_view line = at.document.line(at.line);
  for (const auto& t : tokens_of(line, at.analysis.language(), at.analysis.lathe())) {
    if (t.column > at.column || at.column >= t.column + t.length) continue;
    const std::string_view word = line.substr(t.column - 1, t.length);
    const WordInfo* info = at.analysis.language().find(word, at.analysis.lathe());
    return info == nullptr ? std::string() : told(*info);
  }
  return {};
}

Answer hover(At& at) {
  const auto& statements = at.analysis.statements(at.line);
  std::string text = word_text(at);
  for (const auto* s : statements) {
    const DescribeContext context{
        at.analysis.program(), at.analysis.facts(*s), at.document.line(at.line),
        at.analysis.lathe() && at.analysis.profile().power_on.diameter != ir::DiameterMode::radius};
    for (const auto& line : describe(*s, context)) text += "- " + line + "\n";
    if (s == statements.front()) {
      const bool says = std::holds_alternative<ir::Block>(s->node) && std::get<ir::Block>(s->node).empty();
      if (!says) text += "\nBefore it: " + describe_facts(context) + "\n\n";
    }
  }
  if (text.empty()) return {};
  return {json{{"contents", {{"kind", "markdown"}, {"value", to_utf8(text)}}}}.dump(-1, ' ', false,
                                                                                    json::error_handler_t::replace),
          {},
          {}};
}

json of(const Symbol& s, const Document& document) {
  constexpr std::array kinds = {12, 20, 24, 15};  // Function, Key, Event, String
  const auto end = static_cast<std::uint32_t>(document.line(s.last).size() + 1);
  json out = {
      {"name", s.name.empty() ? "?" : s.name},
      {"detail", s.detail},
      {"kind", kinds[static_cast<std::size_t>(s.kind)]},
      {"range", of(document.range({1, s.first, 1, s.last, end}))},
      {"selectionRange",
       of(document.range({1, s.first, 1, s.first, static_cast<std::uint32_t>(document.line(s.first).size() + 1)}))}};
  if (!s.children.empty()) {
    out["children"] = json::array();
    for (const auto& c : s.children) out["children"].push_back(of(c, document));
  }
  return out;
}

Answer symbols(At& at) {
  json out = json::array();
  for (const auto& s : outline(at.analysis)) out.push_back(of(s, at.document));
  return {out.dump(-1, ' ', false, json::error_handler_t::replace), {}, {}};
}

Answer folding(At& at) {
  json out = json::array();
  for (const auto& f : folds(at.analysis)) {
    out.push_back({{"startLine", f.first - 1}, {"endLine", f.last - 1}, {"kind", f.comment ? "comment" : "region"}});
  }
  return {out.dump(), {}, {}};
}

Answer semantic_tokens(At& at) {
  json data = json::array();
  std::uint32_t line_before = 0, start_before = 0;
  for (std::uint32_t n = 1; n <= at.document.line_count(); ++n) {
    for (const auto& t : tokens_of(at.document.line(n), at.analysis.language(), at.analysis.lathe())) {
      const Position begin = at.document.position(n, t.column), end = at.document.position(n, t.column + t.length);
      const std::uint32_t delta = begin.line - line_before;
      data.insert(data.end(), {delta, delta == 0 ? begin.character - start_before : begin.character,
                               end.character - begin.character, static_cast<std::uint32_t>(t.type), 0U});
      line_before = begin.line;
      start_before = begin.character;
    }
  }
  return {json{{"data", data}}.dump(), {}, {}};
}

Answer completion(At& at) {
  constexpr std::array kinds = {14, 15, 6, 20, 3};  // Keyword, Snippet, Variable, EnumMember, Function
  json out = json::array();
  for (const auto& item : complete(at.analysis, at.document.line(at.line), at.column)) {
    json j = {{"label", item.label}, {"kind", kinds[static_cast<std::size_t>(item.kind)]}, {"detail", item.detail}};
    if (!item.documentation.empty()) j["documentation"] = {{"kind", "markdown"}, {"value", item.documentation}};
    if (!item.snippet.empty()) {
      j["insertText"] = item.snippet;
      j["insertTextFormat"] = 2;
    }
    out.push_back(std::move(j));
  }
  return {json{{"isIncomplete", false}, {"items", out}}.dump(-1, ' ', false, json::error_handler_t::replace), {}, {}};
}

Answer signature_help(At& at) {
  const auto s = signature(at.analysis, at.document.line(at.line), at.column);
  if (!s) return {};
  json parameters = json::array();
  for (const auto& p : s->parameters) parameters.push_back({{"label", p.name}, {"documentation", p.meaning}});
  const json out = {
      {"signatures", {{{"label", s->label}, {"documentation", s->documentation}, {"parameters", parameters}}}},
      {"activeSignature", 0},
      {"activeParameter", s->active}};
  return {out.dump(), {}, {}};
}

Answer prepare_rename(At& at) {
  const Occurrence* name = at.analysis.name_at(at.line, at.column);
  if (name == nullptr) return {};
  return {json{{"range", of(at.document.range(name->span))}, {"placeholder", name->shown}}.dump(), {}, {}};
}

Answer renaming(At& at) {
  const Occurrence* found = at.analysis.name_at(at.line, at.column);
  if (found == nullptr) return {"null", "there is no label, subprogram or variable here", {}};
  const Occurrence name = *found;
  const std::string to = at.parameters.at("newName");
  json changes = json::object();
  const auto add = [&](const std::string& uri, const Document& document, Analysis& analysis) {
    const Edits edits = rename(analysis, document, name, to);
    if (!edits.edits.empty()) changes[uri] = of(edits.edits);
    return edits.refused;
  };
  const auto others = others_with(at.workspace, at.uri, at.analysis, name);
  if (name.kind != NameKind::routine && !others.empty())
    return {
        "null", name.shown + " stands in " + file_of(others.front().uri) + " too, which belongs to this program", {}};
  if (std::string why = add(at.uri, at.document, at.analysis); !why.empty()) return {"null", why, {}};
  for (const auto& o : others) {
    if (std::string why = add(o.uri, *o.document, *o.analysis); !why.empty()) return {"null", why, {}};
  }
  if (name.kind == NameKind::routine) {  // a program that is found by the name of its file keeps its name
    const json file = elsewhere(at, name);
    const std::string uri = file.is_object() ? file.at("uri").get<std::string>() : others.empty() ? "" : at.uri;
    if (iequals_ascii(stem_of(uri), name.shown))
      return {"null", file_of(uri) + " has its name from the file: rename the file, then what calls it", {}};
  }
  return {json{{"changes", changes}}.dump(), {}, {}};
}

Answer formatting(At& at) {
  const Edits edits = format(at.analysis, at.document);
  return {of(edits.edits).dump(), {}, edits.refused};
}

Answer code_actions(At& at) {
  json out = json::array();
  const std::uint32_t first = position_in(at.parameters.at("range").at("start")).line + 1;
  const std::uint32_t last = position_in(at.parameters.at("range").at("end")).line + 1;
  std::string explained;
  for (const auto& d : at.analysis.diagnostics().all()) {
    if (d.span.file != at.analysis.file() || d.span.line < first || d.span.line > last) continue;
    for (const auto& fix : fixes(at.analysis, at.document, d)) {
      out.push_back({{"title", fix.title}, {"kind", "quickfix"}, {"edit", {{"changes", {{at.uri, of(fix.edits)}}}}}});
    }
    if (explained == d.code) continue;
    explained = d.code;
    out.push_back(
        {{"title", "Explain " + d.code},
         {"kind", "quickfix"},
         {"command", {{"title", "Explain " + d.code}, {"command", "cnctrans.explain"}, {"arguments", {d.code}}}}});
  }
  return {out.dump(-1, ' ', false, json::error_handler_t::replace), {}, {}};
}

/// The motion function in force before blocks that do not write one.
Answer inlay_hints(At& at) {
  json out = json::array();
  const std::uint32_t first = position_in(at.parameters.at("range").at("start")).line + 1;
  const std::uint32_t last =
      std::min(position_in(at.parameters.at("range").at("end")).line + 1, at.document.line_count());
  for (std::uint32_t n = first; n <= last && at.analysis.language().numbered_by_n; ++n) {
    for (const auto* s : at.analysis.statements(n)) {
      const auto* b = std::get_if<ir::Block>(&s->node);
      if (b == nullptr || !b->has_motion || b->motion.explicit_code || b->motion.coords.empty()) continue;
      const auto motion = at.analysis.facts(*s).motion;
      if (!motion || *motion > ir::MotionKind::arc_ccw || *motion == ir::MotionKind::modal) continue;
      const std::uint32_t column = b->motion.coords.front().pos.column;
      if (column == 0) continue;
      const int code = static_cast<int>(*motion) - static_cast<int>(ir::MotionKind::rapid);
      out.push_back({{"position", of(at.document.position(n, column))},
                     {"label", "G" + std::to_string(code)},
                     {"paddingRight", true}});
    }
  }
  return {out.dump(), {}, {}};
}

using Request = Answer (*)(At&);
struct Row {
  std::string_view method;
  Request request;
};
constexpr std::array requests = {
    Row{"textDocument/definition", definition},
    Row{"textDocument/references", references},
    Row{"textDocument/documentHighlight", highlight},
    Row{"textDocument/hover", hover},
    Row{"textDocument/documentSymbol", symbols},
    Row{"textDocument/foldingRange", folding},
    Row{"textDocument/semanticTokens/full", semantic_tokens},
    Row{"textDocument/completion", completion},
    Row{"textDocument/signatureHelp", signature_help},
    Row{"textDocument/prepareRename", prepare_rename},
    Row{"textDocument/rename", renaming},
    Row{"textDocument/formatting", formatting},
    Row{"textDocument/codeAction", code_actions},
    Row{"textDocument/inlayHint", inlay_hints},
};

}  // namespace

std::string capabilities() {
  const json legend = {
      {"tokenTypes", {"comment", "string", "number", "keyword", "function", "macro", "variable", "label", "property"}},
      {"tokenModifiers", json::array()}};
  const json out = {
      {"textDocumentSync", {{"openClose", true}, {"change", 2}}},
      {"hoverProvider", true},
      {"definitionProvider", true},
      {"referencesProvider", true},
      {"documentHighlightProvider", true},
      {"documentSymbolProvider", true},
      {"foldingRangeProvider", true},
      {"documentFormattingProvider", true},
      {"inlayHintProvider", true},
      {"codeActionProvider", {{"codeActionKinds", {"quickfix"}}}},
      {"renameProvider", {{"prepareProvider", true}}},
      {"completionProvider", {{"triggerCharacters", {"G", "M", "$"}}}},
      {"signatureHelpProvider", {{"triggerCharacters", {"(", ",", " "}}}},
      {"semanticTokensProvider", {{"legend", legend}, {"full", true}}},
      {"executeCommandProvider", {{"commands", {"cnctrans.translate", "cnctrans.toolPath", "cnctrans.explain"}}}}};
  return out.dump();
}

std::optional<Answer> answer(std::string_view method, const std::string& parameters, Workspace& workspace) {
  const auto row =
      std::find_if(requests.begin(), requests.end(), [method](const Row& r) { return r.method == method; });
  if (row == requests.end()) return std::nullopt;
  const json p = json::parse(parameters);
  const std::string uri = uri_in(p);
  const Document* document = workspace.find(uri);
  Analysis* analysis = workspace.analysis(uri);
  if (document == nullptr || analysis == nullptr) return Answer{};
  At at{*document, *analysis, p, workspace, 0, 0, uri};
  if (p.contains("position")) {
    const Position position = position_in(p.at("position"));
    at.line = position.line + 1;
    at.column = document->column(position);
  }
  return row->request(at);
}

std::string published_diagnostics(Workspace& workspace, const std::string& uri) {
  json list = json::array();
  Analysis* analysis = workspace.analysis(uri);
  const Document* document = workspace.find(uri);
  if (analysis != nullptr && document != nullptr) {
    for (const auto& d : analysis->diagnostics().all()) {
      if (d.span.file > analysis->file()) continue;
      json j = {{"range", of(document->range(d.span))},
                {"severity", d.severity == Severity::error     ? 1
                             : d.severity == Severity::warning ? 2
                                                               : 3},
                {"code", d.code},
                {"source", "cnctrans"},
                {"message", d.message + (d.hint.empty() ? "" : "\n" + d.hint)}};
      list.push_back(std::move(j));
    }
  }
  return json{{"uri", uri}, {"diagnostics", list}}.dump(-1, ' ', false, json::error_handler_t::replace);
}

}  // namespace cnctrans::lsp
