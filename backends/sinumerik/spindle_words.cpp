// Words of the spindles (14.8).
#include "backends/sinumerik/writer.h"

namespace cnctrans::backends::sinumerik {

namespace {

std::string numbered(std::string_view address, std::uint8_t number) {
  return number == 1 ? std::string(address) : std::string(address) + std::to_string(number);
}

}  // namespace

/// Alone in its block. Where the program chooses its master spindle, words of spindle 1 carry their number too.
void Writer::master_spindle(const ir::Action& a, const ir::MasterSpindle& m) {
  next_line();
  add("SETMS(" + std::to_string(m.number) + ')', Rank::head, a.pos);
  next_line();
}

std::string Writer::of_spindle(const char* address, std::uint8_t number) const {
  return number == 1 && chooses_master_ ? std::string(address) + '1' : numbered(address, number);
}

void Writer::set_spindle(const ir::Action& a, const ir::SetSpindle& s) {
  add(word(of_spindle("S", s.number), s.value, a.pos), Rank::spindle, a.pos);
}

void Writer::spindle_run(const ir::Action& a, const ir::SpindleRun& s) {
  if (s.number == 1 && !chooses_master_) return ProgramWriter::spindle_run(a, s);
  const char* code = s.state == ir::SpindleState::cw ? "3" : s.state == ir::SpindleState::ccw ? "4" : "5";
  add(of_spindle("M", s.number) + '=' + code, Rank::machine, a.pos);
}

void Writer::spindle_orient(const ir::Action& a, const ir::SpindleOrient& s) {
  const std::string address = s.number == 1 && !chooses_master_ ? "SPOS" : "SPOS[" + std::to_string(s.number) + ']';
  add(s.incremental ? attribute_word(address, "IC", s.angle, a.pos) : word(address, s.angle, a.pos), Rank::spindle,
      a.pos);
}

void Writer::spindle_limit(const ir::Action& a, const ir::SpindleLimit& s) {
  const bool by_g = same_dialect() && !a.text.empty();  // G25 S, G26 S
  if (s.lower || by_g) {
    next_line();
    add((s.lower ? "G25 " : "G26 ") + word(numbered("S", s.number), s.value, a.pos), Rank::head, a.pos);
    return next_line();
  }
  const std::string address = s.number == 1 && !chooses_master_ ? "LIMS" : "LIMS[" + std::to_string(s.number) + ']';
  add(word(address, s.value, a.pos), Rank::spindle, a.pos);
}

}  // namespace cnctrans::backends::sinumerik
