// The parts of build_cycle(): one definition and what it becomes.
#pragma once

#include <string>
#include <string_view>
#include <utility>

#include "dialects/heidenhain/cycle_words.h"
#include "frontends/heidenhain/cycles/build.h"

namespace cnctrans::frontends::heidenhain {

class CycleBuilder {
 public:
  CycleBuilder(const CycleDefinition& cycle, const CycleContext& context, Report& report)
      : cycle_(cycle), context_(context), report_(report) {}

  ir::CyclePtr build();

 private:
  [[nodiscard]] ir::Value q(std::int16_t number) const { return context_.value(number); }
  bool refuse(std::string message);
  bool not_carried() { return refuse("not carried yet"); }
  void warn(std::string message);
  bool only_value(std::int16_t number);
  /// FMAX, or the number that programs write for it.
  [[nodiscard]] bool rapid(std::int16_t number) const;

  bool levels();
  /// The cycle is told by peck_moves().
  bool as_moves();
  bool feed_in(std::int16_t number = 206);
  /// Q208: 0 is the feed itself.
  bool feed_out();
  bool tip();
  /// One stroke where the peck is not smaller than the depth.
  [[nodiscard]] bool one_stroke(const ir::Value& peck) const;
  void pecks(const ir::Value& peck);

  bool hole();
  bool drill();
  bool ream();
  /// The tip is freed by 0.2 mm toward Q214, then the retract.
  bool bore();
  bool universal();
  bool pecking();
  bool tap();
  bool tap_in_pecks();
  bool centre();

  // milling.cpp

  void word(std::string_view name, ir::Value v) { hole_.mill.words.emplace_back(std::string(name), std::move(v)); }
  bool mill();
  bool climb();
  bool helix_bore();
  bool helix_thread();
  /// 230: one level in lines to and fro; 232: in levels, Q389 2 in lines one way.
  bool face();
  /// 22, 23 and 24 in one pocket of cycle 14.
  bool area();

  bool mill_word(std::int16_t number);

  // cycles of numbered parts

  [[nodiscard]] const ir::Value* part(int n) const;
  /// All of them are counted from where the tool stands at the call.
  bool old();

  [[nodiscard]] const OldPartValue::Letter* letter(int n, std::string_view address) const;
  /// 4 and 5: `PECKG -5 F80`, the sides or `RADIUS 30`, `F200 DR+ RADIUS 5`. The tool stands in the middle.
  bool old_pocket(bool round);

  const CycleDefinition& cycle_;
  const CycleContext& context_;
  Report& report_;
  ir::HoleCycle hole_;
  bool skipped_ = false, as_moves_ = false;
};

ir::Level level_of(ir::Value v, ir::LevelBase base);
ir::Value half(const ir::Value& v);
ir::Value magnitude(const ir::Value& v);

}  // namespace cnctrans::frontends::heidenhain
