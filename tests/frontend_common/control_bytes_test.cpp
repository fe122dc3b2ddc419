#include "frontends/common/control_bytes.h"

#include <gtest/gtest.h>

namespace cnctrans::frontends {
namespace {

constexpr auto none = std::string_view::npos;

TEST(ControlBytes, OutsideOfCommentsAndTexts) {
  EXPECT_EQ(find_control_byte("G1 X\x01", ';', '"', '"'), 4U);
  EXPECT_EQ(find_control_byte(std::string_view("\0G1", 3), ';', '"', '"'), 0U);
  EXPECT_EQ(find_control_byte("G1\tX1 \xE4", ';', '"', '"'), none);
  EXPECT_EQ(find_control_byte("G1 ; \x01", ';', '"', '"'), none);
  EXPECT_EQ(find_control_byte("MSG(\"\x01\")", ';', '"', '"'), none);
  EXPECT_EQ(find_control_byte("MSG(\";\")\x02", ';', '"', '"'), 8U);
  EXPECT_EQ(find_control_byte("(\x01) X\x02", '$', '(', ')'), 5U);
  EXPECT_EQ(find_control_byte("(\x01 X\x02", '$', '(', ')'), none);
  EXPECT_EQ(find_control_byte("$\x01", '$', '(', ')'), none);
}

}  // namespace
}  // namespace cnctrans::frontends
