// The parts of build_cycle(): one definition and what it becomes.
#pragma once

#include <string>
#include <string_view>
#include <utility>

#include "dialects/heidenhain/cycle_words.h"
#include "frontends/heidenhain/cycles/move_list.h"

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

  [[nodiscard]] ir::Value point() const;
  [[nodiscard]] ir::Value depth() const;
  bool levels();
  /// The cycle is told by peck_moves().
  bool as_moves();
  /// ... or by these steps.
  bool told(MoveList& steps);
  /// A cycle, with the radius of its tool where it mills and TOOL DEF says it.
  [[nodiscard]] ir::CyclePtr as_cycle(ir::HoleCycle hole) const;
  /// Its parameters are numbers; a refusal where they are not.
  bool numbers();
  [[nodiscard]] double n(std::int16_t number) const { return q(number).number; }
  /// Of the tool, in the unit of the program: a number where the program says it.
  [[nodiscard]] ir::Value radius() const;
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
  bool back_bore();
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

  // contours.cpp

  bool on_contours();
  bool area();
  bool train();
  bool to_and_fro(ir::cycles::MillContour line, double top, double bottom);
  bool slot_along();
  bool on_cylinder();

  /// Q367: the tool stands at an end or in a corner of the shape; the way from there to its middle.
  bool place();
  bool place_on_ring();

  // told.cpp

  bool thread_with_countersink();
  void countersink(MoveList& steps, std::int16_t depth, const ir::Value& offset);
  bool ruled_surface();

  bool mill_word(std::int16_t number);

  // cycles of numbered parts

  [[nodiscard]] const ir::Value* part(int n) const;
  /// All of them are counted from where the tool stands at the call.
  bool old();

  [[nodiscard]] const OldPartValue::Letter* letter(int n, std::string_view address) const;
  /// 4 and 5: `PECKG -5 F80`, the sides or `RADIUS 30`, `F200 DR+ RADIUS 5`. The tool stands in the middle.
  bool old_pocket(bool round);
  bool old_slot();
  bool thread();

  const CycleDefinition& cycle_;
  const CycleContext& context_;
  Report& report_;
  ir::HoleCycle hole_;
  bool skipped_ = false;
  std::optional<std::pair<ir::Value, ir::Value>> aside_;  ///< from the tool to the middle of the shape
};

ir::Level level_of(ir::Value v, ir::LevelBase base);
ir::Value half(const ir::Value& v);
ir::Value magnitude(const ir::Value& v);
ir::Value larger(const ir::Value& a, const ir::Value& b);

}  // namespace cnctrans::frontends::heidenhain
