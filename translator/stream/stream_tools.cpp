#include "translator/stream/stream_tools.h"

#include <algorithm>
#include <cctype>

#include "ir/edit/rewrite.h"
#include "ir/edit/search.h"
#include "legaliser/stream/stream_watch.h"

namespace cnctrans::translator {

bool any_line(const frontends::TextLook& look, char letter, frontends::StreamReader& reader,
              const std::function<bool(const ir::Statement&)>& holds) {
  const char letters[] = {letter, static_cast<char>(std::tolower(static_cast<unsigned char>(letter)))};
  ir::Statement s;
  Diagnostics unused;
  std::uint32_t before = 0;  // lines of the windows before
  return look([&](std::string_view text) {
    SourceLine line;
    while (take_line(text, line)) {
      if (line.text.find_first_of(letters, 0, 2) == std::string_view::npos) continue;
      SourceLine numbered = line;
      numbered.number += before;
      const auto kind = reader.read(numbered, s, unused);
      const bool read = kind == frontends::StreamLine::statement || kind == frontends::StreamLine::program_end;
      if (read && holds(s)) return true;
    }
    before += line.number;
    return false;
  });
}

void StreamTools::look(const frontends::Frontend& frontend, FileId file, const std::string& path,
                       const frontends::ReadOptions& options, const ir::LegaliseContext& context) {
  const auto reader = frontend.stream(file, options, path);
  program_ = reader->frame();
  program_.routines.resize(1);
  ir::Body& body = program_.routines.front().body;
  any_line(options.look, 'T', *reader, [&](const ir::Statement& s) {
    const auto* block = std::get_if<ir::Block>(&s.node);
    if (block == nullptr) return false;
    for (const auto& a : block->actions) {
      const auto* tool = std::get_if<ir::ToolSelect>(&a.data);
      if (tool == nullptr) continue;
      ir::ToolSelect kept = *tool;
      kept.name = program_.keep(std::string(tool->name));
      kept.number.text = {};
      ir::Statement one;
      one.line.span = s.line.span;
      one.node = ir::Block{};
      ir::Action action = a;
      action.text = {};
      action.data = std::move(kept);
      std::get<ir::Block>(one.node).actions.push_back(std::move(action));
      body.push_back(std::move(one));
    }
    return false;
  });
  std::vector<std::string> names;
  for (const auto& s : body) names.emplace_back(ir::action_in<ir::ToolSelect>(std::get<ir::Block>(s.node))->name);
  ir::run_pass(ir::tool_pass, program_, context);
  const std::size_t added = body.size() - names.size();
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i].empty()) continue;
    numbers_[names[i]] = ir::action_in<ir::ToolSelect>(std::get<ir::Block>(body[added + i].node))->number;
  }
  body.resize(added);
  table_ = std::move(body);
}

void StreamTools::apply(ir::Block& block) const {
  for (auto& a : block.actions) {
    auto* tool = std::get_if<ir::ToolSelect>(&a.data);
    if (tool == nullptr || tool->name.empty()) continue;
    const auto it = numbers_.find(tool->name);
    if (it == numbers_.end()) continue;
    tool->number = it->second;
    tool->name = {};
    a.text = {};
  }
}

void StreamTools::put_table(ir::Body& body) const {
  body.insert(ir::passes::below_head(body), table_.begin(), table_.end());
}

}  // namespace cnctrans::translator
