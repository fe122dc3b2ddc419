#include "legaliser/names/declared_arrays.h"

#include <algorithm>
#include <map>
#include <set>

#include "base/text.h"
#include "ir/edit/rewrite.h"
#include "legaliser/edit/given_names.h"

namespace cnctrans::ir::passes {

namespace {

constexpr std::int64_t most_numbers = 60;       ///< elements that numbers are given for
constexpr std::int64_t most_elements = 10'000;  ///< of an array
constexpr std::int64_t most_variables = 1000;   ///< of a numbered space, where no larger number is written
constexpr std::size_t name_length = 8;
constexpr std::int64_t first = 1;  ///< index of the first element; it may be there from 0 on

using Key = std::pair<SpaceId, std::string>;  ///< a numbered space has no name

class DeclaredArrays {
 public:
  DeclaredArrays(Program& program, const LegaliseContext& context) : program_(program), context_(context) {}

  void run() {
    look();
    for (const auto& [key, a] : arrays_) choose(key, a);
    if (names_.empty()) return;
    space_ = static_cast<SpaceId>(program_.spaces.size());
    VariableSpace space;
    space.prefix = array_prefix;
    space.scope = Scope::program;
    space.starts_at_zero = true;
    program_.spaces.push_back(std::move(space));
    for (auto& r : program_.routines) {
      for_each_statement(r.body, [this](Statement& s) { rename(s); });
      declare(r.body);
    }
    declare_numbered();
    number_statements(program_);
  }

 private:
  struct Array {
    std::vector<std::int64_t> dimensions;
    bool computed = false, good = true;
    std::int64_t highest = 0;  ///< number that is written
    Span where;                ///< of the first computed index, else of its definition
  };

  void look() {
    const auto use = [this](const VarRef& v, const Statement& s) {
      if (v.space >= program_.spaces.size()) return;
      const bool named = program_.spaces[v.space].named();
      if (named && v.indices.empty()) {
        if (const auto it = arrays_.find({v.space, v.name}); it != arrays_.end()) it->second.good = false;
        return;
      }
      const bool computed =
          named ? std::any_of(v.indices.begin(), v.indices.end(), [](const ExprPtr& i) { return !constant_value(i); })
                : v.index && !constant_value(v.index);
      if (!named && v.index && !computed) {
        auto& highest = arrays_[{v.space, v.name}].highest;
        highest = std::max(highest, constant_index(v).value_or(0));
      }
      if (!computed) return;
      Array& a = arrays_[{v.space, v.name}];
      if (!a.computed) a.where = s.line.span;
      a.computed = true;
    };
    for (const auto& r : program_.routines) {
      for_each_statement(r.body, [&](const Statement& s) {
        const auto* d = std::get_if<Declare>(&s.node);
        for (std::size_t k = 0; d != nullptr && k < d->items.size(); ++k) define(*d, d->items[k], s);
      });
    }
    for (const auto& r : program_.routines) {
      for (const auto& p : r.parameters) {
        if (const auto it = arrays_.find({p.variable.space, p.variable.name}); it != arrays_.end())
          it->second.good = false;
      }
      for_each_statement(r.body, [&](const Statement& s) {
        each_target(s, [&](const VarRef& v) { use(v, s); });
        each_expression(s, [&](const ExprPtr& e) {
          walk(e, [&](const ExprPtr& x) {
            if (const auto* v = as_variable(x)) use(*v, s);
          });
        });
      });
    }
  }
  void define(const Declare& d, const Declare::Item& item, const Statement& s) {
    if (d.space >= program_.spaces.size() || !program_.spaces[d.space].named() || item.dimensions.empty()) return;
    Array& a = arrays_[{d.space, item.name}];
    std::vector<std::int64_t> sizes;
    for (const auto& n : item.dimensions) sizes.push_back(static_cast<std::int64_t>(constant_value(n).value_or(0)));
    const bool numbers = d.type == Type::real || d.type == Type::integer || d.type == Type::boolean;
    a.good = a.good && numbers && (a.dimensions.empty() || a.dimensions == sizes);
    a.dimensions = std::move(sizes);
    a.where = s.line.span;
  }

  void choose(const Key& key, Array a) {
    const auto& space = program_.spaces[key.first];
    if (!space.named()) {  // all numbers of the space
      if (space.segments.size() != 1 || space.segments.front().lo != 0 || space.type == Type::string) return;
      a.dimensions = {std::min(space.segments.front().hi + 1, std::max(most_variables, a.highest + 1))};
    }
    std::int64_t elements = 1;
    for (const auto n : a.dimensions) elements *= std::min(n, most_elements);
    const bool given = context_.names != nullptr && context_.names->variables.contains(name_in_map(key.second));
    if (!space.named() && !a.computed) return;
    if (!a.good || a.dimensions.empty() || elements < 1 || elements > most_elements || given ||
        (!a.computed && elements <= most_numbers))
      return;
    const std::string plain = space.named() ? key.second.substr(0, key.second.find('@')) : space.prefix;
    names_[key] = new_name(plain);
    sizes_[key] = a.dimensions;
    if (space.named() && (space.scope != Scope::global || key.second.find('@') != std::string::npos)) return;
    context_.diagnostics.warning("TRN-343", a.where,
                                 plain + " is the array [" + names_[key] +
                                     "] of this program alone in the target: what other programs leave in it or read "
                                     "from it does not reach them",
                                 "set what is read before it is written at the head of the program");
  }
  std::string new_name(const std::string& plain) {
    std::string base;
    for (const char c : to_upper_ascii(plain)) {
      const bool letter = c >= 'A' && c <= 'Z';
      if (letter || (!base.empty() && c >= '0' && c <= '9')) base += c;
    }
    if (base.empty()) base = "A";
    std::string name = base.substr(0, name_length);
    for (int i = 2; !taken_.insert(name).second; ++i) {
      const std::string number = std::to_string(i);
      name = base.substr(0, name_length - number.size()) + number;
    }
    return name;
  }

