#include "machine/profile.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dialects/fagor/options.h"
#include "dialects/num/options.h"
#include "dialects/options.h"
#include "dialects/sinumerik/options.h"
#include "machine/data_at_rest.h"

namespace cnctrans::machine {
namespace {

using ::testing::HasSubstr;
using ::testing::IsSupersetOf;

std::string fault(std::string_view text) {
  std::string error;
  EXPECT_FALSE(dialects::profile_of(text, &error));
  return error;
}

TEST(Profile, EveryDialectHasAMillAndALathe) {
  EXPECT_THAT(builtin_names(), IsSupersetOf({"fagor-mill", "fagor-lathe", "num-mill", "num-lathe", "sinumerik-mill",
                                             "sinumerik-lathe"}));
}

TEST(Profile, BuiltinsLoadAndKeepTheirContract) {
  for (const auto& name : builtin_names()) {
    std::string error;
    const auto p = dialects::load_profile(name, &error);
    ASSERT_TRUE(p) << name << ": " << error;
    EXPECT_EQ(p->name, name);
    EXPECT_EQ(name, p->dialect + (p->kind == Kind::mill ? "-mill" : "-lathe"));
    // The contract of the trace: mills have X Y Z A B C, lathes X Z C; the start is 0 everywhere.
    const bool mill = p->kind == Kind::mill;
    EXPECT_EQ(p->axes.size(), mill ? 6U : 3U);
    EXPECT_EQ(p->axis(ir::axis::y) != nullptr, mill);
    EXPECT_EQ(p->axis(ir::axis::x)->diameter, !mill);
    EXPECT_TRUE(p->axis(ir::axis::c)->rotary);
    EXPECT_EQ(p->power_on.plane, mill ? ir::Plane::xy : ir::Plane::zx);
    for (const auto& a : p->axes) EXPECT_EQ(a.start, 0);
  }
}

TEST(Profile, JsonFormReadsBack) {
  std::string error;
  for (const auto& name : builtin_names()) {
    const auto p = dialects::load_profile(name, &error);
    ASSERT_TRUE(p);
    const auto text = to_json(*p);
    const auto q = dialects::profile_of(text, &error);
    ASSERT_TRUE(q) << error;
    EXPECT_EQ(to_json(*q), text);
    EXPECT_EQ(q->power_on, p->power_on);
    EXPECT_EQ(q->frame_order, p->frame_order);
  }
}

TEST(Profile, ExtendsABuiltinAndReplacesWhatIsWritten) {
  std::string error;
  const auto p = dialects::profile_of(R"({"extends": "fagor-lathe", "name": "shop 7",
      "axes": [{"name": "X", "diameter": true, "start": 100}, {"name": "Z", "start": 250.5}, {"name": "Y"}],
      "m_codes": [{"code": 107, "meaning": "coolant_flood", "text": "pump 2"}],
      "tools": [{"number": 3, "radius": 0.8}],
      "work_offsets": {"1": {"X": -12.5, "Z": 300}}})",
                                      &error);
  ASSERT_TRUE(p) << error;
  EXPECT_EQ(p->dialect, "fagor");
  EXPECT_EQ(p->axes.size(), 3U);
  EXPECT_EQ(p->axis(ir::axis::z)->start, 250.5);
  EXPECT_EQ(p->m_code(107)->meaning, MMeaning::coolant_flood);
  EXPECT_EQ(p->m_code(3)->meaning, MMeaning::spindle_cw);
  EXPECT_EQ(p->work_offsets.at(1).at(ir::axis::x), -12.5);
  EXPECT_EQ(p->tools.at(0).radius, 0.8);
}

TEST(Profile, DataAtRestByPatternTheLongestFirst) {
  std::string error;
  const auto p = dialects::profile_of(R"({"extends": "linuxcnc-mill", "name": "shop",
      "data_at_rest": {"IN[*]": 1, "IN[1?]": 2, "IN[12]": 3, "E7#001": 4},
      "data_of_run": {"WAY?": "travelled", "SPEED2": "rpm:2"}})",
                                      &error);
  ASSERT_TRUE(p) << error;
  EXPECT_EQ(data_at_rest(*p, "IN[5]"), 1);
  EXPECT_EQ(data_at_rest(*p, "IN[13]"), 2);
  EXPECT_EQ(data_at_rest(*p, "IN[12]"), 3);
  EXPECT_EQ(data_at_rest(*p, "E72001"), 4);
  EXPECT_EQ(data_at_rest(*p, "E7A001"), std::nullopt);
  EXPECT_EQ(data_at_rest(*p, "INX"), std::nullopt);
  ASSERT_TRUE(data_of_run(*p, "WAYX"));
  EXPECT_EQ(data_of_run(*p, "WAYX")->datum, RunDatum::travelled);
  EXPECT_EQ(data_of_run(*p, "SPEED2")->datum, RunDatum::rpm);
  EXPECT_EQ(data_of_run(*p, "SPEED2")->spindle, 2);
  EXPECT_FALSE(data_of_run(*p, "WAY"));
  const auto again = dialects::profile_of(to_json(*p), &error);
  ASSERT_TRUE(again) << error;
  EXPECT_EQ(again->data, p->data);
  auto forgotten = *p;
  forget_data_at_rest(forgotten);
  EXPECT_FALSE(data_at_rest(forgotten, "IN[5]"));
  EXPECT_TRUE(data_of_run(forgotten, "WAYX"));
}

