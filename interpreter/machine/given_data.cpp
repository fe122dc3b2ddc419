#include "interpreter/machine/given_data.h"

#include <algorithm>

#include "base/text.h"

namespace cnctrans::interpreter {

std::string datum_key(const ir::SystemRef& ref, std::span<const double> args) {
  std::string key = ref.text;
  if (args.empty()) return key;
  key += '[';
  for (std::size_t i = 0; i < args.size(); ++i) key += (i == 0 ? "" : ",") + shortest(args[i]);
  return key + "]";
}

void GivenData::preset(const std::string& name, double value) {
  written_[name] = value;
  unread_.insert(name);
}

const double* GivenData::find(const ir::SystemRef& ref, std::span<const double> args) const {
  if (written_.empty() && profile_.data.empty()) return nullptr;
  const std::string keys[] = {datum_key(ref, args), args.empty() ? ref.text : ref.text + shortest(args[0])};
  for (const auto& k : keys) {
    if (const auto it = written_.find(k); it != written_.end()) return &it->second;
  }
  for (const auto& k : keys) {
    if (const auto it = profile_.data.find(k); it != profile_.data.end()) return &it->second;
  }
  if (args.empty()) return nullptr;
  const auto any = profile_.data.find(ref.text + "[*]");  // the same for every index
  return any == profile_.data.end() ? nullptr : &any->second;
}

const double* GivenData::by_name(const std::string& name) {
  unread_.erase(name);
  if (const auto it = written_.find(name); it != written_.end()) return &it->second;
  const auto it = profile_.data.find(name);
  return it == profile_.data.end() ? nullptr : &it->second;
}

void GivenData::read_now(const ir::SystemRef& ref, std::span<const double> args) {
  if (unread_.empty()) return;
  unread_.erase(datum_key(ref, args));
  if (!args.empty()) unread_.erase(ref.text + shortest(args[0]));
}

void GivenData::write(const std::string& name, double value, bool length) {
  written_[name] = value;
  if (length) in_mm_.insert(name);
}

const double* GivenData::tool(ir::Datum datum, ir::AxisId axis, std::span<const double> args) const {
  const auto it = tools_.find({datum, axis, {args.begin(), args.end()}});
  return it == tools_.end() ? nullptr : &it->second;
}

void GivenData::write_tool(ir::Datum datum, ir::AxisId axis, std::span<const double> args, double value) {
  tools_[{datum, axis, {args.begin(), args.end()}}] = value;
}

void GivenData::assume(const Span& where, const std::string& name, double value, const std::string& hint) {
  const auto same = [&](const Assumed& a) { return a.name == name; };
  if (std::any_of(assumed_.begin(), assumed_.end(), same)) return;
  assumed_.push_back({where, name, value,
                      hint.empty() ? "give another by --set " + name + "=VALUE or in the profile's \"data\"" : hint});
}

}  // namespace cnctrans::interpreter