  // --- rewriting ------------------------------------------------------------------------------------------------

  [[nodiscard]] ExprPtr index_of(const ExprPtr& e) const {
    const auto n = constant_value(e);
    return n ? number(*n + first) : binary(BinaryOp::add, e, number(first));
  }
  [[nodiscard]] std::optional<VarRef> element(const VarRef& v) const {
    if (v.space >= program_.spaces.size()) return std::nullopt;
    const bool named = program_.spaces[v.space].named();
    const auto it = names_.find({v.space, named ? v.name : std::string()});
    if (it == names_.end()) return std::nullopt;
    VarRef to{space_, it->second, nullptr, {}};
    if (!named) to.indices.push_back(index_of(v.index));
    for (const auto& i : v.indices) to.indices.push_back(index_of(i));
    return to;
  }
  void rename(Statement& s) const {
    visit_statement(s, {[this](const ExprPtr& e) {
                          return map_expr(e, [this](const ExprPtr& x) {
                            const auto* v = as_variable(x);
                            const auto to = v != nullptr ? element(*v) : std::nullopt;
                            return to ? variable(*to, x->type) : x;
                          });
                        },
                        [this](VarRef& v) {
                          if (auto to = element(v)) v = std::move(*to);
                        }});
  }

  [[nodiscard]] Statement declaration(const LineInfo& like, const Key& key) const {
    Declare d;
    d.space = space_;
    d.items.push_back({names_.at(key), {}, {}});
    for (const auto n : sizes_.at(key)) d.items.back().dimensions.push_back(number(static_cast<double>(n + first)));
    Statement s = made(like, std::move(d));
    s.line.skip_mask = 0;
    return s;
  }
  /// Definitions of a routine: what becomes an array of the target stands alone, its first values behind it.
  void declare(Body& body) const {
    Body out;
    for (auto& s : body) {
      auto* d = std::get_if<Declare>(&s.node);
      Body behind;
      const LineInfo like = s.line;
      for (std::size_t k = 0; d != nullptr && k < d->items.size();) {
        const Key key{d->space, d->items[k].name};
        if (!names_.contains(key)) {
          ++k;
          continue;
        }
        behind.push_back(declaration(like, key));
        for (std::size_t i = 0; i < d->items[k].initial.size(); ++i) {
          const ExprPtr& value = d->items[k].initial[i];
          if (value) behind.push_back(make_assign(like, place(key, static_cast<std::int64_t>(i)), value));
        }
        d->items.erase(d->items.begin() + static_cast<std::ptrdiff_t>(k));
      }
      const bool empty = d != nullptr && d->items.empty() && !behind.empty();
      if (empty) move_head(s.line, behind.front().line);
      if (!empty) out.push_back(std::move(s));
      for (auto& b : behind) out.push_back(std::move(b));
    }
    body = std::move(out);
  }
  /// Element number i of the array, row by row.
  [[nodiscard]] VarRef place(const Key& key, std::int64_t i) const {
    VarRef to{space_, names_.at(key), nullptr, {}};
    const auto& sizes = sizes_.at(key);
    to.indices.resize(sizes.size());
    for (std::size_t k = sizes.size(); k-- > 0;) {
      to.indices[k] = number(static_cast<double>(i % sizes[k] + first));
      i /= sizes[k];
    }
    return to;
  }
  void declare_numbered() {
    if (program_.routines.empty()) return;
    const auto* main = program_.main();
    Body& body = main != nullptr ? program_.routines[static_cast<std::size_t>(main - program_.routines.data())].body
                                 : program_.routines.front().body;
    for (const auto& [key, name] : names_) {
      if (!program_.spaces[key.first].named()) body.insert(below_head(body), declaration(LineInfo{}, key));
    }
  }

  Program& program_;
  const LegaliseContext& context_;
  SpaceId space_ = 0;
  std::map<Key, Array> arrays_;
  std::map<Key, std::string> names_;
  std::map<Key, std::vector<std::int64_t>> sizes_;
  std::set<std::string> taken_;
};

}  // namespace

void declare_arrays(Program& program, const LegaliseContext& context) {
  const auto& spaces = context.target.spaces;
  const bool names = std::any_of(spaces.begin(), spaces.end(),
                                 [](const VariableSpace& s) { return s.named() && s.scope == Scope::program; });
  if (!names || context.target.word_indirect || program.dialect == context.target.dialect) return;
  DeclaredArrays(program, context).run();
}

}  // namespace cnctrans::ir::passes
