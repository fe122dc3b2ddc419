// The schema that editors check a profile against says the same as the reader.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>

#include "dialects/options.h"
#include "machine/data_at_rest.h"
#include "machine/profile.h"
#include "machine/profile_names.h"

namespace cnctrans::machine {
namespace {

using nlohmann::json;

json file(const std::string& path) {
  std::ifstream in(std::string(CNCTRANS_SOURCE_DIR) + "/machine/" + path);
  return json::parse(in);
}

bool is_type(const json& value, const std::string& type) {
  if (type == "object") return value.is_object();
  if (type == "array") return value.is_array();
  if (type == "string") return value.is_string();
  if (type == "boolean") return value.is_boolean();
  if (type == "integer") return value.is_number_integer();
  return type == "number" && value.is_number();
}

/// The keywords of JSON Schema that profile.schema.json uses. The first fault with its place; empty: none.
std::string fault(const json& schema, const json& value, const std::string& at);

std::string fault_of_members(const json& schema, const json& value, const std::string& at) {
  const json required = schema.value("required", json::array());
  for (const auto& key : required)
    if (!value.contains(key)) return at + " lacks " + key.get<std::string>();
  for (const auto& [key, member] : value.items()) {
    const std::string place = at + "." + key;
    const json* found = nullptr;
    if (schema.contains("properties") && schema["properties"].contains(key)) found = &schema["properties"][key];
    if (schema.contains("patternProperties"))
      for (const auto& [pattern, one] : schema["patternProperties"].items())
        if (std::regex_search(key, std::regex(pattern))) found = &one;
    if (found == nullptr && schema.contains("additionalProperties")) found = &schema["additionalProperties"];
    if (found == nullptr) continue;
    if (*found == json(false)) return place + " is not described";
    if (auto text = fault(*found, member, place); !text.empty()) return text;
  }
  return {};
}

std::string fault_of_items(const json& schema, const json& value, const std::string& at) {
  if (value.size() < schema.value("minItems", std::size_t{0})) return at + " is too short";
  for (std::size_t i = 0; i < value.size(); ++i) {
    if (!schema.contains("items")) break;
    if (auto text = fault(schema["items"], value[i], at + "[" + std::to_string(i) + "]"); !text.empty()) return text;
    if (schema.value("uniqueItems", false) && std::count(value.begin(), value.end(), value[i]) > 1)
      return at + " doubles";
  }
  return {};
}

std::string fault(const json& schema, const json& value, const std::string& at) {
  const auto fits = [&](const json& one) { return fault(one, value, at).empty(); };
  if (schema.contains("type")) {
    const json types = schema["type"].is_array() ? schema["type"] : json::array({schema["type"]});
    if (std::none_of(types.begin(), types.end(), [&](const json& t) { return is_type(value, t); }))
      return at + ": type";
  }
  if (schema.contains("const") && schema["const"] != value) return at + ": const";
  if (schema.contains("enum") && std::count(schema["enum"].begin(), schema["enum"].end(), value) == 0)
    return at + " cannot be " + value.dump();
  if (schema.contains("oneOf") && std::count_if(schema["oneOf"].begin(), schema["oneOf"].end(), fits) != 1)
    return at + ": oneOf";
  if (schema.contains("anyOf") && std::none_of(schema["anyOf"].begin(), schema["anyOf"].end(), fits))
    return at + ": anyOf";
  if (value.is_string()) {
    const auto text = value.get<std::string>();
    if (text.size() < schema.value("minLength", std::size_t{0})) return at + " is too short";
    if (schema.contains("pattern") && !std::regex_search(text, std::regex(schema["pattern"].get<std::string>())))
      return at + " cannot be " + text;
  }
  if (value.is_number()) {
    const auto n = value.get<double>();
    if (n < schema.value("minimum", n) || n > schema.value("maximum", n) ||
        n <= schema.value("exclusiveMinimum", n - 1))
      return at + " is out of range";
  }
  if (value.is_object()) return fault_of_members(schema, value, at);
  return value.is_array() ? fault_of_items(schema, value, at) : std::string();
}

std::string fault(const json& profile) {
  static const json schema = file("profile.schema.json");
  return fault(schema, profile, "profile");
}

std::set<std::string> words(const json& list) {
  std::set<std::string> found;
  for (const auto& w : list)
    if (w.is_string()) found.insert(w.get<std::string>());
  return found;
}

TEST(ProfileSchema, TakesEveryBuiltinProfile) {
  for (const auto& name : builtin_names()) {
    EXPECT_EQ(fault(file("profiles/" + name + ".json")), "") << name;
    std::string error;
    const auto p = dialects::load_profile(name, &error);
    ASSERT_TRUE(p) << error;
    EXPECT_EQ(fault(json::parse(to_json(*p))), "") << name << " as it is written";
  }
}

TEST(ProfileSchema, DescribesEveryOption) {
  const json options = file("profile.schema.json")["properties"]["options"]["properties"];
  EXPECT_EQ(options.size(), dialects::options().rows().size());
  for (const auto& spec : dialects::options().rows()) {
    const std::string name(spec.name);
    ASSERT_TRUE(options.contains(name)) << name << " is missing: " << spec.meaning;
    const json& one = options[name];
    EXPECT_EQ(one["default"], spec.fallback) << name;
    std::string meaning = one["description"];
    meaning[0] = spec.meaning[0];
    EXPECT_EQ(meaning, std::string(spec.meaning) + ".") << name;
    EXPECT_EQ(fault(one, json(spec.fallback), name), "");
    if (spec.values == "text" || spec.values == "number") {
      EXPECT_EQ(one.contains("enum"), false) << name;
      EXPECT_EQ(fault(one, json("1.5"), name), "");
      EXPECT_EQ(fault(one, json("other"), name).empty(), spec.values == "text") << name;
      continue;
    }
    std::set<std::string> allowed;
    std::istringstream in{std::string(spec.values)};
    for (std::string word; std::getline(in, word, '|');) allowed.insert(word);
    if (spec.fallback.empty()) allowed.insert("");
    EXPECT_EQ(words(one["enum"]), allowed) << name;
  }
}

TEST(ProfileSchema, KnowsTheWordsOfTheReader) {
  const json properties = file("profile.schema.json")["properties"];
  const json power_on = properties["power_on"]["properties"];
  for (std::size_t i = 0; i < ir::setting_count; ++i) {
    const auto setting = static_cast<ir::Setting>(i);
    std::set<std::string> values;
    for (std::uint8_t v = 0; v < 32; ++v) {
      const std::string value(ir::setting_value_name(setting, v));
      if (ir::setting_value(setting, value) == v) values.insert(value);
    }
    EXPECT_EQ(words(power_on.at(std::string(ir::name(setting)))["enum"]), values) << ir::name(setting);
  }
  const auto texts = [](const auto& table) {
    std::set<std::string> found;
    for (const auto& w : table) found.emplace(w.text);
    return found;
  };
  const json m_codes = properties["m_codes"]["items"]["properties"];
  EXPECT_EQ(words(m_codes["meaning"]["enum"]), texts(meaning_words));
  EXPECT_EQ(words(m_codes["order"]["enum"]), texts(order_words));
  EXPECT_EQ(words(properties["kind"]["enum"]), texts(kind_words));
  EXPECT_EQ(words(properties["frame_order"]["items"]["enum"]), texts(slot_words));
  const std::regex answers(properties["data_of_run"]["additionalProperties"]["pattern"].get<std::string>());
  for (std::size_t i = 0; i < run_datum_count; ++i) {
    const double code = static_cast<double>(i);
    EXPECT_TRUE(std::regex_search(run_answer_text(code), answers)) << run_answer_text(code);
  }
}

/// What one of them takes the other takes as well.
TEST(ProfileSchema, AgreesWithTheReader) {
  const std::pair<const char*, bool> profiles[] = {
      {R"({"extends": "fagor-mill"})", true},
      {R"({"name": "a"})", false},
      {R"({"name": "a", "dialect": "num", "axes": [{"name": "X"}]})", true},
      {R"({"extends": "num-mill", "options": {"num.family": "7xx"}})", true},
      {R"({"extends": "num-mill", "options": {"num.family": "8xx"}})", false},
      {R"({"extends": "num-mill", "options": {"num.familie": "7xx"}})", false},
      {R"({"extends": "num-mill", "options": {"num.structured": false, "num.linear_unit_um": 10}})", true},
      {R"({"extends": "num-mill", "options": {"num.linear_unit_um": "ten"}})", false},
      {R"({"extends": "sinumerik-mill", "options": {"sinumerik.contour_ok": 1, "num.g63": ""}})", true},
      {R"({"extends": "sinumerik-mill", "data_of_run": {"A": "last_label"}})", true},
      {R"({"extends": "sinumerik-mill", "data_of_run": {"A": "last"}})", false},
      {R"({"extends": "sinumerik-mill", "power_on": {"surface": "tool"}})", true},
      {R"({"extends": "sinumerik-mill", "power_on": {"surface": "cone"}})", false},
      {R"({"extends": "sinumerik-mill", "speed": 1})", false},
  };
  for (const auto& [text, good] : profiles) {
    std::string error;
    EXPECT_EQ(dialects::profile_of(text, &error).has_value(), good) << text << ": " << error;
    EXPECT_EQ(fault(json::parse(text)).empty(), good) << text << ": " << fault(json::parse(text));
  }
}

}  // namespace
}  // namespace cnctrans::machine
