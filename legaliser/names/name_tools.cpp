// Tools called by their names, for a target that knows numbers only: the number that a tool table gives, else the next
// one that the program does not use; a table of them stands at the head of the main program.
#include <algorithm>
#include <map>
#include <set>

#include "base/saturate.h"
#include "ir/edit/rewrite.h"
#include "legaliser/early_passes.h"
#include "legaliser/edit/blocks.h"

namespace cnctrans::ir::passes {

namespace {

class ToolNumbers {
 public:
  ToolNumbers(Program& program, const LegaliseContext& context) : program_(program), context_(context) {}

  void run() {
    bool named = false;
    each_tool([&](ToolSelect& t, const Statement& s, const Action& a) {
      named = named || !t.name.empty();
      if (!t.name.empty()) return;
      if (t.number.literal()) taken_.insert(saturate<std::int32_t>(t.number.number));
      if (!t.number.literal() && computed_ == nullptr) computed_ = &a;
      if (!t.number.literal()) computed_at_ = s.line.span;
    });
    if (!named) return;
    for (const auto* machine : {&context_.target_machine, &context_.source_machine}) {
      for (const auto& t : machine->tools) taken_.insert(t.number);
    }
    each_tool([this](ToolSelect& t, const Statement& s, const Action& a) {
      if (t.name.empty()) return;
      t.number = Value(number_of(t.name, s, a));
      t.name = {};
    });
    put_table();
  }

 private:
  template <class Visit>
  void each_tool(const Visit& visit) {
    for (auto& r : program_.routines) {
      for_each_statement(r.body, [&](Statement& s) {
        auto* b = std::get_if<Block>(&s.node);
        if (b == nullptr) return;
        for (auto& a : b->actions) {
          auto* t = std::get_if<ToolSelect>(&a.data);
          if (t == nullptr) continue;
          const bool named = !t->name.empty();
          visit(*t, s, a);
          if (named && t->name.empty()) a.text = {};  // made: not as written
        }
      });
    }
  }

  std::int32_t number_of(std::string_view name, const Statement& s, const Action& a) {
    const std::string key(name);
    if (const auto it = numbers_.find(key); it != numbers_.end()) return it->second;
    std::int32_t number = 0;
    for (const auto* machine : {&context_.target_machine, &context_.source_machine}) {
      for (const auto& t : machine->tools) {
        if (number == 0 && t.name == name) number = t.number;
      }
    }
    const bool by_table = number != 0;
    while (number == 0 || (!by_table && taken_.count(number) != 0)) ++number;
    taken_.insert(number);
    numbers_.emplace(key, number);
    order_.emplace_back(number, std::string(name));
    if (!by_table) {
      context_.diagnostics.warning(
          "TRN-145", word_span(s.line.span, a.pos),
          "the target selects tools by number: \"" + std::string(name) + "\" becomes T" + std::to_string(number),
          "put the tool there, or name it in \"tools\" of the machine profile");
    }
    return number;
  }

  void put_table() {
    if (computed_ != nullptr) {
      context_.diagnostics.warning(
          "TRN-145", computed_at_,
          "tools are called by their names and by computed numbers: the numbers that the names "
          "got may be those of other tools",
          "name the tools in \"tools\" of the machine profile");
    }
    auto main = std::find_if(program_.routines.begin(), program_.routines.end(),
                             [](const Routine& r) { return r.kind == RoutineKind::main; });
    if (main == program_.routines.end()) return;
    Body head;
    for (const auto& [number, name] : order_)
      head.push_back(make_comment("T" + std::to_string(number) + " = " + name, program_));
    main->body.insert(below_head(main->body), std::make_move_iterator(head.begin()),
                      std::make_move_iterator(head.end()));
  }

  Program& program_;
  const LegaliseContext& context_;
  std::set<std::int32_t> taken_{0};
  std::map<std::string, std::int32_t> numbers_;              ///< by name
  std::vector<std::pair<std::int32_t, std::string>> order_;  ///< as the program calls them
  const Action* computed_ = nullptr;
  Span computed_at_;
};

}  // namespace

void number_tools(Program& program, const LegaliseContext& context) {
  if (program.dialect != context.target.dialect) ToolNumbers(program, context).run();
}

}  // namespace cnctrans::ir::passes
