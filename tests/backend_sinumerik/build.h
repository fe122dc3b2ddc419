// IR by hand, as short as it can be said, and what the writer makes of it.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "backends/sinumerik/backend.h"
#include "dialects/options.h"
#include "dialects/sinumerik/variables.h"
#include "machine/profile.h"

namespace cnctrans::test {

/// A program in the target's variable spaces, read from "elsewhere" unless said otherwise.
struct Build {
  ir::Program program;
  backends::WriteOptions options;
  machine::Profile profile;
  Diagnostics diagnostics;

  explicit Build(const std::string& machine = "sinumerik-mill") {
    std::string error;
    auto loaded = dialects::load_profile(machine, &error);
    EXPECT_TRUE(loaded) << error;
    if (loaded) profile = *loaded;
    program.dialect = "elsewhere";
    program.lathe = profile.kind == machine::Kind::lathe;
    program.spaces = sinumerik::variable_spaces();
    program.routines.emplace_back();
    program.routines[0].name.text = "MAIN";
    options.main_stem = "MAIN";
  }
  ir::Body& body() { return program.routines.back().body; }
  template <class Node>
  ir::Statement& add(Node node) {
    ir::Statement s;
    s.node = std::move(node);
    body().push_back(std::move(s));
    return body().back();
  }
  ir::Routine& routine(std::string text, std::int64_t number = -1) {
    program.routines.emplace_back();
    program.routines.back().kind = ir::RoutineKind::sub;
    program.routines.back().name = {number, std::move(text)};
    return program.routines.back();
  }
  std::vector<backends::OutputFile> files() {
    options.profile = &profile;
    return backends::sinumerik::make_backend()->write(program, options, diagnostics);
  }
  std::string text() { return files().front().text; }
  /// Codes of all diagnostics, with blanks between.
  [[nodiscard]] std::string codes() const {
    std::string all;
    for (const Diagnostic& d : diagnostics.all()) all += (all.empty() ? "" : " ") + d.code;
    return all;
  }
};

inline ir::ExprPtr R(std::int64_t n) {
  return ir::numbered(0, n);
}
inline ir::ExprPtr num(double v) {
  return ir::number(v);
}
inline ir::ExprPtr op(ir::BinaryOp o, ir::ExprPtr a, ir::ExprPtr b) {
  return ir::binary(o, std::move(a), std::move(b));
}
inline ir::ExprPtr named(std::string name, ir::SpaceId space = 1, ir::Type type = ir::Type::real) {
  ir::VarRef v;
  v.space = space;
  v.name = std::move(name);
  return ir::variable(v, type);
}
inline ir::VarRef var(const ir::ExprPtr& e) {
  return std::get<ir::VarRef>(e->node);
}

inline ir::CoordWord coord(ir::AxisId axis, ir::Value v, std::uint32_t column = 0) {
  ir::CoordWord w;
  w.axis = axis;
  w.value = std::move(v);
  w.pos.column = column;
  return w;
}
inline ir::Block move(ir::MotionKind kind, std::vector<ir::CoordWord> coords) {
  ir::Block b;
  b.has_motion = true;
  b.motion.kind = kind;
  b.motion.explicit_code = kind != ir::MotionKind::modal;
  b.motion.coords = std::move(coords);
  return b;
}
template <class Data>
ir::Action action(Data data, ir::Order order = ir::Order::before) {
  ir::Action a;
  a.data = std::move(data);
  a.order = order;
  return a;
}
template <class Enum>
ir::Action set(ir::Setting s, Enum value) {
  return action(ir::ModalSet{s, static_cast<std::uint8_t>(value), true, ir::FeedMemory::shared});
}
inline ir::Block actions(std::vector<ir::Action> list) {
  ir::Block b;
  b.actions = std::move(list);
  return b;
}
inline ir::Assign assign(const ir::ExprPtr& target, ir::ExprPtr value) {
  ir::Assign a;
  ir::Assign::Item item;
  item.target = var(target);
  item.value = std::move(value);
  a.items.push_back(std::move(item));
  return a;
}
inline ir::Jump jump(std::string label, ir::Search search, ir::ExprPtr condition = nullptr) {
  ir::Jump j;
  j.target.is_number = label.find_first_not_of("0123456789") == std::string::npos;
  j.target.text = std::move(label);
  j.search = search;
  j.condition = std::move(condition);
  return j;
}
inline ir::MachineFunction m_function(std::int32_t code) {
  ir::MachineFunction m;
  m.code = code;
  return m;
}
inline ir::Level level(double v, ir::LevelBase base = ir::LevelBase::absolute) {
  ir::Level l;
  l.value = ir::Value(v);
  l.base = base;
  l.given = true;
  return l;
}

}  // namespace cnctrans::test
