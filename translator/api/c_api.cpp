// The C interface: a job is the options by their words, a result is that of the C++ interface.
#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <exception>
#include <memory>
#include <new>
#include <string>
#include <string_view>

#include "cnctrans/cnctrans.h"
#include "translator/api/calls.h"
#include "translator/option_words.h"
#include "translator/version.h"

namespace api = cnctrans::api;
namespace house = cnctrans::translator;

struct cnctrans_job {
  cnctrans_job() { house::prove_as_usual(options); }
  house::TranslateOptions options;
  std::string dialect;
  std::string skips;
  std::uint64_t max_events = 0;
};

struct cnctrans_result {
  api::Status status = api::Status::usage;
  std::string error, verdict;
  std::vector<api::Output> outputs;
  std::vector<api::Diagnostic> diagnostics;
};

namespace {

std::string_view view(const char* text) {
  return text == nullptr ? std::string_view() : std::string_view(text);
}

bool whole_number(std::string_view text, std::uint64_t& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && end == text.data() + text.size();
}

/// An option that is not a word of a list: takes the value, or says that it can't.
struct FreeOption {
  std::string_view name;
  bool (*set)(cnctrans_job&, std::string_view);
};

bool on_off(std::string_view value, bool& out) {
  if (value != "0" && value != "1") return false;
  out = value == "1";
  return true;
}

constexpr std::array free_options{
    FreeOption{"from", [](cnctrans_job& j, std::string_view v) { return j.options.from = v, true; }},
    FreeOption{"to", [](cnctrans_job& j, std::string_view v) { return j.options.to = v, true; }},
    FreeOption{"dialect", [](cnctrans_job& j, std::string_view v) { return j.dialect = v, true; }},
    FreeOption{"machine", [](cnctrans_job& j, std::string_view v) { return j.options.machine = v, true; }},
    FreeOption{"target-machine",
               [](cnctrans_job& j, std::string_view v) { return j.options.target_machine = v, true; }},
    FreeOption{"lib", [](cnctrans_job& j, std::string_view v) { return j.options.libraries.emplace_back(v), true; }},
    FreeOption{"set", [](cnctrans_job& j, std::string_view v) { return house::add_setting(j.options.run, v); }},
    FreeOption{"skip",
               [](cnctrans_job& j, std::string_view v) {
                 cnctrans::interpreter::Options trial;
                 return house::add_skips(trial, v, nullptr) && (j.skips = v, true);
               }},
    FreeOption{"number-step",
               [](cnctrans_job& j, std::string_view v) {
                 std::uint64_t step = 0;
                 if (!whole_number(v, step) || step < 1 || step > 1000) return false;
                 return j.options.number_step = static_cast<std::int32_t>(step), true;
               }},
    FreeOption{"origin", [](cnctrans_job& j, std::string_view v) { return on_off(v, j.options.origin); }},
    FreeOption{"annotate", [](cnctrans_job& j, std::string_view v) { return on_off(v, j.options.annotate); }},
    FreeOption{"verify",
               [](cnctrans_job& j, std::string_view v) {
                 return on_off(v, j.options.strict) && ((j.options.verify = j.options.strict), true);
               }},
    FreeOption{"no-verify",
               [](cnctrans_job& j, std::string_view v) {
                 bool none = false;
                 return on_off(v, none) && ((j.options.verify = !none), true);
               }},
    FreeOption{"one-file", [](cnctrans_job& j, std::string_view v) { return on_off(v, j.options.single_output); }},
    FreeOption{"explore",
               [](cnctrans_job& j, std::string_view v) {
                 std::uint64_t replays = 0;
                 if (!whole_number(v, replays)) return false;
                 const auto most = static_cast<std::size_t>(std::min<std::uint64_t>(replays, SIZE_MAX));
                 j.options.further = most != 0 ? house::FurtherReplays{false, most, {}} : house::usual_replays;
                 j.options.strict = j.options.strict || replays != 0;
                 j.options.verify = j.options.verify || replays != 0;
                 return true;
               }},
    FreeOption{"max-events", [](cnctrans_job& j, std::string_view v) { return whole_number(v, j.max_events); }},
};

/// The job's options for a call, with what depends on the program's language. A null job has none.
house::TranslateOptions options_of(const cnctrans_job* job) {
  house::TranslateOptions with;
  house::prove_as_usual(with);
  with.run.max_events = house::kept_events;
  if (job == nullptr) return with;
  with = job->options;
  with.run.max_events = job->max_events != 0 ? job->max_events : house::kept_events;
  house::add_skips(with.run, job->skips, house::find_dialect(job->dialect.empty() ? with.from : job->dialect));
  return with;
}

house::RunOptions run_options_of(const cnctrans_job* job) {
  const house::TranslateOptions all = options_of(job);
  house::RunOptions with;
  static_cast<house::InputOptions&>(with) = all;
  with.run = all.run;
  if (job == nullptr || job->max_events == 0) with.run.max_events = cnctrans::interpreter::Options().max_events;
  if (job != nullptr) with.dialect = job->dialect.empty() ? job->options.from : job->dialect;
  return with;
}

house::Input input_of(const char* name, const char* bytes, std::size_t size) {
  api::Program program = api::file(std::string(view(name)));
  if (bytes != nullptr) program.bytes = std::string(bytes, size);
  return house::input_of(program);
}

/// A result of what `work` returns; null when there is no memory for one.
template <class Work>
cnctrans_result* result_of(const Work& work) {
  try {
    auto result = std::make_unique<cnctrans_result>();
    auto done = work(*result);
    result->status = done.status;
    result->error = std::move(done.error);
    result->diagnostics = std::move(done.diagnostics);
    return result.release();
  } catch (const std::exception&) {
    return nullptr;
  }
}

template <class T>
const T* at(const std::vector<T>& list, std::size_t index) {
  return index < list.size() ? &list[index] : nullptr;
}

}  // namespace

