// Many faults on one line: a few of a kind are shown, all are counted.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "base/diagnostics.h"
#include "base/source.h"

namespace cnctrans {
namespace {

TEST(DiagnosticsBound, TenOfACodeOnOneLine) {
  Diagnostics d;
  for (std::uint32_t i = 1; i <= 1000; ++i) d.error("FAG-005", {1, 7, i, 7, i + 1}, "no value");
  d.error("FAG-002", {1, 7, 1, 7, 2}, "another kind");
  d.error("FAG-005", {1, 8, 1, 8, 2}, "no value");
  EXPECT_EQ(d.all().size(), 12U);
  EXPECT_EQ(d.error_count(), 1002U);
  ASSERT_EQ(d.more().count("FAG-005"), 1U);
  EXPECT_EQ(d.more().at("FAG-005").count, 990U);
  ASSERT_EQ(d.more().at("FAG-005").lines.size(), 1U);
  EXPECT_EQ(d.more().at("FAG-005").lines[0].first, 7U);
  const auto json = nlohmann::json::parse(render_json(d, FileTable{}));
  EXPECT_EQ(json.size(), 13U);
  EXPECT_EQ(json.back()["more"], 990);
}

TEST(DiagnosticsBound, WithoutAPlaceThereIsNoLine) {
  Diagnostics d;
  for (int i = 0; i < 50; ++i) d.warning("TRN-001", {}, "somewhere");
  EXPECT_EQ(d.all().size(), 50U);
}

}  // namespace
}  // namespace cnctrans
