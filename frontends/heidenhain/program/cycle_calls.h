// CYCL DEF and its calls: which definition is in force, with which values, and what it becomes where it is called.
#pragma once

#include <functional>
#include <set>
#include <vector>

#include "frontends/heidenhain/cycles/build.h"
#include "frontends/heidenhain/state/lowering.h"
#include "frontends/heidenhain/ways/flow.h"

namespace cnctrans::frontends::heidenhain {

class CycleCalls {
 public:
  CycleCalls(Lowering& lowering, const Flow& flow) : lowering_(lowering), flow_(flow), flat_(lowering.flat()) {}

  /// Before the others.
  void prepare();
  using Statements = std::vector<ir::Statement>;
  void definition(const Item& item, Statements& out) const;
  /// M99, M89, CYCL CALL.
  void call(std::size_t i, Statements& out);
  /// CYCL CALL PAT.
  void at_points(std::size_t i, Statements& out);
  /// 220 and 221.
  void pattern(std::size_t i, Statements& out);

 private:
  /// What runs at one place.
  struct Machining {
    ir::CyclePtr cycle;
    std::optional<ir::Value> speed_after;
    std::vector<ir::CyclePtr> more;  ///< further pockets of cycle 14
    bool goes_back = false;          ///< to where the tool stood in the plane
    std::vector<CycleMove> moves;
    std::string program;  ///< cycle 12
    [[nodiscard]] bool any() const { return cycle != nullptr || !moves.empty() || !program.empty(); }
  };
  [[nodiscard]] const Arrival& arrival(std::size_t i) const { return flow_.arrivals()[i]; }
  [[nodiscard]] bool differs(std::int16_t q) const;
  void link_globals();
  void find_stored();
  [[nodiscard]] ir::Value parameter(const CycleDefinition& cycle, std::int16_t q, const Arrival& a) const;
  const CycleDefinition* in_force(const Item& item, const Arrival& a);
  [[nodiscard]] bool differs_from_patterns(const CycleDefinition& cycle) const;
  Machining machining(const Item& item, const Arrival& a, const std::optional<ir::Value>& shift,
                      const CycleDefinition* overlay);
  static void raise(Machining& m, const std::optional<ir::Value>& height);
  static void take_place(Statements& out, std::size_t at);
  [[nodiscard]] ir::Block step_block(const CycleMove& step, const ir::PlaneAxes& plane) const;
  void put(const Machining& m, const ir::PlaneAxes& plane, Statements& out) const;
  void above_first(const Item& item, const Machining& m, const ir::PlaneAxes& plane, Statements& out);

  Lowering& lowering_;
  const Flow& flow_;
  Flat& flat_;
  bool several_ = false, outside_told_ = false;
  std::set<std::int16_t> stored_;
};

}  // namespace cnctrans::frontends::heidenhain
