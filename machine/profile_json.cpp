// The JSON form of a profile: read with every unknown key refused, so that a misspelt one cannot be ignored.
#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "base/source.h"
#include "machine/data_at_rest.h"
#include "machine/embedded.h"
#include "machine/options.h"
#include "machine/profile.h"
#include "machine/profile_names.h"

namespace cnctrans::machine {
namespace {

using nlohmann::json;

/// Carries the first fault out of the reading functions; never leaves this file.
struct Fault {
  std::string text;
};
[[noreturn]] void fail(std::string text) {
  throw Fault{std::move(text)};
}

/// One JSON object: every key must be asked for.
class Reader {
 public:
  Reader(const json& object, std::string where) : object_(object), where_(std::move(where)) {
    if (!object.is_object()) fail(where_ + " must be an object");
  }
  ~Reader() = default;
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  const json* find(const char* key) {
    asked_.insert(key);
    const auto it = object_.find(key);
    return it == object_.end() ? nullptr : &*it;
  }
  const json& need(const char* key) {
    const auto* j = find(key);
    if (j == nullptr) fail(where_ + " lacks \"" + key + "\"");
    return *j;
  }
  template <class T>
  void number(const char* key, T& out) {
    const auto* j = find(key);
    if (j == nullptr) return;
    if (!j->is_number()) fail(where_ + "." + key + " must be a number");
    out = j->get<T>();
  }
  void boolean(const char* key, bool& out) {
    const auto* j = find(key);
    if (j == nullptr) return;
    if (!j->is_boolean()) fail(where_ + "." + key + " must be true or false");
    out = j->get<bool>();
  }
  void text(const char* key, std::string& out) {
    const auto* j = find(key);
    if (j == nullptr) return;
    if (!j->is_string()) fail(where_ + "." + key + " must be a text");
    out = j->get<std::string>();
  }
  template <class Enum, class Words>
  void word(const char* key, const Words& words, Enum& out) {
    std::string s;
    text(key, s);
    if (s.empty() && object_.find(key) == object_.end()) return;
    const auto it = std::find_if(words.begin(), words.end(), [&](const auto& w) { return w.text == s; });
    if (it == words.end()) fail(where_ + "." + key + " cannot be \"" + s + "\"");
    out = it->value;
  }
  void done() const {
    for (const auto& item : object_.items()) {
      if (!asked_.contains(item.key())) fail(where_ + " has an unknown key \"" + item.key() + "\"");
    }
  }
  [[nodiscard]] const std::string& where() const { return where_; }

