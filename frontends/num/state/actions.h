// Templates of Lowering that words.cpp, resolve.cpp and cycles.cpp share.
#pragma once

#include <utility>

#include "frontends/num/state/lower.h"

namespace cnctrans::frontends::num {

template <class Data>
ir::Action& Lowering::act(const Word& w, Step step, Data data, ir::Order order) {
  if (!steps_.empty() && step < steps_.back()) marks_.unsorted = true;
  steps_.push_back(step);
  ir::Action& a = out_->actions.emplace_back();
  a.data = std::move(data);
  a.order = order;
  a.pos = w.pos;
  a.text = text_of(w);
  return a;
}

template <class E>
void Lowering::setting(const Word& w, ir::Setting s, E v) {
  ir::ModalSet set;
  set.setting = s;
  set.value = static_cast<std::uint8_t>(v);
  act(w, Step::setting, set);
}

}  // namespace cnctrans::frontends::num
