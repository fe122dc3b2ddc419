// Words that leave the programmed path alone and change how fast it is gone along.
#pragma once

#include <string>
#include <string_view>

namespace cnctrans::sinumerik {

/// What the word does to a speed, to stand behind "but"; empty: nothing but times. `name` in capitals.
constexpr std::string_view change_of_speed(std::string_view name) {
  if (name == "OVR") return "the control moves at so many per cent of each F from here on";
  if (name == "OVRRAP") return "the control makes rapid moves at so many per cent of their speed from here on";
  if (name == "OVRA") return "the axis or the spindle goes at so many per cent of its speed from here on";
  if (name == "FGROUP") return "F is the speed of the axes it names, and the others follow";
  if (name == "FGREF") return "F of the rotary axis counts at this radius";
  return {};
}

/// What is said of a word that is kept as text. `mark`: stands behind its name.
inline std::string kept_text(const std::string& name, std::string_view mark = {}) {
  std::string text = name + std::string(mark) + " is kept as text: it does not change the programmed path";
  if (const auto change = change_of_speed(name); !change.empty()) text += ", but " + std::string(change);
  return text;
}

}  // namespace cnctrans::sinumerik
