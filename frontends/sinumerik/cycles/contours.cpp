// Contours that milling cycles work along: by their own parameter, or by CYCLE62 before them (reference-language 18.3).
#include <algorithm>
#include <string>

#include "base/saturate.h"
#include "base/text.h"
#include "dialects/sinumerik/milling.h"
#include "frontends/sinumerik/cycles/cycle_arguments.h"
#include "frontends/sinumerik/state/statements.h"
#include "ir/cycles/milling/milling.h"

namespace cnctrans::sinumerik {

using syntax::Expr;
using syntax::ExprKind;

bool StatementLowering::moves_nothing(const std::string& name, const std::vector<Expr>& args, WordPos pos) {
  const bool bare = std::all_of(args.begin(), args.end(), [](const Expr& e) { return e.kind == ExprKind::missing; });
  if (name != contour_cycle) return false;
  if (bare || c_.contours.used) c_.contours = {};
  if (bare) return true;
  bool good = args.size() <= 4;
  const auto text = [&](std::size_t i) -> std::string {
    if (i >= args.size() || args[i].kind == ExprKind::missing) return {};
    good = good && args[i].kind == ExprKind::string;
    return to_upper_ascii(std::string(trim(args[i].text)));
  };
  const std::string contour = text(0), first = text(2), last = text(3);
  int type = 0;
  if (args.size() > 1 && args[1].kind != ExprKind::missing) {
    Attribute attribute = Attribute::none;
    const ir::Value v = exprs_.value_of(args[1], attribute);
    type = v.literal() ? saturate<int>(v.number) : -1;
  }
  good = good && type >= 0 && type <= 3 && (type == 2 || !contour.empty());
  good = good && (type < 2 || (!first.empty() && !last.empty()));
  if (!good) {
    c_.error("SIN-021", pos,
             name + " takes a fixed name, its kind 0 to 3, and for the kinds 2 and 3 the labels at both ends");
    return true;
  }
  auto& words = c_.contours.list.emplace_back();
  if (type == 0 || type == 3) contour_words(contour, words);
  if (type == 1) contour_words(std::string(contour_begin) + contour + ':' + std::string(contour_end) + contour, words);
  if (type >= 2) contour_words(first + ':' + last, words);
  return true;
}

bool milling_contour(const MillingCycle& cycle, const Arguments& a, ir::HoleCycle& hole, FileContext& c, WordPos pos) {
  const ir::Value name = a.get(mill_contour_parameter);
  const auto* text = name.expr ? std::get_if<ir::String>(&name.expr->node) : nullptr;
  if (text != nullptr && !trim(text->text).empty()) {
    contour_words(std::string(trim(text->text)), hole.mill.words);
    return true;
  }
  if (text == nullptr && a.given(mill_contour_parameter)) {
    c.error("SIN-021", pos,
            "the contour of " + std::string(cycle.name) + " is a fixed name, or two labels with a colon");
    return false;
  }
  if (c.contours.list.size() != 1) {
    c.error("SIN-021", pos,
            std::string(cycle.name) + " without a name needs one contour by " + std::string(contour_cycle) +
                " before it, with no label, call or structure between them");
    return false;
  }
  c.contours.used = true;
  for (const auto& word : c.contours.list.front()) hole.mill.words.push_back(word);
  hole.mill.words.emplace_back(std::string(ir::cycles::kept_word) + std::string(mill_contour_parameter), ir::Value(0));
  return true;
}

}  // namespace cnctrans::sinumerik
