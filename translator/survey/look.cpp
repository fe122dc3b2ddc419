#include "translator/survey/look.h"

#include <algorithm>
#include <filesystem>

#include "base/text.h"
#include "ir/edit/rewrite.h"
#include "legaliser/data/given_data.h"
#include "translator/files/called.h"
#include "translator/files/language.h"
#include "translator/files/readable.h"

namespace cnctrans::translator {

namespace {

constexpr std::size_t cam_blocks = 100;

/// Fills a look from the program that was read.
class Looker {
 public:
  Looker(const ir::Program& program, const Dialect& from, ProgramLook& out)
      : program_(program), from_(from), out_(out) {}

  /// The target's eyes for machine data; null: every datum of the machine counts.
  const ir::LegaliseContext* target = nullptr;

  void run() {
    for (const auto& r : program_.routines) {
      if (!r.name.empty()) out_.routines.insert(call_key(ir::NameMap::key(r.name)));
      has_main_ = has_main_ || r.kind == ir::RoutineKind::main;
      parameters_ = parameters_ || !r.parameters.empty();
      ir::for_each_statement(r.body, [this](const ir::Statement& s) { statement(s); });
    }
    out_.kind = kind();
  }

 private:
  void uses(const char* feature) { out_.features.insert(feature); }

  void statement(const ir::Statement& s) {
    if (s.line.skip_mask != 0) uses("block skip");
    std::visit([this](const auto& node) { of(node); }, s.node);
    ir::passes::each_expression(s, [this](const ir::ExprPtr& e) { expression(e); });
    if (const auto* a = std::get_if<ir::Assign>(&s.node)) {
      for (const auto& i : a->items) {
        if (i.to_system) datum(i.system);
      }
    }
  }
  void expression(const ir::ExprPtr& e) {
    ir::walk(e, [this](const ir::ExprPtr& x) {
      if (const auto* ref = std::get_if<ir::SystemRef>(&x->node)) datum(*ref);
      if (ir::passes::as_variable(x) != nullptr) ++control_;
    });
  }
  void datum(const ir::SystemRef& ref) {
    uses("machine data");
    ++data_;
    if (ref.datum != ir::Datum::other || ref.text.empty()) return;
    if (from_.definition != nullptr && ref.text.front() != '$') {
      ++out_.names[to_upper_ascii(ref.text)].times;
      return;
    }
    if (target != nullptr && ir::passes::has_name(ref, *target)) return;
    ++out_.data[to_upper_ascii(ir::passes::name_of_datum(ref, program_))].times;
  }

  void call(const ir::CallRoutine& c) {
    uses("calls");
    ++calls_;
    if (c.computed) return uses("computed calls");
    if (!c.arguments.empty()) uses("calls with arguments");
    if (c.has_range || c.optional || c.routine.empty() || program_.find(c.routine) != nullptr) return;
    Need& need = out_.calls[ir::NameMap::key(c.routine)];
    ++need.times;
    for (std::size_t i = 0; i < c.arguments.size(); ++i) {
      const std::string& letter = c.arguments[i].name;
      const auto& have = need.arguments;
      if (letter.empty() ? i >= have.size() : std::find(have.begin(), have.end(), letter) == have.end())
        need.arguments.push_back(letter);
    }
  }

