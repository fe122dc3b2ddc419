// A page about many programs, of a batch or a project: how many of each state, what was said, a row a program.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace cnctrans::translator {

struct OverviewRow {
  std::string program, state;
  std::vector<std::string> cells;            ///< one for each column of the overview
  std::map<std::string, std::size_t> codes;  ///< of its errors and warnings, with how often
  std::string report;  ///< path of a page about it alone, below the overview; empty: there is none
  std::vector<std::pair<std::string, std::string>> details;  ///< a title, and a text that is shown when it is asked for
};

struct OverviewColumn {
  std::string title;
  bool number = false;
};

/// How often a code was said, in how many programs.
struct CodeCount {
  std::size_t programs = 0, times = 0;
};

/// One program more.
void count_codes(const std::map<std::string, std::size_t>& said, std::map<std::string, CodeCount>& codes);

struct Overview {
  std::string title, lead;          ///< plain text
  std::vector<std::string> states;  ///< in their order; those that no row has are left out
  std::vector<OverviewColumn> columns;
  std::vector<std::pair<std::string, std::map<std::string, CodeCount>>> codes;  ///< by the title of their table
  std::vector<OverviewRow> rows;
};

/// One HTML page that needs nothing else. Its table can be sorted and filtered; without scripts it is the whole table.
std::string overview_html(const Overview& o);

}  // namespace cnctrans::translator
