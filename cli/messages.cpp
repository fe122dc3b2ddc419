#include "cli/messages.h"

#include "base/text.h"
#include "cli/common.h"

namespace cnctrans::cli {

void Messages::append(const Diagnostics& diagnostics, const FileTable& files) {
  if (diagnostics.empty()) return;
  const std::string array = render_json(diagnostics, files);
  const auto first = array.find('[') + 1;
  const std::string_view elements(array.data() + first, array.rfind(']') - first);
  if (!list_.empty()) list_ += ",\n  ";
  list_ += trim(elements);
}

void Messages::add(const Diagnostics& diagnostics, const FileTable& files) {
  if (json_) return append(diagnostics, files);
  if (!diagnostics.empty()) write_all(stderr, render_text(diagnostics, files, colour_));
}

void Messages::say(Severity severity, std::string_view code, std::string_view line) {
  if (!json_) {
    write_all(stderr, std::string(line) + "\n");
    return;
  }
  constexpr std::string_view name = "cnctrans: ";
  Diagnostics one;
  one.add({std::string(code), severity, {}, std::string(line.substr(line.starts_with(name) ? name.size() : 0)), {}});
  append(one, FileTable{});
}

void Messages::finish() {
  if (json_ && !finished_) write_all(stderr, list_.empty() ? "[]\n" : "[\n  " + list_ + "\n]\n");
  finished_ = true;
}

}  // namespace cnctrans::cli