  void of(const ir::Block& b) {
    ++statements_;
    if (b.has_motion && b.motion.moves()) motion(b.motion);
    if (b.repeat_given != 0) uses("repeated blocks");
    for (const auto& a : b.actions) std::visit([this](const auto& data) { action(data); }, a.data);
  }
  void of(const ir::Assign& a) {
    ++statements_;
    control_ += a.items.size();
    uses("variables");
  }
  void of(const ir::If& /*i*/) { structure("conditions"); }
  void of(const ir::While& /*w*/) { structure("loops"); }
  void of(const ir::Until& /*u*/) { structure("loops"); }
  void of(const ir::For& /*f*/) { structure("loops"); }
  void of(const ir::Loop& /*l*/) { structure("loops"); }
  void of(const ir::Exit& /*e*/) {}
  void of(const ir::Jump& j) { structure(j.target.computed ? "computed jumps" : "jumps"); }
  void of(const ir::Switch& /*s*/) { structure("jumps"); }
  void of(const ir::Repeat& r) {
    structure("repeated parts");
    if (r.has_program && program_.find(r.program) == nullptr) ++out_.calls[ir::NameMap::key(r.program)].times;
  }
  void of(const ir::CallRoutine& c) {
    ++statements_;
    call(c);
  }
  void of(const ir::ModalCall& m) {
    ++statements_;
    if (m.off || m.cycle) return;
    uses("modal calls");
    call(m.call);
  }
  void of(const ir::Return& /*r*/) {}
  void of(const ir::End& /*e*/) { ++statements_; }
  void of(const ir::Message& /*m*/) {
    ++statements_;
    uses("messages and files");
  }
  void of(const ir::Declare& /*d*/) {
    ++declares_;
    uses("variables");
  }
  void of(const ir::Label& /*l*/) {}
  void of(const ir::Opaque& o) {
    ++statements_;
    if (!o.harmless) uses("lines that are kept as text");
  }
  void structure(const char* what) {
    ++statements_;
    ++control_;
    uses(what);
  }

  void motion(const ir::Motion& m) {
    ++motions_;
    switch (m.kind) {
      case ir::MotionKind::modal:
      case ir::MotionKind::rapid:
      case ir::MotionKind::linear: break;
      case ir::MotionKind::arc_cw:
      case ir::MotionKind::arc_ccw:
      case ir::MotionKind::arc_through_point:
      case ir::MotionKind::arc_tangent: uses("arcs"); break;
      case ir::MotionKind::thread:
      case ir::MotionKind::thread_variable: uses("threads"); break;
      case ir::MotionKind::probe_toward:
      case ir::MotionKind::probe_away:
      case ir::MotionKind::to_stop: uses("probing"); break;
      case ir::MotionKind::tap_rigid:
      case ir::MotionKind::tap_rigid_out:
      case ir::MotionKind::tap_floating: uses("taps"); break;
      case ir::MotionKind::reference_point:
      case ir::MotionKind::fixed_point: uses("reference points"); break;
      default: uses("splines and polynomials"); break;
    }
    for (const auto& c : m.coords) {
      if (c.axis >= ir::axis::a && c.axis <= ir::axis::c) uses("rotary axes");
    }
  }

  template <class Action>
  void action(const Action& /*a*/) {}
  void action(const ir::ModalSet& m) {
    if (m.setting == ir::Setting::comp && m.value != 0) uses("radius compensation");
    if (m.setting == ir::Setting::units && m.value != static_cast<std::uint8_t>(ir::Units::metric)) uses("inches");
    if (m.setting == ir::Setting::spindle_mode && m.value != 0) uses("constant cutting speed");
  }
  void action(const ir::ToolChange& /*t*/) { uses("tool changes"); }
  void action(const ir::ToolSelect& /*t*/) { uses("tool changes"); }
  void action(const ir::FrameOp& f) {
    if (!f.change) return;
    switch (f.change->kind) {
      case ir::FrameKind::translate: uses("zero shifts"); break;
      case ir::FrameKind::rotate: uses("rotations"); break;
      case ir::FrameKind::scale: uses("scales"); break;
      case ir::FrameKind::mirror: uses("mirrors"); break;
    }
  }
  void action(const ir::WorkOffset& /*w*/) { uses("zero points of the table"); }
  void action(const ir::PoleSet& /*p*/) { uses("polar words"); }
  void action(const ir::CycleDefine& c) {
    const bool hole = c.cycle && std::holds_alternative<ir::HoleCycle>(c.cycle->node);
    uses(hole ? "drilling and pocket cycles" : "other cycles");
  }
  void action(const ir::Corner& /*c*/) { uses("corners"); }
  void action(const ir::SurfaceSet& /*s*/) { uses("face and cylinder"); }
  void action(const ir::SplineAxes& /*s*/) { uses("splines and polynomials"); }
  void action(const ir::SpindleOrient& /*s*/) { uses("oriented spindle"); }

