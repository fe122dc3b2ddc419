#include "machine/profile.h"

#include <algorithm>

namespace cnctrans::machine {

const AxisSpec* Profile::axis(ir::AxisId id) const {
  const auto it = std::find_if(axes.begin(), axes.end(), [id](const AxisSpec& a) { return a.id == id; });
  return it == axes.end() ? nullptr : &*it;
}

const MCode* Profile::m_code(std::int32_t code) const {
  const auto it = std::find_if(m_codes.begin(), m_codes.end(), [code](const MCode& m) { return m.code == code; });
  return it == m_codes.end() ? nullptr : &*it;
}

}  // namespace cnctrans::machine
