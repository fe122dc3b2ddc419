#include "legaliser/data/written_files.h"

#include <set>

#include "ir/edit/file_line.h"
#include "ir/text/texts.h"
#include "legaliser/control/lower_calls.h"

namespace cnctrans::ir::passes {

namespace {

class WrittenFiles {
 public:
  WrittenFiles(Program& program, const LegaliseContext& context) : program_(program), context_(context) {}

  void run() {
    std::set<std::string> names;
    bool computed = false;
    each([&](Statement& s, Message& /*m*/, const FileStatement& f) {
      if (f.use == FileUse::line) return;
      if (!first_.known()) first_ = s.line.span;
      const auto n = constant_value(f.name);
      if (n) names.insert(number_text(*n));
      computed = computed || !n;
    });
    if (!first_.known()) return;
    if (computed || names.size() > 1) {
      context_.diagnostics.error("TRN-622", first_,
                                 "the target names the file in every line that is written, and this program opens "
                                 "several, or one whose number is computed",
                                 "open one program with a fixed number");
      return;
    }
    refuse_calls(*names.begin());
    name_ = string_literal("_N_L" + *names.begin() + "_SPF");
    convert();
    context_.diagnostics.warning("TRN-623", first_,
                                 "the program L" + *names.begin() +
                                     " that this one writes begins with the functions that are in force on the target "
                                     "where it is called, and its header is left out",
                                 "write G90, the plane and the unit into its first lines");
  }

 private:
  template <class Visit>
  void each(const Visit& visit) {
    for (auto& r : program_.routines) {
      for_each_statement(r.body, [&](Statement& s) {
        auto* m = std::get_if<Message>(&s.node);
        if (const auto f = m != nullptr ? file_statement(*m) : std::nullopt) visit(s, *m, *f);
      });
    }
  }

  /// What stands in the program is known when it has been written.
  void refuse_calls(const std::string& name) {
    const auto look = [&](const CallRoutine& c, const Statement& s) {
      if (!c.computed && c.routine.text == name)
        context_.diagnostics.error("TRN-624", s.line.span, "a program that this one has written is not translated",
                                   "run the source with --written, and translate what it has written");
    };
    for (const auto& r : program_.routines) {
      for_each_statement(r.body, [&](const Statement& s) {
        if (const auto* c = std::get_if<CallRoutine>(&s.node)) look(*c, s);
        if (const auto* m = std::get_if<ModalCall>(&s.node); m != nullptr && !m->off && !m->cycle) look(m->call, s);
      });
    }
  }

  void convert() {
    each([&](Statement& s, Message& m, const FileStatement& f) {
      if (f.name && f.use == FileUse::line) return;
      if (f.use == FileUse::append) {  // the first line makes the file where there is none
        s.node = Label{};
        return;
      }
      if (f.use == FileUse::create) {
        context_.diagnostics.warning("TRN-625", s.line.span,
                                     "where the program to be written is there already the source stops with an error; "
                                     "here it is deleted first");
      }
      if (f.use != FileUse::line) m.parts.clear();
      mark_file(m, f.use == FileUse::line ? FileUse::line : FileUse::replace, f.text, name_);
    });
    for (auto& r : program_.routines) {
      bool writes = false;
      for_each_statement(r.body, [&](const Statement& s) {
        const auto* m = std::get_if<Message>(&s.node);
        writes = writes || (m != nullptr && file_statement(*m));
      });
      if (writes) declare_at_top(r, Type::integer, program_.space(""), {std::string(file_outcome)});
    }
  }

  Program& program_;
  const LegaliseContext& context_;
  Span first_;
  ExprPtr name_;
};

}  // namespace

void name_written_files(Program& program, const LegaliseContext& context) {
  if (context.target_machine.policies.file_lines == machine::FileLines::named) WrittenFiles(program, context).run();
}

}  // namespace cnctrans::ir::passes