  [[nodiscard]] std::string kind() const {
    if (statements_ + declares_ == 0) return "no program";
    if (statements_ == 0) return "data";
    const bool moves = motions_ != 0 || calls_ != 0;
    if (!has_main_ && (parameters_ || data_ != 0)) return "machine's own";
    if (!moves && data_ != 0) return "machine's own";
    const std::size_t logic = control_ + calls_;
    if (statements_ >= cam_blocks && logic * 50 <= statements_) return "CAM output";
    return logic != 0 ? "parametric" : "plain";
  }

  const ir::Program& program_;
  const Dialect& from_;
  ProgramLook& out_;
  std::size_t statements_ = 0, motions_ = 0, control_ = 0, calls_ = 0, data_ = 0, declares_ = 0;
  bool has_main_ = false, parameters_ = false;
};

/// The dialect whose extension the file has, where that says something.
const Dialect* by_extension(const SourceText& source) {
  const std::string extension = source.extension();
  if (extension.empty() || extension == "nc" || extension == "txt") return nullptr;
  const auto in = [&extension](const std::vector<std::string_view>& list) {
    return std::find(list.begin(), list.end(), extension) != list.end();
  };
  for (const auto& d : dialects()) {
    if (readable(d) && (in(d.mill_extensions) || in(d.lathe_extensions) || in(d.other_extensions))) return &d;
  }
  return nullptr;
}

void look_as(const Dialect& dialect, const SourcePtr& source, const InputOptions& options, const Dialect* to,
             ProgramLook& out) {
  std::string error;
  const auto profile = choose_profile(dialect, options.machine, source.get(), &error);
  if (!profile) return;
  Loader loader(dialect, *profile, options.reader, options.libraries);
  Diagnostics said;
  frontends::ReadStats stats;
  const ir::Program* program = loader.read_source(source, said, &stats);
  out.lines = stats.lines;
  out.blocks = stats.blocks;
  out.unread = stats.blocks - stats.blocks_read;
  if (loader.foreign()) {
    const auto other = find_language(*source).dialect;
    if (other != nullptr) out.dialect = std::string(other->name);
    return;
  }
  if (out.blocks != 0 && out.unread * 2 >= out.blocks) return;  // some text
  out.dialect = std::string(dialect.name);
  out.routines.insert(call_key(source->stem()));
  Looker looker(*program, dialect, out);
  std::optional<machine::Profile> target;
  std::optional<ir::LegaliseContext> context;
  if (to != nullptr) target = choose_target(*to, {}, *profile, &error);
  if (target) {
    const auto& can = to->backend->capabilities_for(*target);
    context.emplace(ir::LegaliseContext{can, *profile, *target, {}, said, nullptr, nullptr, nullptr});
    looker.target = &*context;
  }
  looker.run();
}

}  // namespace

const std::vector<std::string>& program_kinds() {
  static const std::vector<std::string> all{"CAM output", "parametric", "plain", "machine's own", "data", "no program"};
  return all;
}

std::string call_key(const std::string& name) {
  std::string key = to_upper_ascii(name);
  const auto digit = key.find_first_of("0123456789");
  if (digit > 1 || key.find_first_not_of("0123456789", digit) != std::string::npos) return key;
  const auto first = std::min(key.find_first_not_of('0', digit), key.size() - 1);
  return key.substr(first);
}

ProgramLook look_at(const std::string& path, const InputOptions& options, const std::string& from, const Dialect* to) {
  ProgramLook out;
  out.path = path;
  out.kind = "no program";
  std::string error;
  const SourcePtr source = SourceText::open(path, &error);
  if (!source) return out;
  const Dialect* dialect = from.empty() ? by_extension(*source) : find_dialect(from);
  if (dialect != nullptr) look_as(*dialect, source, options, to, out);
  // An extension is believed where the reader understands the text.
  constexpr std::size_t few = 20;
  if (!from.empty() || (dialect != nullptr && out.kind != "no program" && out.unread * few <= out.blocks)) return out;
  const Dialect* found = find_language(*source).dialect;
  if (found == nullptr || found == dialect) return out;
  ProgramLook other;
  other.path = path;
  other.kind = "no program";
  look_as(*found, source, options, to, other);
  return other;
}

}  // namespace cnctrans::translator
