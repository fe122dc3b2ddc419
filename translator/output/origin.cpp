#include "translator/output/origin.h"

#include <algorithm>
#include <filesystem>

#include "base/transliterate.h"
#include "ir/edit/rewrite.h"

namespace cnctrans::translator {

std::string origin_text(const TranslateOptions& options, const std::string& path) {
  const Dialect* from = find_dialect(options.from);
  if (!options.origin || options.from == options.to || from == nullptr) return {};
  const std::string file = to_ascii(std::filesystem::path(path).filename().string(), nullptr);
  std::string text = "translated from ";
  if (!file.empty() && file != "-") text += file + ", ";
  return text + std::string(from->title);
}

void put_origin(ir::Program& program, const std::string& text) {
  const auto main = std::find_if(program.routines.begin(), program.routines.end(),
                                 [](const ir::Routine& r) { return r.kind == ir::RoutineKind::main; });
  if (text.empty() || program.routines.empty()) return;
  ir::Body& body = (main != program.routines.end() ? *main : program.routines.front()).body;
  const auto at = std::find_if_not(body.begin(), body.end(), ir::passes::is_remark);
  ir::Statement remark = ir::passes::make_comment(text, program);
  if (!body.empty()) remark.line.span.file = body.front().line.span.file;
  body.insert(at, std::move(remark));
  ir::number_statements(program);
}

}  // namespace cnctrans::translator
