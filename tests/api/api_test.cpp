// The public interfaces, C++ and C: programs in memory, results as values, nothing thrown.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "cnctrans/api.h"
#include "cnctrans/cnctrans.h"

namespace {

namespace api = cnctrans::api;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

const std::string hole = "N10 G0 X10 Y20 Z5 F100\nN20 (CALL 7)\nN30 M30\n";
const std::string called = "(SUB 7)\nG1 Z-3\nG0 Z5\n(RET)\n";

api::TranslateOptions fagor_to(const std::string& to) {
  api::TranslateOptions options;
  options.from = "fagor";
  options.to = to;
  options.verify = true;
  return options;
}

TEST(Api, ListsLanguagesAndMachines) {
  EXPECT_FALSE(api::version().empty());
  bool fagor = false;
  for (const auto& d : api::dialects()) {
    if (d.name != "fagor") continue;
    fagor = true;
    EXPECT_TRUE(d.read);
    EXPECT_THAT(d.lathe_extensions, testing::Contains("pit"));
  }
  EXPECT_TRUE(fagor);
  EXPECT_THAT(api::machines(), testing::Contains("fagor-mill"));
}

TEST(Api, TranslatesATextWithWhatItCalls) {
  api::TranslateOptions options = fagor_to("sinumerik");
  options.programs = {api::text("sub7.pim", called)};
  const auto done = api::translate(api::text("hole.pim", hole), options);
  ASSERT_EQ(done.status, api::Status::ok) << done.error;
  ASSERT_TRUE(done.verdict);
  EXPECT_EQ(done.verdict->result, api::Verdict::Result::verified);
  EXPECT_EQ(done.verdict->moves, 3U);  // to the hole, down, up
  ASSERT_FALSE(done.outputs.empty());
  EXPECT_TRUE(done.outputs.front().main);
  std::string all;
  for (const auto& o : done.outputs) all += o.bytes;
  EXPECT_THAT(all, HasSubstr("Z-3"));
}

TEST(Api, TellsWhereALineComesFrom) {
  const auto done = api::translate(api::text("line.pim", "N10 G1 X1 F50\nN20 X2\nN30 M30\n"), fagor_to("num"));
  ASSERT_EQ(done.status, api::Status::ok) << done.error;
  const api::Output& out = done.outputs.at(0);
  std::size_t start = 0;
  for (std::size_t n = 0; n < out.lines.size(); ++n) {
    const std::size_t end = out.bytes.find('\n', start);
    if (out.bytes.substr(start, end - start).find("X2") != std::string::npos) {
      EXPECT_EQ(out.lines[n].line, 2U);
      EXPECT_EQ(out.lines[n].file, "line.pim");
      return;
    }
    start = end + 1;
  }
  FAIL() << "no line with X2 in:\n" << out.bytes;
}

TEST(Api, ATextHasNoFolder) {
  const auto done = api::translate(api::text("hole.pim", hole), fagor_to("num"));
  EXPECT_EQ(done.status, api::Status::refused);
  EXPECT_THAT(done.outputs, IsEmpty());
  ASSERT_FALSE(done.diagnostics.empty());
  EXPECT_EQ(done.diagnostics.front().place.line, 2U);
  EXPECT_THAT(done.diagnostics.front().shown, HasSubstr("(CALL 7)"));
}

TEST(Api, ProvesUnlessToldOtherwise) {
  api::TranslateOptions options;
  options.from = "fagor";
  options.to = "num";
  const api::Program moves = api::text("a.pim", "G1 X10 F100\nM30\n"),
                     fails = api::text("b.pim", "G1 X10 F100\n(P100=1/0)\nM30\n");
  const auto proved = api::translate(moves, options);
  ASSERT_TRUE(proved.verdict);
  EXPECT_THAT(proved.verdict->text, testing::StartsWith("verified: "));

  const auto open = api::translate(fails, options);
  EXPECT_EQ(open.status, api::Status::ok);
  ASSERT_TRUE(open.verdict);
  EXPECT_EQ(open.verdict->result, api::Verdict::Result::not_replayable);
  EXPECT_THAT(open.verdict->text, testing::StartsWith("not proved: the source stopped"));
  for (const auto& d : open.diagnostics) EXPECT_NE(d.severity, api::Severity::error) << d.shown;

  options.verify = true;
  const auto asked = api::translate(fails, options);
  EXPECT_EQ(asked.status, api::Status::refused);
  EXPECT_THAT(asked.outputs, SizeIs(1));
  EXPECT_THAT(asked.verdict->text, testing::StartsWith("not verified: the source stopped"));

  options.verify = options.prove = false;
  EXPECT_FALSE(api::translate(moves, options).verdict);
}

TEST(Api, UsageErrorsAreNamed) {
  EXPECT_EQ(api::translate(api::text("a.pim", "M30\n"), fagor_to("latin")).status, api::Status::usage);
  const auto missing = api::translate(api::file("/nowhere/a.pim"), fagor_to("num"));
  EXPECT_EQ(missing.status, api::Status::usage);
  EXPECT_THAT(missing.error, HasSubstr("/nowhere/a.pim"));
  api::TranslateOptions options = fagor_to("num");
  options.number_step = 0;
  EXPECT_EQ(api::translate(api::text("a.pim", "M30\n"), options).status, api::Status::usage);
  options = fagor_to("num");
  options.skip = {99};
  EXPECT_EQ(api::translate(api::text("a.pim", "M30\n"), options).status, api::Status::usage);
}

TEST(Api, RunsWithGivenValues) {
  api::RunOptions options;
  options.dialect = "fagor";
  options.set = {{"P100", "12.5"}};
  std::vector<std::string> events;
  const auto done = api::run(api::text("p.pim", "G1 XP100 F100\nM30\n"), options,
                             [&events](std::string_view json) { events.emplace_back(json); });
  EXPECT_EQ(done.status, api::Status::ok) << done.error;
  EXPECT_EQ(done.reason, "program_end");
  EXPECT_THAT(events, testing::Contains(HasSubstr("\"X\":12.5")));
  EXPECT_THAT(done.variables, testing::Contains(testing::Pair("P100", "12.5")));
  options.set = {{"P100", "twelve"}};
  EXPECT_EQ(api::run(api::text("p.pim", "M30\n"), options).status, api::Status::usage);
}

TEST(Api, ComparesTwoTexts) {
  const auto options = fagor_to("num");
  const auto same =
      api::verify(api::text("a.pim", "G1 X10 F100\nM30\n"), {api::text("a.xpi", "%1\nG1 X10 F100\nM02\n")}, options);
  EXPECT_EQ(same.status, api::Status::ok) << same.error << same.verdict.text;
  const auto other =
      api::verify(api::text("a.pim", "G1 X10 F100\nM30\n"), {api::text("a.xpi", "%1\nG1 X11 F100\nM02\n")}, options);
  EXPECT_EQ(other.status, api::Status::differs);
  EXPECT_THAT(other.verdict.text, HasSubstr("X"));
  // A second program of the translation, in memory too.
  const auto with_sub =
      api::verify(api::text("a.pim", "G1 X10 F100\nM30\n"),
                  {api::text("a.xpi", "%1\nF100\nG77 H5\nM02\n"), api::text("5.xpi", "%5\nG1 X10\n")}, options);
  EXPECT_EQ(with_sub.status, api::Status::ok) << with_sub.error << with_sub.verdict.text;
  EXPECT_EQ(api::verify(api::text("a.pim", "M30\n"), {}, options).status, api::Status::usage);
}

TEST(Api, ChecksAProgram) {
  api::RunOptions options;
  options.dialect = "fagor";
  const auto done = api::check(api::text("a.pim", "N10 G1 X1 F10\nN20 G99999\n"), options);
  EXPECT_EQ(done.status, api::Status::refused);
  EXPECT_EQ(done.lines, 2U);
  EXPECT_EQ(done.blocks, 2U);
  EXPECT_EQ(done.blocks_read, 1U);
}

/// Frees what the C interface gave out.
struct Job {
  cnctrans_job* job = cnctrans_job_new();
  Job() = default;
  Job(const Job&) = delete;
  Job& operator=(const Job&) = delete;
  ~Job() { cnctrans_job_free(job); }
};
struct Result {
  cnctrans_result* result;
  explicit Result(cnctrans_result* r) : result(r) {}
  Result(const Result&) = delete;
  Result& operator=(const Result&) = delete;
  ~Result() { cnctrans_result_free(result); }
};

TEST(CApi, TranslatesAsTheCppInterface) {
  const Job j;
  EXPECT_EQ(cnctrans_job_set(j.job, "from", "fagor"), CNCTRANS_OK);
  EXPECT_EQ(cnctrans_job_set(j.job, "to", "sinumerik"), CNCTRANS_OK);
  EXPECT_EQ(cnctrans_job_set(j.job, "verify", "1"), CNCTRANS_OK);
  EXPECT_EQ(cnctrans_job_add_program(j.job, "sub7.pim", called.data(), called.size()), CNCTRANS_OK);
  const Result r(cnctrans_translate(j.job, "hole.pim", hole.data(), hole.size()));
  ASSERT_EQ(cnctrans_result_status(r.result), CNCTRANS_OK) << cnctrans_result_error(r.result);
  EXPECT_THAT(cnctrans_result_verdict(r.result), HasSubstr("verified"));

  api::TranslateOptions options = fagor_to("sinumerik");
  options.programs = {api::text("sub7.pim", called)};
  const auto cpp = api::translate(api::text("hole.pim", hole), options);
  ASSERT_EQ(cnctrans_result_output_count(r.result), cpp.outputs.size());
  for (std::size_t i = 0; i < cpp.outputs.size(); ++i) {
    std::size_t size = 0;
    const char* bytes = cnctrans_result_output_bytes(r.result, i, &size);
    EXPECT_EQ(std::string(bytes, size), cpp.outputs[i].bytes);
    EXPECT_EQ(cnctrans_result_output_name(r.result, i), cpp.outputs[i].name);
  }
  EXPECT_EQ(cnctrans_result_output_name(r.result, cpp.outputs.size()), nullptr);
}

TEST(CApi, TakesTheOptionsOfTheCommandLine) {
  const Job j;
  for (const auto& [option, value] : std::vector<std::pair<const char*, const char*>>{{"dialect", "num"},
                                                                                      {"machine", "num-mill"},
                                                                                      {"target-machine", "fagor-mill"},
                                                                                      {"lib", "/tmp"},
                                                                                      {"set", "L1=2"},
                                                                                      {"skip", "0,3"},
                                                                                      {"unsupported", "comment"},
                                                                                      {"numbering", "renumber"},
                                                                                      {"number-step", "5"},
                                                                                      {"cycles", "explode"},
                                                                                      {"structure", "raise"},
                                                                                      {"annotate", "1"},
                                                                                      {"one-file", "1"},
                                                                                      {"explore", "10"},
                                                                                      {"encoding", "utf-8"},
                                                                                      {"eol", "crlf"},
                                                                                      {"reader", "antlr"},
                                                                                      {"max-events", "1000"}})
    EXPECT_EQ(cnctrans_job_set(j.job, option, value), CNCTRANS_OK) << option;
  for (const auto& [option, value] : std::vector<std::pair<const char*, const char*>>{{"colour", "1"},
                                                                                      {"set", "L1"},
                                                                                      {"skip", "99"},
                                                                                      {"skip", "x"},
                                                                                      {"unsupported", "ignore"},
                                                                                      {"number-step", "0"},
                                                                                      {"number-step", "5x"},
                                                                                      {"annotate", "yes"},
                                                                                      {"explore", "-1"},
                                                                                      {nullptr, nullptr}})
    EXPECT_EQ(cnctrans_job_set(j.job, option, value), CNCTRANS_USAGE) << (option == nullptr ? "null" : option);
}

TEST(CApi, RunsAndTellsWhatIsWrong) {
  const Job j;
  cnctrans_job_set(j.job, "dialect", "fagor");
  std::vector<std::string> events;
  const auto take = [](void* user, const char* json, std::size_t size) {
    static_cast<std::vector<std::string>*>(user)->emplace_back(json, size);
  };
  const std::string text = "G1 X10 F100\nM30\n";
  const Result good(cnctrans_run(j.job, "a.pim", text.data(), text.size(), take, &events));
  EXPECT_EQ(cnctrans_result_status(good.result), CNCTRANS_OK);
  EXPECT_FALSE(events.empty());

  const std::string wrong = "N10 G1 X1 F10\nN20 G99999\n";
  const Result bad(cnctrans_check(j.job, "bad.pim", wrong.data(), wrong.size()));
  EXPECT_EQ(cnctrans_result_status(bad.result), CNCTRANS_REFUSED);
  ASSERT_GT(cnctrans_result_diagnostic_count(bad.result), 0U);
  cnctrans_diagnostic d;
  ASSERT_EQ(cnctrans_result_diagnostic(bad.result, 0, &d), 1);
  EXPECT_EQ(d.line, 2U);
  EXPECT_STREQ(d.file, "bad.pim");
  EXPECT_EQ(d.severity, CNCTRANS_ERROR);
  EXPECT_EQ(cnctrans_result_diagnostic(bad.result, 1000, &d), 0);
}

TEST(CApi, ProvesUnlessToldOtherwise) {
  const std::string fails = "G1 X10 F100\n(P100=1/0)\nM30\n";
  const auto told = [&fails](const char* option, const char* value) {
    Job j;
    EXPECT_EQ(cnctrans_job_set(j.job, "from", "fagor"), CNCTRANS_OK);
    EXPECT_EQ(cnctrans_job_set(j.job, "to", "num"), CNCTRANS_OK);
    if (option != nullptr) {
      EXPECT_EQ(cnctrans_job_set(j.job, option, value), CNCTRANS_OK);
    }
    const Result r(cnctrans_translate(j.job, "a.pim", fails.data(), fails.size()));
    return std::pair(cnctrans_result_status(r.result), std::string(cnctrans_result_verdict(r.result)));
  };
  EXPECT_EQ(told(nullptr, nullptr).first, CNCTRANS_OK);
  EXPECT_THAT(told(nullptr, nullptr).second, testing::StartsWith("not proved: "));
  EXPECT_EQ(told("verify", "1").first, CNCTRANS_REFUSED);
  EXPECT_THAT(told("verify", "1").second, testing::StartsWith("not verified: "));
  EXPECT_EQ(told("explore", "5").first, CNCTRANS_REFUSED);
  EXPECT_EQ(told("verify", "0"), std::pair(CNCTRANS_OK, std::string()));
  EXPECT_EQ(told("no-verify", "1"), std::pair(CNCTRANS_OK, std::string()));
  EXPECT_EQ(told("no-verify", "0").second, told(nullptr, nullptr).second);
}

TEST(CApi, NullIsNoCrash) {
  const Result r(cnctrans_translate(nullptr, nullptr, nullptr, 0));
  EXPECT_EQ(cnctrans_result_status(r.result), CNCTRANS_USAGE);
  EXPECT_EQ(cnctrans_result_status(nullptr), CNCTRANS_USAGE);
  EXPECT_STREQ(cnctrans_result_error(nullptr), "");
  EXPECT_EQ(cnctrans_result_output_count(nullptr), 0U);
  cnctrans_job_free(nullptr);
  cnctrans_result_free(nullptr);
}

}  // namespace