extern "C" {

const char* cnctrans_version(void) {
  return house::version.data();
}

cnctrans_job* cnctrans_job_new(void) {
  return new (std::nothrow) cnctrans_job;
}

void cnctrans_job_free(cnctrans_job* job) {
  delete job;
}

cnctrans_status cnctrans_job_set(cnctrans_job* job, const char* option, const char* value) {
  if (job == nullptr) return CNCTRANS_USAGE;
  try {
    for (const auto& known : free_options) {
      if (known.name == view(option)) return known.set(*job, view(value)) ? CNCTRANS_OK : CNCTRANS_USAGE;
    }
    return house::set_word(job->options, view(option), view(value)) ? CNCTRANS_OK : CNCTRANS_USAGE;
  } catch (const std::exception&) {
    return CNCTRANS_REFUSED;
  }
}

cnctrans_status cnctrans_job_add_program(cnctrans_job* job, const char* name, const char* bytes, size_t size) {
  if (job == nullptr || bytes == nullptr) return CNCTRANS_USAGE;
  try {
    job->options.texts.push_back(cnctrans::SourceText::from_string(std::string(view(name)), std::string(bytes, size)));
    return CNCTRANS_OK;
  } catch (const std::exception&) {
    return CNCTRANS_REFUSED;
  }
}

cnctrans_result* cnctrans_translate(const cnctrans_job* job, const char* name, const char* bytes, size_t size) {
  return result_of([&](cnctrans_result& result) {
    api::Translation done = house::translate_for(input_of(name, bytes, size), options_of(job));
    result.outputs = std::move(done.outputs);
    if (done.verdict) result.verdict = std::move(done.verdict->text);
    return done;
  });
}

cnctrans_result* cnctrans_check(const cnctrans_job* job, const char* name, const char* bytes, size_t size) {
  return result_of(
      [&](cnctrans_result&) { return house::check_for(input_of(name, bytes, size), run_options_of(job)); });
}

cnctrans_result* cnctrans_run(const cnctrans_job* job, const char* name, const char* bytes, size_t size,
                              cnctrans_event_sink sink, void* user) {
  return result_of([&](cnctrans_result&) {
    api::EventSink tell;
    if (sink != nullptr) tell = [sink, user](std::string_view json) { sink(user, json.data(), json.size()); };
    return house::run_for(input_of(name, bytes, size), run_options_of(job), tell);
  });
}

cnctrans_result* cnctrans_verify(const cnctrans_job* job, const char* source, const char* target) {
  return result_of([&](cnctrans_result& result) {
    api::Comparison done = house::verify_for(std::string(view(source)), {std::string(view(target))}, options_of(job));
    result.verdict = std::move(done.verdict.text);
    return done;
  });
}

void cnctrans_result_free(cnctrans_result* result) {
  delete result;
}

cnctrans_status cnctrans_result_status(const cnctrans_result* result) {
  return result == nullptr ? CNCTRANS_USAGE : static_cast<cnctrans_status>(result->status);
}

const char* cnctrans_result_error(const cnctrans_result* result) {
  return result == nullptr ? "" : result->error.c_str();
}

const char* cnctrans_result_verdict(const cnctrans_result* result) {
  return result == nullptr ? "" : result->verdict.c_str();
}

size_t cnctrans_result_output_count(const cnctrans_result* result) {
  return result == nullptr ? 0 : result->outputs.size();
}

const char* cnctrans_result_output_name(const cnctrans_result* result, size_t index) {
  const api::Output* output = result == nullptr ? nullptr : at(result->outputs, index);
  return output == nullptr ? nullptr : output->name.c_str();
}

const char* cnctrans_result_output_bytes(const cnctrans_result* result, size_t index, size_t* size) {
  const api::Output* output = result == nullptr ? nullptr : at(result->outputs, index);
  if (size != nullptr) *size = output == nullptr ? 0 : output->bytes.size();
  return output == nullptr ? nullptr : output->bytes.c_str();
}

size_t cnctrans_result_diagnostic_count(const cnctrans_result* result) {
  return result == nullptr ? 0 : result->diagnostics.size();
}

int cnctrans_result_diagnostic(const cnctrans_result* result, size_t index, cnctrans_diagnostic* out) {
  const api::Diagnostic* d = result == nullptr ? nullptr : at(result->diagnostics, index);
  if (d == nullptr || out == nullptr) return 0;
  *out = {static_cast<cnctrans_severity>(d->severity),
          d->code.c_str(),
          d->place.file.c_str(),
          d->place.line,
          d->place.column,
          d->place.end_line,
          d->place.end_column,
          d->message.c_str(),
          d->hint.c_str(),
          d->shown.c_str()};
  return 1;
}

}  // extern "C"