TEST(Profile, DataAtRestIsInheritedUnlessItIsSwitchedOff) {
  std::string error;
  const auto kept = dialects::profile_of(R"({"extends": "fagor-lathe", "name": "a"})", &error);
  const auto none = dialects::profile_of(R"({"extends": "fagor-lathe", "name": "a", "data_at_rest": false})", &error);
  const auto own = dialects::profile_of(R"({"name": "a", "dialect": "fagor", "axes": [{"name": "X"}]})", &error);
  ASSERT_TRUE(kept && none && own) << error;
  EXPECT_EQ(data_at_rest(*kept, "FRO"), 100);
  EXPECT_FALSE(data_at_rest(*none, "FRO"));
  EXPECT_FALSE(data_at_rest(*own, "FRO"));
}

/// A profile that extends nothing describes a machine; how its control behaves follows from its language. Without it
/// the options of no control at all would hold: TRN-522 and TRN-523 stayed silent.
TEST(Profile, ItsOwnMachineHasTheHabitsOfItsControl) {
  std::string error;
  for (const auto& name : builtin_names()) {
    const auto control = dialects::load_profile(name, &error);
    ASSERT_TRUE(control) << error;
    const std::string kind = control->kind == Kind::mill ? "mill" : "lathe";
    const auto own = dialects::profile_of(R"({"name": "a", "dialect": ")" + control->dialect + R"(", "kind": ")" +
                                              kind + R"(", "axes": [{"name": "X"}, {"name": "Z"}]})",
                                          &error);
    ASSERT_TRUE(own) << name << ": " << error;
    EXPECT_EQ(own->name, "a");
    EXPECT_EQ(own->axes.size(), 2U);
    EXPECT_EQ(own->options, control->options) << name;
    EXPECT_EQ(own->power_on, control->power_on) << name;
    EXPECT_EQ(own->frame_order, control->frame_order) << name;
    EXPECT_EQ(own->m_codes.size(), control->m_codes.size()) << name;
  }
  const auto said = dialects::profile_of(R"({"name": "a", "dialect": "fagor", "axes": [{"name": "X"}],
      "options": {"tool.bare_offset": "kept"}})",
                                         &error);
  ASSERT_TRUE(said) << error;
  EXPECT_EQ(said->options.at("tool.bare_offset"), "kept");
  EXPECT_EQ(said->options.at("tool.length_axis"), "plane");
}

