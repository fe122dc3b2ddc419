#include "translator/files/given_names.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

#include "base/text.h"
#include "ir/edit/rewrite.h"

namespace cnctrans::translator {

namespace {

class GivenNames {
 public:
  GivenNames(ir::Program& program, ir::SpaceId space) : program_(program), space_(space) {}

  void find(const std::map<std::string, std::string>* placed) {
    for (const auto& r : program_.routines) {
      ir::for_each_statement(r.body, [this](const ir::Statement& s) {
        ir::passes::each_expression(s, [&](const ir::ExprPtr& e) {
          ir::walk(e, [&](const ir::ExprPtr& x) {
            if (const auto* ref = std::get_if<ir::SystemRef>(&x->node)) use(*ref, s, false);
          });
        });
        const auto* a = std::get_if<ir::Assign>(&s.node);
        if (a == nullptr) return;
        for (const auto& i : a->items) {
          if (i.to_system) use(i.system, s, true);
        }
      });
    }
    std::erase_if(names_, [placed](const auto& n) {
      // `NAME=3` alone may be the word of an axis that the machine's builder has named so.
      const bool variable = n.second.read || !n.second.sizes.empty() || n.first.find('_') != std::string::npos;
      return answered(n.first, placed) || !variable || !n.second.plain || !n.second.written;
    });
  }

  void replace() {
    for (auto& r : program_.routines) {
      for_each_statement(r.body, [this](ir::Statement& s) {
        ir::passes::visit_statement(s, {[this](const ir::ExprPtr& e) { return renamed(e); }, {}});
        auto* a = std::get_if<ir::Assign>(&s.node);
        if (a == nullptr) return;
        for (auto& i : a->items) {
          if (!i.to_system || !names_.contains(i.system.text)) continue;
          i.target = variable(i.system);
          i.system = {};
          i.to_system = false;
        }
      });
    }
  }

  void define(Diagnostics& diagnostics) {
    ir::Body head;
    for (const auto& [name, n] : names_) {
      diagnostics.warning("TRN-464", n.first,
                          "no file at hand defines " + name +
                              ": it is a variable of this translation alone, and what other programs leave in it or "
                              "read from it does not reach them",
                          "translate them with one file of names (--names), or give the file that defines it (--lib)");
      ir::Declare d;
      d.space = space_;
      d.items.push_back({name, {}, {}});
      for (const auto size : n.sizes)
        d.items.back().dimensions.push_back(ir::number(static_cast<double>(size), std::to_string(size)));
      ir::Statement made;
      made.line.span = n.first;
      made.node = std::move(d);
      head.push_back(std::move(made));
    }
    auto& body = program_.routines[head_routine(program_)].body;
    body.insert(body.begin(), std::make_move_iterator(head.begin()), std::make_move_iterator(head.end()));
    ir::number_statements(program_);
  }

  [[nodiscard]] bool empty() const { return names_.empty(); }

 private:
  struct Name {
    Span first;
    bool written = false, read = false;
    bool plain = true;  ///< always with as many written indices
    std::vector<std::int64_t> sizes;
  };

  void use(const ir::SystemRef& ref, const ir::Statement& s, bool writes) {
    if (ref.datum != ir::Datum::other || ref.text.empty() || ref.text.front() == '$') return;
    const auto [it, fresh] = names_.try_emplace(ref.text);
    Name& n = it->second;
    if (fresh) {
      n.first = s.line.span;
      n.sizes.resize(ref.args.size());
    }
    (writes ? n.written : n.read) = true;
    n.plain = n.plain && n.sizes.size() == ref.args.size();
    for (std::size_t i = 0; n.plain && i < ref.args.size(); ++i) {
      constexpr double most = 9999;
      const auto at = ir::constant_value(ref.args[i]);
      n.plain = at && *at >= 0 && *at <= most && *at == std::floor(*at);
      if (n.plain) n.sizes[i] = std::max(n.sizes[i], static_cast<std::int64_t>(*at) + 1);
    }
  }

  [[nodiscard]] ir::VarRef variable(const ir::SystemRef& ref) const { return {space_, ref.text, nullptr, ref.args}; }
  [[nodiscard]] ir::ExprPtr renamed(const ir::ExprPtr& e) const {
    return ir::passes::map_expr(e, [this](const ir::ExprPtr& x) {
      const auto* ref = std::get_if<ir::SystemRef>(&x->node);
      if (ref == nullptr || !names_.contains(ref->text)) return x;
      ir::Expr copy = *x;
      copy.node = variable(*ref);
      return ir::ExprPtr(std::make_shared<const ir::Expr>(std::move(copy)));
    });
  }
  ir::Program& program_;
  ir::SpaceId space_;
  std::map<std::string, Name> names_;
};

}  // namespace

std::optional<ir::SpaceId> global_numbers(const ir::Program& program) {
  for (std::size_t i = 0; i < program.spaces.size(); ++i) {
    const auto& s = program.spaces[i];
    if (s.named() && s.scope == ir::Scope::global && s.type == ir::Type::real && s.prefix.empty())
      return static_cast<ir::SpaceId>(i);
  }
  return std::nullopt;
}

std::size_t head_routine(const ir::Program& program) {
  const auto* main = program.main();
  return main == nullptr ? 0 : static_cast<std::size_t>(main - program.routines.data());
}

bool answered(const std::string& name, const std::map<std::string, std::string>* placed) {
  const std::string element = name.substr(0, name.find('[')) + '[';
  return placed != nullptr && std::any_of(placed->begin(), placed->end(), [&](const auto& entry) {
           return entry.first == name || entry.first.starts_with(element);
         });
}

void define_given_names(ir::Program& program, const Dialect& from, const std::map<std::string, std::string>* placed,
                        Diagnostics& diagnostics) {
  const auto space = global_numbers(program);
  if (from.definition == nullptr || !space || program.routines.empty()) return;
  GivenNames names(program, *space);
  names.find(placed);
  if (names.empty()) return;
  names.replace();
  names.define(diagnostics);
}

}  // namespace cnctrans::translator
