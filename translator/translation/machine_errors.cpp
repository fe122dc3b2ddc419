#include "translator/translation/machine_errors.h"

#include <algorithm>
#include <set>
#include <string>
#include <utility>

#include "base/text.h"
#include "ir/check/missing_features.h"
#include "ir/edit/rewrite.h"

namespace cnctrans::translator {

namespace {

using DataNames = std::set<std::string>;

/// The feature of data that stay with their machine; empty: of any other datum.
std::string_view feature(const ir::SystemRef& ref, const Dialect& from, const DataNames& read) {
  if (ref.datum != ir::Datum::other || read.contains(ref.text)) return {};
  const std::string_view key = from.datum_feature(to_upper_ascii(ref.text));
  const auto* f = ir::find_missing_feature(key);
  return f != nullptr && f->of_one_machine ? key : std::string_view{};
}

DataNames read_data(const ir::Program& program) {
  DataNames read;
  for (const auto& r : program.routines) {
    ir::for_each_statement(r.body, [&read](const ir::Statement& s) {
      ir::passes::each_expression(s, [&read](const ir::ExprPtr& e) {
        ir::walk(e, [&read](const ir::ExprPtr& x) {
          if (const auto* ref = std::get_if<ir::SystemRef>(&x->node)) read.insert(ref->text);
        });
      });
    });
  }
  return read;
}

}  // namespace

void keep_with_the_machine(ir::Program& program, const Dialect& from) {
  if (from.datum_feature == nullptr) return;
  const DataNames read = read_data(program);
  for (auto& r : program.routines) {
    ir::passes::rewrite_body(r.body, [&](ir::Statement&& s, ir::Body& out) {
      auto* assign = std::get_if<ir::Assign>(&s.node);
      const auto of_machine = [&](const ir::Assign::Item& i) {
        return i.to_system && !feature(i.system, from, read).empty();
      };
      const bool all = assign != nullptr && !assign->items.empty() &&
                       std::all_of(assign->items.begin(), assign->items.end(), of_machine);
      if (all) {
        ir::Opaque o;
        o.text = assign->items.front().system.text;
        o.feature = feature(assign->items.front().system, from, read);
        s.node = std::move(o);
      }
      out.push_back(std::move(s));
    });
  }
}

}  // namespace cnctrans::translator
