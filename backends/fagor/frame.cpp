// Name and header of the file.
#include <algorithm>
#include <cctype>

#include "backends/common/comments.h"
#include "backends/fagor/tables.h"
#include "backends/fagor/writer.h"
#include "base/text.h"
#include "dialects/fagor/limits.h"

namespace cnctrans::backends::fagor {
namespace {

constexpr auto name_digits = static_cast<std::size_t>(dialects::fagor::program_digits);

std::string digits_in(std::string_view text) {
  std::string out;
  std::copy_if(text.begin(), text.end(), std::back_inserter(out), [](char c) { return c >= '0' && c <= '9'; });
  return out;
}

bool is_program_number(std::string_view stem) {
  return stem.size() == name_digits && digits_in(stem).size() == stem.size();
}

std::string number_name(std::string digits) {
  if (digits.size() > name_digits) digits.erase(0, digits.size() - name_digits);
  return std::string(name_digits - digits.size(), '0') + digits;
}

const ir::Routine* first_routine(const ir::Program& program) {
  return program.routines.empty() ? nullptr : &program.routines.front();
}

/// A title as the header takes it.
std::string fit_title(std::string title) {
  title = to_ascii(title, nullptr);
  for (char& c : title) {
    if (c == ',' || c == '_' || c == '\t') c = ' ';
  }
  std::string_view cut = trim(title);
  return std::string(trim(cut.substr(0, static_cast<std::size_t>(dialects::fagor::max_header_comment))));
}

std::string title_of(const ir::Program& program, const WriteOptions& options) {
  const ir::Routine* r = first_routine(program);
  std::string title = r != nullptr ? r->title : std::string{};
  if (title.empty() && r != nullptr) title = r->name.text;
  if (title.empty() && !is_program_number(options.main_stem)) title = to_upper_ascii(options.main_stem);
  return fit_title(std::move(title));
}

std::string header_of(const std::string& title) {
  const bool full = title.size() >= static_cast<std::size_t>(dialects::fagor::max_header_comment);
  return '%' + title + (full ? ",MX," : " ,MX,");
}

}  // namespace

std::string called_file_name(const ir::Routine& first, const std::string& stem, bool lathe) {
  const char* const extension = lathe ? ".PIT" : ".PIM";
  return (is_program_number(stem) ? stem : number_name(std::to_string(std::max<std::int64_t>(first.name.number, 0)))) +
         extension;
}

std::string called_header_line(const ir::Routine& first) {
  const std::string name = first.title.empty() ? first.name.text : first.title;
  return header_of(fit_title(name.empty() ? "SUB " + std::to_string(first.name.number) : name));
}

std::string file_name(const ir::Program& program, const WriteOptions& options, bool lathe) {
  const char* const extension = lathe ? ".PIT" : ".PIM";
  if (is_program_number(options.main_stem)) return options.main_stem + extension;
  const ir::Routine* r = first_routine(program);
  if (r != nullptr && r->kind == ir::RoutineKind::main && r->name.number >= 0 && r->name.number <= 999'999) {
    return number_name(std::to_string(r->name.number)) + extension;
  }
  std::string digits = digits_in(options.main_stem);
  if (digits.empty()) digits = "1";
  return number_name(std::move(digits)) + extension;
}

std::string free_file_name(const std::string& wanted, const WriteOptions& options) {
  std::string name = wanted;
  std::uint32_t tries = 0;
  for (auto n = std::stoul(wanted); options.is_taken(name) && tries <= 999'999; ++tries) {
    n = n == 999'999 ? 1 : n + 1;
    name = number_name(std::to_string(n)) + wanted.substr(name_digits);
  }
  return name;
}

std::string header_line(const ir::Program& program, const WriteOptions& options) {
  const ir::Routine* r = first_routine(program);
  if (program.dialect == dialect_name) {
    if (r == nullptr || (!r->header.span.known() && r->title.empty() && r->attributes.empty())) return {};
    return '%' + r->title + " ," + (r->attributes.empty() ? "MX" : r->attributes) + ',';
  }
  return header_of(title_of(program, options));
}

}  // namespace cnctrans::backends::fagor
