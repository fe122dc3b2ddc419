// IR by hand, as short as it can be said. Nothing about a language.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "ir/program.h"

namespace cnctrans::test {

inline ir::ExprPtr num(double v) {
  return ir::number(v);
}
inline ir::ExprPtr op(ir::BinaryOp o, ir::ExprPtr a, ir::ExprPtr b) {
  return ir::binary(o, std::move(a), std::move(b));
}
inline ir::ExprPtr minus(ir::ExprPtr a) {
  return ir::unary(ir::UnaryOp::negate, std::move(a));
}
inline ir::VarRef var(const ir::ExprPtr& e) {
  return std::get<ir::VarRef>(e->node);
}

inline ir::CoordWord coord(ir::AxisId axis, ir::Value v) {
  ir::CoordWord w;
  w.axis = axis;
  w.value = std::move(v);
  return w;
}
inline ir::CenterWord center(ir::AxisId axis, ir::Value v, ir::CenterMode mode = ir::CenterMode::from_start) {
  ir::CenterWord w;
  w.axis = axis;
  w.value = std::move(v);
  w.mode = mode;
  if (mode == ir::CenterMode::absolute) w.scale = ir::WordScale::modal;
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
ir::Action set(ir::Setting s, Enum value, ir::Order order = ir::Order::before) {
  return action(ir::ModalSet{s, static_cast<std::uint8_t>(value), true, ir::FeedMemory::per_mode}, order);
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
inline ir::LabelRef block_number(std::string digits) {
  ir::LabelRef l;
  l.is_number = true;
  l.text = std::move(digits);
  return l;
}
inline ir::Jump jump(std::string digits, ir::ExprPtr condition = nullptr) {
  ir::Jump j;
  j.target = block_number(std::move(digits));
  j.condition = std::move(condition);
  return j;
}
inline ir::Level level(ir::Value v, ir::LevelBase base = ir::LevelBase::absolute) {
  ir::Level l;
  l.value = std::move(v);
  l.base = base;
  l.given = true;
  return l;
}
inline ir::Level level(double v, ir::LevelBase base = ir::LevelBase::absolute) {
  return level(ir::Value(v), base);
}
inline ir::FrameWord frame_word(ir::AxisId axis, double v, ir::WordScale scale = ir::WordScale::modal) {
  return ir::FrameWord{axis, ir::Value(v), scale, {}};
}
inline ir::Action frame(ir::FrameSlot slot, ir::FrameKind kind, ir::FrameCombine combine,
                        std::vector<ir::FrameWord> words) {
  ir::FrameChange f;
  f.slot = slot;
  f.kind = kind;
  f.combine = combine;
  f.words = std::move(words);
  return action(ir::FrameOp{std::make_shared<const ir::FrameChange>(std::move(f))});
}

}  // namespace cnctrans::test
