// A folder of programs: what is in it, what nobody there has, and what each answer would unlock.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "translator/files/names_file.h"
#include "translator/pipeline.h"
#include "translator/survey/look.h"

namespace cnctrans::translator {

struct SurveyOptions : InputOptions {
  std::string in;                ///< the folder
  std::string from, to;          ///< dialects; empty: each program's own is found; nothing is known of the target
  const Names* names = nullptr;  ///< what is answered already; may be null
  unsigned jobs = 1;
};

/// Something that is needed and not there.
struct Missing {
  Question::Kind kind = Question::Kind::routine;
  std::string name;
  std::size_t times = 0;
  std::size_t programs = 0;  ///< that need it
  std::size_t alone = 0;     ///< that need nothing else
  std::size_t unlocks = 0;   ///< programs that lack nothing once this and all before it are answered
  std::vector<std::string> arguments;
};

struct Survey {
  std::string error;  ///< usage: nothing was looked at
  std::vector<ProgramLook> programs;
  std::vector<Missing> missing;  ///< the order in which to answer: the most programs with the fewest answers
  std::size_t complete = 0;      ///< programs that lack nothing
};

Survey survey(const SurveyOptions& options, const std::function<void(std::size_t done, std::size_t all)>& progress);

/// What is missing, as entries of a file of names.
std::vector<Question> questions_of(const Survey& s);

std::string survey_text(const Survey& s, const SurveyOptions& options);
std::string survey_html(const Survey& s, const SurveyOptions& options);
std::string survey_programs_csv(const Survey& s);
std::string survey_missing_csv(const Survey& s);
std::string_view name(Question::Kind kind);

}  // namespace cnctrans::translator