TEST(Profile, FaultsAreNamed) {
  EXPECT_THAT(fault(R"({"extends": "fagor-mill", "data_of_run": {"A": "luck"}})"), HasSubstr("data_of_run.A"));
  EXPECT_THAT(fault(R"({"extends": "fagor-mill", "data_at_rest": {"A": "1"}})"), HasSubstr("data_at_rest.A"));
  EXPECT_THAT(fault("{"), HasSubstr("JSON"));
  EXPECT_THAT(fault(R"({"extends": "fagor-mill", "colour": 1})"), HasSubstr("colour"));
  EXPECT_THAT(fault(R"({"extends": "nobody"})"), HasSubstr("nobody"));
  EXPECT_THAT(fault(R"({"name": "a", "dialect": "fagor", "axes": [{"name": "Q"}]})"), HasSubstr("id"));
  EXPECT_THAT(fault(R"({"name": "a", "dialect": "fagor"})"), HasSubstr("axes"));
  EXPECT_THAT(fault(R"({"name": "a", "axes": [{"name": "X"}]})"), HasSubstr("dialect"));
  EXPECT_THAT(fault(R"({"name": "a", "dialect": "pl7", "axes": [{"name": "X"}]})"), HasSubstr("pl7"));
  EXPECT_THAT(fault(R"({"extends": "fagor-mill", "dialect": "num"})"), HasSubstr("dialect"));
  EXPECT_THAT(fault(R"({"extends": "fagor-mill", "kind": "lathe"})"), HasSubstr("kind"));
  EXPECT_THAT(fault(R"({"name": "a", "dialect": "fagor", "axes": [{"name": "X"}, {"name": "X"}]})"),
              HasSubstr("twice"));
  EXPECT_THAT(fault(R"({"extends": "fagor-mill", "power_on": {"plane": "xx"}})"), HasSubstr("power_on.plane"));
  EXPECT_THAT(fault(R"({"extends": "fagor-mill", "frame_order": ["shift", "shift"]})"), HasSubstr("twice"));
  EXPECT_THAT(fault(R"({"extends": "fagor-mill", "options": {"helix.pitch_mismatch": "maybe"}})"), HasSubstr("maybe"));
  EXPECT_THAT(fault(R"({"extends": "fagor-mill", "options": {"helix.picth": "error"}})"), HasSubstr("helix.picth"));
  EXPECT_THAT(fault(R"({"extends": "fagor-mill", "work_offsets": {"0": {"X": 1}}})"), HasSubstr("row"));
  EXPECT_THAT(fault(R"({"extends": "fagor-mill", "arc_tolerance": "big"})"), HasSubstr("arc_tolerance"));
  EXPECT_THAT(fault(R"([])"), HasSubstr("object"));
  std::string error;
  EXPECT_FALSE(dialects::load_profile("no-such-machine", &error));
  EXPECT_THAT(error, HasSubstr("no-such-machine"));
}

TEST(Profile, WhatHoldsWithoutAnOptionIsAValueOfIt) {
  for (const auto& s : dialects::options().rows()) {
    std::string error;
    EXPECT_TRUE(dialects::options().check(s.name, s.fallback, &error)) << error;
  }
}

/// An option that is not set is as if its profile said what the table says.
template <class Rows>
void expect_defaults(const Rows& rows) {
  for (const auto& row : rows) {
    auto set = machine::read_options(Profile{}, rows);
    const auto unset = set;
    row.put(set, row.fallback, value_number(row.fallback, row.values).value_or(0));
    EXPECT_EQ(set, unset) << row.name;
  }
}

TEST(Profile, FieldsOfALanguageBeginWithWhatHoldsWithoutTheOption) {
  expect_defaults(dialects::fagor::option_rows);
  expect_defaults(dialects::num::option_rows);
  expect_defaults(sinumerik::option_rows);
}

/// Words that every language shares, set under the name that one of them has for them.
TEST(Profile, AnOptionOfALanguageSetsWhatEveryControlHas) {
  std::string error;
  EXPECT_EQ(dialects::load_profile("num-mill", &error)->policies.rotary_signed_axes, "BC");
  EXPECT_EQ(dialects::load_profile("heidenhain-mill", &error)->policies.rotary_signed_axes, "");
  const auto set = dialects::profile_of(R"({"extends": "num-mill", "options": {"num.rotary_modulo": "A"}})", &error);
  EXPECT_EQ(set->policies.rotary_signed_axes, "A");
  EXPECT_EQ(dialects::load_profile("sinumerik-mill", &error)->policies.numbered_variables, 100);
  EXPECT_EQ(dialects::load_profile("num-lathe", &error)->policies.spindle_default_gear, "M41");
}

TEST(Profile, EachValueOfAnOptionIsAValueOfItsField) {
  for (const auto& spec : common_options()) {
    Profile p;
    std::string error;
    EXPECT_TRUE(dialects::options().set(p, spec.name, spec.fallback, &error)) << error;
    EXPECT_EQ(p.policies, Policies{}) << spec.name << ": what holds without the option is not the default of its field";
    std::vector<Policies> seen;
    std::string values = spec.values == "text" ? "A|B" : spec.values == "number" ? "1|2" : std::string(spec.values);
    for (std::string_view rest = values; !rest.empty();) {
      const auto bar = std::min(rest.find('|'), rest.size());
      EXPECT_TRUE(dialects::options().set(p, spec.name, rest.substr(0, bar), &error)) << error;
      EXPECT_EQ(std::count(seen.begin(), seen.end(), p.policies), 0) << spec.name << ' ' << rest;
      seen.push_back(p.policies);
      rest.remove_prefix(std::min(bar + 1, rest.size()));
    }
  }
  Profile p;
  std::string error;
  EXPECT_FALSE(dialects::options().set(p, "frame.preset", "other", &error));
  EXPECT_EQ(p.policies, Policies{});
  EXPECT_TRUE(p.options.empty());
}

}  // namespace
}  // namespace cnctrans::machine
