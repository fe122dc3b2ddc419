// What a row of items holds once it is sorted. Only for the .cpp files of StatementLowering.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "frontends/sinumerik/state/statements.h"

namespace cnctrans::sinumerik {

struct StatementLowering::Parts {
  ir::Assign assign;
  syntax::Block words;  ///< the address words; `exprs` is the source block's
  std::vector<std::pair<const GFunction*, WordPos>> indirect;
  std::vector<ir::Action> actions;  ///< further actions (spindle positions, preparation stop)
  std::vector<ir::StatementNode> calls;
  std::vector<ir::CoordWord> coords;         ///< positioning axes, axes named by a constant
  std::vector<ir::ComputedWord> computed;    ///< axes named by a variable
  std::vector<ir::CenterWord> centers;       ///< IP[..]
  const syntax::Expr* probe_edge = nullptr;  ///< MEASA, MEAWA: the first edge asked for
  bool probe_goes_on = false;
  std::string beside_text;  ///< what acts beside the path, as it stands
  std::string_view beside_feature;
  std::vector<ir::PolynomialWord> polynomials;  ///< PO[..]
  bool has_count = false;
  ir::ExprPtr count;
  WordPos count_pos;

  /// A further action, written at `pos` as `text`.
  ir::Action& act(ir::ActionData data, WordPos pos, std::string_view text) {
    ir::Action a;
    a.data = std::move(data);
    a.pos = pos;
    a.text = text;
    return actions.emplace_back(std::move(a));
  }
};

}  // namespace cnctrans::sinumerik
