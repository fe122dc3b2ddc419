#include "translator/files/archives.h"

#include <algorithm>
#include <array>

#include "base/text.h"
#include "frontends/sinumerik/program/archive.h"

namespace cnctrans::translator {

namespace {

struct ArchiveForm {
  std::string_view dialect, subprogram_ending;
  std::vector<ArchivePart> (*take_apart)(std::string_view);
  std::string (*put_together)(const std::vector<ArchivePart>&);
};
constexpr std::array forms{
    ArchiveForm{"sinumerik", ".spf", frontends::sinumerik::take_apart, frontends::sinumerik::put_together}};

const ArchiveForm* form_of(const Dialect& dialect) {
  const auto found = std::find_if(forms.begin(), forms.end(), [&](const auto& f) { return f.dialect == dialect.name; });
  return found == forms.end() ? nullptr : &*found;
}

}  // namespace

bool is_subprogram_file(const Dialect& dialect, std::string_view path) {
  const ArchiveForm* form = form_of(dialect);
  const std::string_view ending = form == nullptr ? std::string_view() : form->subprogram_ending;
  return !ending.empty() && path.size() > ending.size() &&
         iequals_ascii(path.substr(path.size() - ending.size()), ending);
}

bool has_archives(const Dialect& dialect) {
  return form_of(dialect) != nullptr;
}

std::vector<ArchivePart> take_apart(const Dialect& dialect, std::string_view bytes) {
  const ArchiveForm* form = form_of(dialect);
  return form == nullptr ? std::vector<ArchivePart>() : form->take_apart(bytes);
}

std::string put_together(const Dialect& dialect, const std::vector<ArchivePart>& parts) {
  return form_of(dialect)->put_together(parts);
}

}  // namespace cnctrans::translator