 private:
  const json& object_;
  std::string where_;
  std::set<std::string> asked_;
};

const json& array_of(const json& j, const std::string& where) {
  if (!j.is_array()) fail(where + " must be a list");
  return j;
}

void read_axes(const json& list, Profile& p) {
  p.axes.clear();
  for (const auto& item : array_of(list, "axes")) {
    Reader r(item, "axes[" + std::to_string(p.axes.size()) + "]");
    AxisSpec a;
    r.text("name", a.name);
    if (a.name.empty()) fail(r.where() + " lacks \"name\"");
    a.id = a.name.size() == 1 ? ir::fixed_axis(a.name[0]) : ir::axis::none;
    int id = a.id;
    r.number("id", id);
    if (id < 0 || id >= ir::axis::count_max)
      fail(r.where() + ": an axis that is not one of XYZUVWABC needs an \"id\" of 9 to 31");
    a.id = static_cast<ir::AxisId>(id);
    if (p.axis(a.id) != nullptr) fail(r.where() + ": the axis is there twice");
    a.rotary = ir::is_rotary_letter(a.id);
    r.boolean("rotary", a.rotary);
    r.boolean("diameter", a.diameter);
    r.number("start", a.start);
    r.number("reference_point", a.reference_point);
    if (const json* points = r.find("fixed_points"); points != nullptr) {
      for (const auto& x : array_of(*points, r.where() + ".fixed_points")) {
        if (!x.is_number()) fail(r.where() + ".fixed_points must be numbers");
        a.fixed_points.push_back(x.get<double>());
      }
    }
    r.done();
    p.axes.push_back(std::move(a));
  }
  if (p.axes.empty()) fail("axes must not be empty");
  std::sort(p.axes.begin(), p.axes.end(), [](const AxisSpec& a, const AxisSpec& b) { return a.id < b.id; });
}

void read_power_on(const json& object, ir::ModalState& state) {
  Reader r(object, "power_on");
  for (std::size_t i = 0; i < ir::setting_count; ++i) {
    const auto setting = static_cast<ir::Setting>(i);
    const std::string key(ir::name(setting));
    std::string word;
    r.text(key.c_str(), word);
    if (word.empty()) continue;
    const auto value = ir::setting_value(setting, word);
    if (!value) fail("power_on." + key + " cannot be \"" + word + "\"");
    state.set(setting, *value);
  }
  r.boolean("units_feed_too", state.units_feed_too);
  std::string motion;
  r.text("motion", motion);
  if (!motion.empty()) {
    const auto kind = ir::motion_kind_by_name(motion);
    if (!kind) fail("power_on.motion cannot be \"" + motion + "\"");
    state.motion = *kind;
  }
  r.number("work_offset", state.work_offset);
  r.done();
}

void read_frame_order(const json& list, Profile& p) {
  p.frame_order.clear();
  for (const auto& item : array_of(list, "frame_order")) {
    const auto text = item.is_string() ? item.get<std::string>() : std::string{};
    const auto it = std::find_if(slot_words.begin(), slot_words.end(), [&](const auto& w) { return w.text == text; });
    if (it == slot_words.end()) fail("frame_order has an unknown slot \"" + text + "\"");
    if (std::find(p.frame_order.begin(), p.frame_order.end(), it->value) != p.frame_order.end()) {
      fail("frame_order names \"" + text + "\" twice");
    }
    p.frame_order.push_back(it->value);
  }
}

void read_m_codes(const json& list, Profile& p) {
  for (const auto& item : array_of(list, "m_codes")) {
    Reader r(item, "m_codes");
    MCode m;
    r.need("code");
    r.number("code", m.code);
    r.word("meaning", meaning_words, m.meaning);
    r.word("order", order_words, m.order);
    r.number("argument", m.argument);
    r.text("text", m.text);
    r.done();
    std::erase_if(p.m_codes, [&](const MCode& old) { return old.code == m.code; });
    p.m_codes.push_back(std::move(m));
  }
  std::sort(p.m_codes.begin(), p.m_codes.end(), [](const MCode& a, const MCode& b) { return a.code < b.code; });
}

void read_tools(const json& list, Profile& p) {
  for (const auto& item : array_of(list, "tools")) {
    Reader r(item, "tools");
    Tool t;
    r.number("number", t.number);
    r.text("name", t.name);
    r.number("radius", t.radius);
    r.number("length", t.length);
    r.number("length_x", t.length_x);
    r.number("nose", t.nose);
    r.number("nose_width", t.nose_width);
    r.number("offset", t.offset);
    r.done();
    p.tools.push_back(std::move(t));
  }
}

ir::AxisId axis_by_name(const Profile& p, const std::string& name) {
  for (const auto& a : p.axes) {
    if (a.name == name) return a.id;
  }
  fail("there is no axis \"" + name + "\"");
}

void read_work_offsets(const json& object, Profile& p) {
  if (!object.is_object()) fail("work_offsets must be an object");
  for (const auto& row : object.items()) {
    char* end = nullptr;
    const long n = std::strtol(row.key().c_str(), &end, 10);
    if (*end != '\0' || n < 1) fail("work_offsets: \"" + row.key() + "\" is not a row number from 1 on");
    if (!row.value().is_object()) fail("work_offsets." + row.key() + " must be an object");
    auto& values = p.work_offsets[static_cast<std::int32_t>(n)];
    for (const auto& item : row.value().items()) {
      if (!item.value().is_number()) fail("work_offsets." + row.key() + "." + item.key() + " must be a number");
      values[axis_by_name(p, item.key())] = item.value().get<double>();
    }
  }
}

void read_data(const json& object, Profile& p) {
  if (!object.is_object()) fail("data must be an object");
  for (const auto& item : object.items()) {
    if (!item.value().is_number()) fail("data." + item.key() + " must be a number");
    p.data[item.key()] = item.value().get<double>();
  }
}

/// Values, or false: none of what the base has.
void read_data_at_rest(const json& object, Profile& p) {
  if (object.is_boolean() && !object.get<bool>()) return forget_data_at_rest(p);
  if (!object.is_object()) fail("data_at_rest must be an object, or false");
  for (const auto& item : object.items()) {
    if (!item.value().is_number()) fail("data_at_rest." + item.key() + " must be a number");
    p.data[std::string(at_rest_mark) + item.key()] = item.value().get<double>();
  }
}

void read_data_of_run(const json& object, Profile& p) {
  if (!object.is_object()) fail("data_of_run must be an object");
  for (const auto& item : object.items()) {
    const auto code = item.value().is_string() ? run_answer_code(item.value().get<std::string>()) : std::nullopt;
    if (!code) fail("data_of_run." + item.key() + " names nothing that a run answers");
    p.data[std::string(of_run_mark) + item.key()] = *code;
  }
}

void data_json(const Profile& p, nlohmann::ordered_json& j) {
  for (const auto& [name, value] : p.data) {
    if (name.starts_with(at_rest_mark)) {
      j["data_at_rest"][name.substr(at_rest_mark.size())] = value;
    } else if (name.starts_with(of_run_mark)) {
      j["data_of_run"][name.substr(of_run_mark.size())] = run_answer_text(value);
    } else {
      j["data"][name] = value;
    }
  }
}

void read_options(const json& object, const OptionTable& options, Profile& p) {
  if (!object.is_object()) fail("options must be an object");
  for (const auto& item : object.items()) {
    std::string value;
    if (item.value().is_string()) {
      value = item.value().get<std::string>();
    } else if (item.value().is_boolean()) {
      value = item.value().get<bool>() ? "yes" : "no";
    } else {
      value = item.value().dump();
    }
    std::string error;
    if (!options.set(p, item.key(), value, &error)) fail(error);
  }
}

Profile read_profile(const json& root, const OptionTable& options, bool is_builtin);

std::optional<Profile> builtin(const std::string& name, const OptionTable& options) {
  for (std::size_t i = 0; i < builtin_profiles_count; ++i) {
    if (builtin_profiles[i].name == name) return read_profile(json::parse(builtin_profiles[i].text), options, true);
  }
  return std::nullopt;
}

Profile base_profile(const json& name, const OptionTable& options) {
  if (!name.is_string()) fail("extends must be a text");
  const auto text = name.get<std::string>();
  auto p = builtin(text, options);
  if (!p) fail("extends names no built-in profile: \"" + text + "\"");
  return *p;
}

/// A machine that is described from the ground up still has the habits of its control: state of power-on, order of the
/// frame, M functions, options. What the built-in machine consists of (axes, assumed data) is not inherited.
Profile habits_of(const std::string& dialect, Kind kind, const OptionTable& options) {
  if (dialect.empty()) fail("profile lacks \"dialect\" (or \"extends\")");
  auto p = builtin(dialect + "-" + std::string(word_of(kind_words, kind)), options);
  if (!p) fail("dialect names no language: \"" + dialect + "\"");
  forget_data_at_rest(*p);
  p->axes.clear();
  p->name.clear();
  return *p;
}

Profile read_profile(const json& root, const OptionTable& options, bool is_builtin) {
  Reader r(root, "profile");
  Profile p;
  r.find("$schema");
  if (const auto* base = r.find("extends")) p = base_profile(*base, options);
  const Profile base = p;
  r.text("dialect", p.dialect);
  r.word("kind", kind_words, p.kind);
  if (r.find("extends") != nullptr) {
    if (p.dialect != base.dialect) fail("dialect is not that of the profile it extends: \"" + p.dialect + "\"");
    if (p.kind != base.kind) fail("kind is not that of the profile it extends");
  } else if (!is_builtin) {
    p = habits_of(p.dialect, p.kind, options);
  } else {
    options.begin(p);
  }
  r.text("name", p.name);
  if (const auto* j = r.find("axes")) read_axes(*j, p);
  if (const auto* j = r.find("power_on")) read_power_on(*j, p.power_on);
  if (const auto* j = r.find("frame_order")) read_frame_order(*j, p);
  r.number("power_on_feed", p.power_on_feed);
  if (const auto* j = r.find("m_codes")) read_m_codes(*j, p);
  if (const auto* j = r.find("tools")) read_tools(*j, p);
  if (const auto* j = r.find("work_offsets")) read_work_offsets(*j, p);
  if (const auto* j = r.find("data")) read_data(*j, p);
  if (const auto* j = r.find("data_at_rest")) read_data_at_rest(*j, p);
  if (const auto* j = r.find("data_of_run")) read_data_of_run(*j, p);
  if (const auto* j = r.find("options")) read_options(*j, options, p);
  r.number("max_rapid", p.max_rapid);
  r.number("arc_tolerance", p.arc_tolerance);
  r.number("call_depth", p.call_depth);
  r.done();
  if (p.axes.empty()) fail("profile lacks \"axes\"");
  if (p.name.empty()) fail("profile lacks \"name\"");
  if (p.frame_order.empty()) {
    p.frame_order = {ir::FrameSlot::preset, ir::FrameSlot::shift,  ir::FrameSlot::rotation,
                     ir::FrameSlot::scale,  ir::FrameSlot::mirror, ir::FrameSlot::chain};
  }
  return p;
}

json axis_json(const AxisSpec& a) {
  json j{{"name", a.name}};
  if (a.name.size() != 1 || ir::fixed_axis(a.name[0]) != a.id) j["id"] = a.id;
  if (a.rotary != ir::is_rotary_letter(a.id)) j["rotary"] = a.rotary;
  if (a.diameter) j["diameter"] = true;
  if (a.start != 0) j["start"] = a.start;
  if (a.reference_point != 0) j["reference_point"] = a.reference_point;
  if (!a.fixed_points.empty()) j["fixed_points"] = a.fixed_points;
  return j;
}

json power_on_json(const ir::ModalState& state) {
  json j = json::object();
  for (std::size_t i = 0; i < ir::setting_count; ++i) {
    const auto setting = static_cast<ir::Setting>(i);
    j[std::string(ir::name(setting))] = ir::setting_value_name(setting, state.get(setting));
  }
  j["units_feed_too"] = state.units_feed_too;
  j["motion"] = ir::name(state.motion);
  j["work_offset"] = state.work_offset;
  return j;
}

}  // namespace

std::optional<Profile> from_json(std::string_view text, const OptionTable& options, std::string* error) {
  try {
    return read_profile(json::parse(text), options, false);
  } catch (const Fault& f) {
    *error = f.text;
  } catch (const json::exception& e) {
    *error = std::string("not readable as JSON: ") + e.what();
  }
  return std::nullopt;
}

std::string to_json(const Profile& p) {
  nlohmann::ordered_json j;
  j["name"] = p.name;
  j["dialect"] = p.dialect;
  j["kind"] = word_of(kind_words, p.kind);
  for (const auto& a : p.axes) j["axes"].emplace_back(axis_json(a));
  j["power_on"] = power_on_json(p.power_on);
  for (const auto s : p.frame_order) j["frame_order"].emplace_back(word_of(slot_words, s));
  j["power_on_feed"] = p.power_on_feed;
  for (const auto& m : p.m_codes) {
    j["m_codes"].push_back({{"code", m.code},
                            {"meaning", word_of(meaning_words, m.meaning)},
                            {"order", word_of(order_words, m.order)},
                            {"argument", m.argument},
                            {"text", m.text}});
  }
  for (const auto& t : p.tools) {
    j["tools"].push_back({{"number", t.number},
                          {"name", t.name},
                          {"radius", t.radius},
                          {"length", t.length},
                          {"length_x", t.length_x},
                          {"nose", t.nose},
                          {"nose_width", t.nose_width},
                          {"offset", t.offset}});
  }
  data_json(p, j);
  for (const auto& [row, values] : p.work_offsets) {
    auto& out = j["work_offsets"][std::to_string(row)] = json::object();
    for (const auto& [axis, value] : values) {
      if (const auto* spec = p.axis(axis)) out[spec->name] = value;
    }
  }
  j["options"] = json::object();
  for (const auto& [name, value] : p.options) j["options"][name] = value;
  j["max_rapid"] = p.max_rapid;
  j["arc_tolerance"] = p.arc_tolerance;
  j["call_depth"] = p.call_depth;
  return j.dump(2) + "\n";
}

std::vector<std::string> builtin_names() {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < builtin_profiles_count; ++i) names.emplace_back(builtin_profiles[i].name);
  return names;
}

std::optional<Profile> load(const std::string& name_or_path, const OptionTable& options, std::string* error) {
  try {
    if (auto p = builtin(name_or_path, options)) return p;
  } catch (const Fault& f) {
    *error = f.text;
    return std::nullopt;
  }
  const auto source = SourceText::open(name_or_path, error);
  if (!source) {
    *error = "there is no built-in machine and no readable file \"" + name_or_path + "\": " + *error;
    return std::nullopt;
  }
  auto p = from_json(source->text(), options, error);
  if (!p) *error = name_or_path + ": " + *error;
  return p;
}

}  // namespace cnctrans::machine
