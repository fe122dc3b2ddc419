// Edges of the control-flow graph, construct by construct. Statements are numbered from 1 in text order.
#include <gtest/gtest.h>

#include <chrono>
#include <vector>

#include "ir/analysis/dataflow.h"
#include "ir/edit/labels.h"
#include "tests/ir/read_ir.h"

namespace cnctrans::ir {
namespace {

using Edges = std::vector<std::vector<std::uint32_t>>;

/// Successors of the statements 1, 2, ... of a main routine of these lines.
Edges edges(const std::string& lines) {
  const Program p = read_main(lines);
  ControlFlow flow = control_flow(p, p.routines.at(0));
  flow.successors.erase(flow.successors.begin());
  return flow.successors;
}

TEST(Cfg, StraightLineAndEnds) {
  EXPECT_EQ(edges("block\nblock\n"), (Edges{{2}, {0}}));
  EXPECT_EQ(edges("end_program\nblock\nreturn\nblock\n"), (Edges{{0}, {3}, {0}, {0}}));
}

TEST(Cfg, IfWithAndWithoutElse) {
  EXPECT_EQ(edges("if R[1] {\nblock\n}\nblock\n"), (Edges{{2, 3}, {3}, {0}}));
  EXPECT_EQ(edges("if R[1] {\nblock\n} else {\nblock\n}\nblock\n"), (Edges{{2, 3}, {4}, {4}, {0}}));
  EXPECT_EQ(edges("if R[1] {\n} else {\n}\n"), (Edges{{0}}));
}

TEST(Cfg, Loops) {
  EXPECT_EQ(edges("while R[1] {\nblock\n}\nblock\n"), (Edges{{2, 3}, {1}, {0}}));
  EXPECT_EQ(edges("for R[1] = 1 to 3 {\nblock\n}\nblock\n"), (Edges{{2, 3}, {1}, {0}}));
  EXPECT_EQ(edges("loop {\nblock\n}\nblock\n"), (Edges{{2}, {1}, {0}}));
  EXPECT_EQ(edges("until {\nblock\n} until R[1]\nblock\n"), (Edges{{2}, {1, 3}, {0}}));
  EXPECT_EQ(edges("loop {\n}\n"), (Edges{{1}}));
  EXPECT_EQ(edges("until {\n} until R[1]\nblock\n"), (Edges{{1, 2}, {0}}));
}

TEST(Cfg, ExitLeavesTheInnermostLoop) {
  EXPECT_EQ(edges("loop {\nwhile R[1] {\nif R[2] {\nexit\n}\n}\nexit\n}\nblock\n"),
            (Edges{{2}, {3, 5}, {2, 4}, {5}, {6}, {0}}));
}

TEST(Cfg, JumpsGoToTheirLabelAndOnWhenConditional) {
  EXPECT_EQ(edges("N10 block\njump N10\nblock\n"), (Edges{{2}, {1}, {0}}));
  EXPECT_EQ(edges("N10 block\njump N10 if R[1]\nblock\n"), (Edges{{2}, {1, 3}, {0}}));
  EXPECT_EQ(edges("jump N0010\nblock\nN010 block\n"), (Edges{{3}, {3}, {0}})) << "leading zeros do not count";
  EXPECT_EQ(edges("jump HERE\nblock\n\"here\": block\n"), (Edges{{3}, {3}, {0}})) << "nor does case";
  EXPECT_EQ(edges("jump N99\nblock\n"), (Edges{{}, {0}}));
  EXPECT_EQ(edges("jump N99 quiet\nblock\n"), (Edges{{2}, {0}}));
  EXPECT_EQ(edges("block\nblock\njump \"\" search to_start\n"), (Edges{{2}, {3}, {1}}));
}

TEST(Cfg, SearchRulesWithDuplicateLabels) {
  const auto target = [](const std::string& search) {
    return edges("N10 block\nN10 block\njump N10 search " + search + "\nN10 block\nN10 block\n").at(2);
  };
  using Ids = std::vector<std::uint32_t>;
  EXPECT_EQ(target("whole_first"), Ids{1});
  EXPECT_EQ(target("forward"), Ids{4});
  EXPECT_EQ(target("backward"), Ids{2});
  EXPECT_EQ(target("forward_then_backward"), Ids{4});
  EXPECT_EQ(edges("N10 block\njump N10 search forward_then_backward\n").at(1), Ids{1});
  EXPECT_EQ(edges("N10 block\njump N10 search forward\n").at(1), Ids{});
  EXPECT_EQ(edges("jump N10 search backward\nN10 block\n").at(0), Ids{});
  EXPECT_EQ(edges("N10 jump N10 search backward\n").at(0), Ids{1}) << "its own line lies backward";
}

TEST(Cfg, ComputedJumpsReachEveryLabelTheirSearchCanFind) {
  EXPECT_EQ(edges("N10 block\nblock\njump at R[1]\nA: block\nblock\n").at(2), (std::vector<std::uint32_t>{1, 4}));
  EXPECT_EQ(edges("N10 block\nblock\njump at R[1] search forward\nA: block\n").at(2), (std::vector<std::uint32_t>{4}));
  EXPECT_EQ(edges("N10 block\njump at R[1] if R[2] search backward\nN20 block\n").at(1),
            (std::vector<std::uint32_t>{1, 3}));
}

TEST(Cfg, SwitchLeadsToItsCasesAndOnWithoutDefault) {
  EXPECT_EQ(edges("switch R[1] case 1 jump N10 case 2 jump N20\nblock\nN10 block\nN20 block\n").at(0),
            (std::vector<std::uint32_t>{2, 3, 4}));
  EXPECT_EQ(edges("switch R[1] case 1 jump N10 default N20\nblock\nN10 block\nN20 block\n").at(0),
            (std::vector<std::uint32_t>{3, 4}));
}

TEST(Cfg, JumpsIntoStructures) {
  EXPECT_EQ(edges("jump N10\nwhile R[1] {\nblock\nN10 block\n}\n"), (Edges{{4}, {0, 3}, {4}, {2}}));
  // A label on the closing line: back to the head of a loop, past an IF.
  EXPECT_EQ(edges("jump N10\nwhile R[1] {\nblock\nN10 }\n").at(0), (std::vector<std::uint32_t>{2}));
  EXPECT_EQ(edges("jump N10\nif R[1] {\nblock\nN10 }\nblock\n").at(0), (std::vector<std::uint32_t>{4}));
  EXPECT_EQ(edges("jump N10\nuntil {\nblock\nN10 } until R[1]\nblock\n").at(0), (std::vector<std::uint32_t>{2, 4}));
  EXPECT_EQ(edges("jump N10\nif R[1] {\nblock\nN10 } else {\nblock\n}\nblock\n").at(0),
            (std::vector<std::uint32_t>{5}));
}

TEST(Cfg, RepeatRangesComeBackBehindTheRepeat) {
  // The range N10..N20 is statements 1-2; behind it: first again (another pass), 3 (plain flow), 5 (after the Repeat).
  EXPECT_EQ(edges("N10 block\nN20 block\nblock\nrepeat N10 N20 count 2\nblock\n"),
            (Edges{{2}, {1, 3, 5}, {4}, {1}, {0}}));
  EXPECT_EQ(edges("N10 block\nblock\nrepeat N10 N10 count R[1]\nblock\n").at(2), (std::vector<std::uint32_t>{1, 4}))
      << "a count that may be 0";
  EXPECT_EQ(edges("N20 block\nN10 block\nrepeat N10 N20 order_free\nblock\n"), (Edges{{2}, {3, 4}, {1}, {0}}));
  EXPECT_EQ(edges("A: block\nblock\nrepeat A \"\" count 2\nblock\n"), (Edges{{2}, {3}, {1, 4}, {0}}))
      << "without a second label: up to the repeat";
}

TEST(Cfg, RepeatRangeWithDuplicateLabels) {
  // Backward: the nearest A before the repeat, then the next B from there on.
  EXPECT_EQ(edges("A: block\nB: block\nA: block\nB: block\nrepeat A B search backward\nblock\n").at(3),
            (std::vector<std::uint32_t>{5, 6}));
  EXPECT_EQ(edges("A: block\nB: block\nA: block\nB: block\nrepeat A B\nblock\n").at(1),
            (std::vector<std::uint32_t>{3, 6}));
  EXPECT_EQ(edges("B: block\nA: block\nrepeat A B\nblock\n").at(2), (std::vector<std::uint32_t>{}))
      << "the wrong order";
}

TEST(Cfg, RepeatRangeEndsBehindEverythingOnItsLastLine) {
  EXPECT_EQ(edges("N10 block\n& block\nblock\nrepeat N10 N10\nblock\n"), (Edges{{2}, {3, 5}, {4}, {1}, {0}}));
}

TEST(Cfg, RepeatRangeThatNothingFallsIntoEndsWithItsLastStatement) {
  EXPECT_EQ(edges("repeat N10 N20\njump N99\nN10 block\nN20 block\nblock\nN99 block\n"),
            (Edges{{3}, {6}, {4}, {2}, {6}, {0}}));
  EXPECT_EQ(edges("repeat N10 N20\nN10 block\nN20 block\nblock\n"), (Edges{{2}, {3}, {2, 4}, {0}}))
      << "the text comes to it, too";
  EXPECT_EQ(edges("repeat N10 N30\nend_program\nN10 block\nrepeat N40 N40\nN30 block\nN40 block\nblock\n"),
            (Edges{{3}, {0}, {4}, {6}, {2}, {5}, {0}}))
      << "one range inside another";
  EXPECT_EQ(edges("repeat N10 N20\nrepeat N10 N30\nend_program\nN10 block\nN20 block\nN30 block\n").at(4),
            (std::vector<std::uint32_t>{2, 6}))
      << "a longer range comes through";
}

TEST(Cfg, AReturnInARepeatedRangeEndsTheRepeatAlone) {
  EXPECT_EQ(edges("repeat N10 N20\nend_program\nN10 block\nreturn\nN20 block\n"), (Edges{{3}, {0}, {4}, {0, 2}, {2}}));
  EXPECT_EQ(edges("N10 block\nN20 block\nreturn\nrepeat N10 N20\n").at(2), (std::vector<std::uint32_t>{0}))
      << "behind the range it ends the routine";
}

TEST(Cfg, RepeatRangeThatEndsInAStructure) {
  EXPECT_EQ(edges("N10 if R[1] {\nblock\n}\nblock\nrepeat N10 N10\nblock\n"),
            (Edges{{2, 3, 5}, {3, 5}, {4}, {1}, {0}}));
}

TEST(Cfg, NestedRepeatRanges) {
  // 2 repeats 1; 4 repeats 1..2: behind 2 comes 3 (flow), 5 (behind 4). Behind 1: 2, and behind 2.
  EXPECT_EQ(edges("N10 block\nN20 repeat N10 N10\nblock\nrepeat N10 N20\nblock\n"),
            (Edges{{2, 3, 5}, {1}, {4}, {1}, {0}}));
}

TEST(Cfg, BlockSkipGoesOnBehindTheStatementOrTheRestOfItsLine) {
  EXPECT_EQ(edges("/0 jump N10\nblock\nN10 block\n"), (Edges{{2, 3}, {3}, {0}}));
  EXPECT_EQ(edges("/0 block\n& end_program\nblock\n"), (Edges{{2}, {0, 3}, {0}}));
}

TEST(Cfg, CallsComeBackExceptTheLast) {
  EXPECT_EQ(edges("call 7\nblock\ncall 8 tail\nblock\n"), (Edges{{2}, {3}, {}, {0}}));
}

TEST(Cfg, ManyLabelsAndComputedJumpsStayFast) {
  std::string lines;
  for (int i = 1; i <= 20000; ++i) lines += "N" + std::to_string(i) + " block\n";
  lines += "jump at R[1]\n";
  const Program p = read_main(lines);
  const auto start = std::chrono::steady_clock::now();
  const ControlFlow flow = control_flow(p, p.routines[0]);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  EXPECT_EQ(flow.successors.back().size(), 20000U);
  EXPECT_LT(took.count(), 2.0);
}

TEST(Labels, AllSitesInTextOrder) {
  const Program p = read_main("N10 block\nA: if R[1] {\nN20 block\nN30 } else {\nblock\nN40 }\n");
  const LabelTable labels(p.routines.at(0));
  ASSERT_EQ(labels.sites().size(), 5U);
  EXPECT_EQ(labels.sites()[3], (LabelSite{2, SitePart::else_line, 4}));
  EXPECT_EQ(labels.sites()[4], (LabelSite{2, SitePart::end_line, 6}));
  EXPECT_EQ(labels.order(3), 3U);
  EXPECT_EQ(labels.order(4), 5U);
  EXPECT_EQ(labels.order(99), 0U);
}

}  // namespace
}  // namespace cnctrans::ir
