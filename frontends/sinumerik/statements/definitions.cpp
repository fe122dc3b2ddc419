// Definition files of a machine (SGUD, MGUD, UGUD, GUD4.. with DEF NCK and DEF CHAN, SMAC, MMAC, UMAC with DEFINE):
// language reference 3.3, 8.6. They are read like programs; what they define is known to every routine.
#include "base/saturate.h"
#include "base/text.h"
#include "frontends/sinumerik/state/context.h"

namespace cnctrans::sinumerik {

namespace {

bool character_type(std::string_view type_text) {
  return type_text == "CHAR" || type_text.ends_with(" CHAR") || type_text.find(" CHAR ") != std::string_view::npos;
}

Symbol symbol_of(const ir::Declare& d, const ir::Declare::Item& item) {
  Symbol symbol;
  symbol.type = d.type;
  symbol.space = d.space;
  symbol.dimensions = static_cast<std::uint8_t>(item.dimensions.size());
  symbol.character = character_type(d.type_text);
  symbol.of_machine = true;
  for (std::size_t i = 0; i < symbol.sizes.size() && i < item.dimensions.size(); ++i) {
    const auto* n = item.dimensions[i] ? std::get_if<ir::Number>(&item.dimensions[i]->node) : nullptr;
    if (n != nullptr && n->value >= 1) symbol.sizes[i] = saturate<std::uint32_t>(n->value);
  }
  return symbol;
}

/// `DEFINE NAME AS TEXT`: the next word of `text`, which is taken off.
std::string_view next_word(std::string_view& text) {
  text = trim(text);
  std::size_t end = 0;
  while (end < text.size() && text[end] != ' ' && text[end] != '\t') ++end;
  const std::string_view word = text.substr(0, end);
  text.remove_prefix(end);
  return word;
}

}  // namespace

void FileContext::take_definitions() {
  if (definitions == nullptr) return;
  for (const ir::Program* of_machine : *definitions) {
    for (const auto& routine : of_machine->routines) {
      ir::for_each_statement(routine.body, [this](const ir::Statement& s) {
        if (const auto* d = std::get_if<ir::Declare>(&s.node)) {
          if (d->space < space::global_real || d->space > space::global_string) return;
          for (const auto& item : d->items) symbols.insert_or_assign(item.name, symbol_of(*d, item));
        } else if (const auto* o = std::get_if<ir::Opaque>(&s.node); o != nullptr && o->feature == "language.macro") {
          std::string_view rest = o->text;
          if (!iequals_ascii(next_word(rest), "DEFINE")) return;
          const std::string name = to_upper_ascii(next_word(rest));
          if (iequals_ascii(next_word(rest), "AS") && !name.empty())
            macros.insert_or_assign(name, std::string(trim(rest)));
        }
      });
    }
  }
}

}  // namespace cnctrans::sinumerik
