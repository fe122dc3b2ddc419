#include "translator/files/tool_file.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>

#include "base/source.h"
#include "base/text.h"

namespace cnctrans::translator {

namespace {

using machine::Tool;

std::vector<std::string_view> lines_of(std::string_view text) {
  std::vector<std::string_view> lines;
  SourceLine l;
  while (take_line(text, l)) lines.push_back(l.text);
  return lines;
}

std::string place(std::size_t line) {
  return "line " + std::to_string(line + 1) + ": ";
}

/// A number with a point or, where the columns are parted otherwise, a comma.
std::optional<double> number_of(std::string_view text, bool comma = false) {
  std::string plain(trim(text));
  if (comma) std::replace(plain.begin(), plain.end(), ',', '.');
  if (!plain.empty() && plain.front() == '+') plain.erase(0, 1);
  return parse_decimal(plain);
}

std::optional<std::int32_t> count_of(std::optional<double> n) {
  if (!n || *n < 0 || *n > std::numeric_limits<std::int32_t>::max() || std::floor(*n) != *n) return std::nullopt;
  return static_cast<std::int32_t>(*n);
}

// ---- what a field is called --------------------------------------------------------------------------------------

enum class Field : std::uint8_t {
  number,
  name,
  radius,
  diameter,
  length,
  length_x,
  nose,
  nose_width,
  offset,
  passed_over
};

std::optional<Field> field_of(std::string_view title) {
  static const std::map<std::string, Field, std::less<>> fields{{"NUMBER", Field::number},
                                                                {"T", Field::number},
                                                                {"TOOL", Field::number},
                                                                {"NO", Field::number},
                                                                {"NR", Field::number},
                                                                {"NAME", Field::name},
                                                                {"RADIUS", Field::radius},
                                                                {"R", Field::radius},
                                                                {"DIAMETER", Field::diameter},
                                                                {"DIA", Field::diameter},
                                                                {"LENGTH", Field::length},
                                                                {"L", Field::length},
                                                                {"Z", Field::length},
                                                                {"LENGTH_Z", Field::length},
                                                                {"LENGTH_X", Field::length_x},
                                                                {"X", Field::length_x},
                                                                {"NOSE", Field::nose},
                                                                {"QUADRANT", Field::nose},
                                                                {"WIDTH", Field::nose_width},
                                                                {"NOSE_WIDTH", Field::nose_width},
                                                                {"OFFSET", Field::offset},
                                                                {"D", Field::offset},
                                                                {"EDGE", Field::offset},
                                                                {"TYPE", Field::passed_over},
                                                                {"COMMENT", Field::passed_over},
                                                                {"REMARK", Field::passed_over},
                                                                {"TEXT", Field::passed_over}};
  const auto it = fields.find(to_upper_ascii(trim(title)));
  return it == fields.end() ? std::nullopt : std::optional(it->second);
}

/// Empty: done; else why not.
std::string set_field(Tool& tool, Field field, std::string_view text, bool comma) {
  if (field == Field::passed_over || trim(text).empty()) return {};
  if (field == Field::name) {
    tool.name = std::string(trim(text));
    return {};
  }
  const auto n = number_of(text, comma);
  if (!n) return "a number is wanted, not '" + std::string(trim(text)) + "'";
  switch (field) {
    case Field::number:
    case Field::nose:
    case Field::offset: {
      const auto whole = count_of(n);
      if (!whole) return "a whole number is wanted, not '" + std::string(trim(text)) + "'";
      (field == Field::number ? tool.number : field == Field::nose ? tool.nose : tool.offset) = *whole;
      break;
    }
    case Field::radius: tool.radius = *n; break;
    case Field::diameter: tool.radius = *n / 2; break;
    case Field::length: tool.length = *n; break;
    case Field::length_x: tool.length_x = *n; break;
    case Field::nose_width: tool.nose_width = *n; break;
    case Field::name:
    case Field::passed_over: break;
  }
  return {};
}

// ---- forms -------------------------------------------------------------------------------------------------------

bool parse_json_tools(std::string_view text, std::vector<Tool>& out, std::string* error) {
  const auto file = nlohmann::json::parse(text.begin(), text.end(), nullptr, false);
  const auto& list = file.is_object() && file.contains("tools") ? file["tools"] : file;
  if (!list.is_array()) {
    *error = R"(a list of tools is wanted, or an object with "tools")";
    return false;
  }
  for (const auto& item : list) {
    Tool tool;
    if (!item.is_object()) {
      *error = "a tool is an object such as {\"number\": 1, \"radius\": 5}";
      return false;
    }
    for (const auto& [key, value] : item.items()) {
      const auto field = field_of(key);
      if (!field) {
        *error = "\"" + key + "\" of a tool is not known";
        return false;
      }
      const std::string word = value.is_string() ? value.get<std::string>() : value.is_null() ? "" : value.dump();
      if (const auto why = set_field(tool, *field, word, false); !why.empty()) {
        *error = "\"" + key + "\" of a tool: " + why;
        return false;
      }
    }
    out.push_back(std::move(tool));
  }
  return true;
}

std::vector<std::string> cells(std::string_view line, char by) {
  std::vector<std::string> out(1);
  bool quoted = false;
  for (const char c : line) {
    if (c == '"') {
      quoted = !quoted;
    } else if (c == by && !quoted) {
      out.emplace_back();
    } else {
      out.back() += c;
    }
  }
  return out;
}

bool parse_csv(const std::vector<std::string_view>& lines, std::vector<Tool>& out, std::string* error) {
  std::vector<Field> columns;
  char by = ',';
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const auto line = trim(lines[i]);
    if (line.empty() || line.front() == '#') continue;
    if (columns.empty()) {
      for (const char c : {';', '\t'}) {
        if (line.find(c) != std::string_view::npos) by = c;
      }
      for (const auto& title : cells(line, by)) {
        const auto field = field_of(title);
        if (!field) {
          *error = place(i) + "the column '" + std::string(trim(title)) +
                   "' is not known: number, name, radius, diameter, length, length_x, nose, width, offset, type";
          return false;
        }
        columns.push_back(*field);
      }
      continue;
    }
    Tool tool;
    const auto row = cells(line, by);
    if (row.size() > columns.size()) {
      *error = place(i) + "more values than columns";
      return false;
    }
    for (std::size_t c = 0; c < row.size(); ++c) {
      if (const auto why = set_field(tool, columns[c], row[c], by != ','); !why.empty()) {
        *error = place(i) + why;
        return false;
      }
    }
    out.push_back(std::move(tool));
  }
  if (!columns.empty()) return true;
  *error = "there is nothing in it";
  return false;
}

/// The values of a `$TC_...` table: by name, tool and edge.
using ToolData = std::map<std::pair<std::int32_t, std::int32_t>, std::map<std::int32_t, double>>;

/// `$TC_DP6[2,1]=5`: parameter 6 of edge 1 of tool 2. Lines of other data are passed over.
bool parse_tool_data(const std::vector<std::string_view>& lines, std::vector<Tool>& out, std::string* error) {
  ToolData data;
  std::map<std::int32_t, std::string> names;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::string line = to_upper_ascii(lines[i]);
    const auto at = line.find("$TC_");
    const auto open = line.find('[', at), close = line.find(']', open), equals = line.find('=', close);
    if (at == std::string::npos || equals == std::string::npos) continue;
    const std::string name = line.substr(at, open - at);
    const auto index = cells(line.substr(open + 1, close - open - 1), ',');
    const auto tool = count_of(number_of(index[0]));
    const std::string_view value = trim(lines[i].substr(equals + 1));
    if (name == "$TC_TP2" && tool) {
      names[*tool] = std::string(trim(value.substr(0, value.find(';'))));
      std::erase(names[*tool], '"');
      continue;
    }
    if (!name.starts_with("$TC_DP") || index.size() != 2) continue;
    const auto parameter = count_of(number_of(name.substr(6)));
    const auto edge = count_of(number_of(index[1]));
    const auto n = number_of(value.substr(0, value.find(';')));
    if (!tool || !edge || !n) {
      *error = place(i) + "a number is wanted in " + std::string(trim(lines[i]));
      return false;
    }
    if (parameter) data[{*tool, *edge}][*parameter] = *n;
  }
  for (auto& [key, parameters] : data) {
    auto& p = parameters;
    if (!out.empty() && out.back().number == key.first) continue;  // the first edge stands for the tool
    Tool t;
    t.number = key.first;
    t.offset = key.second;
    t.name = names[key.first];
    if (t.name == std::to_string(t.number)) t.name.clear();
    const auto length = [&p](int n) { return p[2 + n] + p[11 + n] + p[20 + n]; };
    const bool turning = p[1] >= 400 && p[1] < 600;
    t.radius = p[6] + p[15];
    t.length = turning ? length(2) : length(1);
    t.length_x = turning ? length(1) : 0;
    t.nose = turning ? static_cast<std::int32_t>(p[2]) : 0;
    out.push_back(std::move(t));
  }
  return true;
}

/// `D1 R5 L82.5 I0 K-0.02`, `T3 D2`, `TOR1=5`, `E52001=12500` (in 0.001 mm): rows of the offset table of a control.
class OffsetTable {
 public:
  explicit OffsetTable(bool lathe) : lathe_(lathe) {}

  bool line(std::string_view text) {
    std::string line;
    for (const char c : to_upper_ascii(text)) {
      if (c != ' ' && c != '\t' && c != '(' && c != ')' && c != ':') line += c;
    }
    if (line.empty() || line[0] == ';' || line[0] == '%') return true;
    if (line[0] == 'N') line.erase(0, std::min(line.find_first_not_of("0123456789", 1), line.size()));
    return variable(line) || thousandths(line) || row(line);
  }

  std::vector<Tool> tools() {
    std::vector<Tool> out;
    for (const auto& [number, offset] : tools_) {
      if (rows_.count(offset) == 0) continue;
      out.push_back(tool(number, offset));
    }
    for (const auto& r : rows_) {  // a row that no tool names is the tool of its number
      const auto named = [&r](const auto& t) { return t.second == r.first || t.first == r.first; };
      if (std::none_of(tools_.begin(), tools_.end(), named)) out.push_back(tool(r.first, r.first));
    }
    return out;
  }

 private:
  Tool tool(std::int32_t number, std::int32_t offset) {
    auto& r = rows_[offset];
    Tool t;
    t.number = number;
    t.offset = offset;
    const auto wear = lathe_ ? 0 : r['I'];
    t.radius = r['R'] + wear;
    t.length = lathe_ ? r['Z'] + r['K'] : r['L'] + r['K'];
    t.length_x = lathe_ ? r['X'] + r['I'] : 0;
    t.nose = static_cast<std::int32_t>(r['F']);
    return t;
  }
  /// TOR1=5.
  bool variable(const std::string& line) {
    const auto equals = line.find('=');
    if (!line.starts_with("TO") || equals == std::string::npos || equals < 4) return false;
    const auto number = count_of(number_of(line.substr(3, equals - 3)));
    const auto value = number_of(line.substr(equals + 1));
    if (!number || !value) return false;
    rows_[*number][line[2]] = *value;
    return true;
  }
  /// E52001=12500: 50 length (of X), 51 length Z, 52 radius, 53 and 54 what is added to the lengths.
  bool thousandths(const std::string& line) {
    const auto equals = line.find('=');
    if (line.size() < 7 || !line.starts_with("E5") || equals != 6) return false;
    const auto row = count_of(number_of(line.substr(3, 3)));
    const auto value = number_of(line.substr(equals + 1));
    if (!row || !value) return false;
    constexpr double per_mm = 1000;
    const char column = line[2];
    if (column == '0') rows_[*row][lathe_ ? 'X' : 'L'] = *value / per_mm;
    if (column == '1' && lathe_) rows_[*row]['Z'] = *value / per_mm;
    if (column == '2') rows_[*row]['R'] = *value / per_mm;
    if (column == '3') rows_[*row][lathe_ ? 'I' : 'K'] = *value / per_mm;
    if (column == '4') rows_[*row][lathe_ ? 'K' : 'I'] = *value / per_mm;
    if (column == '5') rows_[*row]['F'] = *value;
    return true;
  }
  /// Letters with numbers behind a D, or a tool with its D.
  bool row(const std::string& line) {
    std::map<char, double> words;
    for (std::size_t at = 0; at < line.size();) {
      const char letter = line[at];
      const auto end = std::min(line.find_first_not_of("0123456789.+-", at + 1), line.size());
      const auto n = number_of(std::string_view(line).substr(at + 1, end - at - 1));
      if (letter < 'A' || letter > 'Z' || !n) return false;
      words[letter] = *n;
      at = end;
    }
    const auto d = words.count('D') != 0 ? count_of(words['D']) : std::nullopt;
    const auto t = words.count('T') != 0 ? count_of(words['T']) : std::nullopt;
    if (!d) return false;
    if (t) tools_[*t] = *d;
    const bool only_tool = t && words.size() == 2;
    if (only_tool) return true;
    for (const auto& [letter, value] : words) {
      if (letter != 'D' && letter != 'T') rows_[*d][letter] = value;
    }
    return true;
  }

  bool lathe_;
  std::map<std::int32_t, std::map<char, double>> rows_;
  std::map<std::int32_t, std::int32_t> tools_;  ///< tool -> row
};

/// A first line with a column's title and no number in front.
bool is_csv(const std::vector<std::string_view>& lines) {
  for (const auto& line : lines) {
    const auto text = trim(line);
    if (text.empty() || text.front() == '#') continue;
    const char by = text.find(';') != std::string_view::npos    ? ';'
                    : text.find('\t') != std::string_view::npos ? '\t'
                                                                : ',';
    const auto titles = cells(text, by);
    return titles.size() > 1 && field_of(titles.front()).has_value();
  }
  return false;
}

}  // namespace

std::optional<ToolFile> parse_tools(std::string_view text, bool lathe, std::string* error) {
  ToolFile file;
  const auto lines = lines_of(text);
  const auto first = text.find_first_not_of(" \t\r\n");
  bool good = false;
  if (first != std::string_view::npos && (text[first] == '{' || text[first] == '[')) {
    file.form = "JSON";
    good = parse_json_tools(text, file.tools, error);
  } else if (to_upper_ascii(text).find("$TC_DP") != std::string::npos) {
    file.form = "$TC_DP data";
    good = parse_tool_data(lines, file.tools, error);
  } else if (is_csv(lines)) {
    file.form = "CSV";
    good = parse_csv(lines, file.tools, error);
  } else {
    file.form = "offset table";
    OffsetTable table(lathe);
    good = true;
    for (std::size_t i = 0; good && i < lines.size(); ++i) {
      if (table.line(lines[i])) continue;
      good = false;
      *error = place(i) + "'" + std::string(trim(lines[i])) +
               "' is no row of tools: a CSV list has titles such as number,radius,length in its first line";
    }
    file.tools = table.tools();
  }
  if (good && file.tools.empty()) {
    *error = "no tool is in it";
    good = false;
  }
  for (const auto& t : file.tools) {
    if (!good) break;
    good = t.number >= 0 && (t.number != 0 || !t.name.empty()) && t.radius >= 0;
    if (!good)
      *error = t.radius < 0 ? "tool " + std::to_string(t.number) + " has a negative radius"
                            : std::string("a tool has neither number nor name");
  }
  if (!good) return std::nullopt;
  return file;
}

std::optional<ToolFile> read_tools(const std::string& path, bool lathe, std::string* error) {
  const SourcePtr text = SourceText::open(path, error);
  if (!text) return std::nullopt;
  auto file = parse_tools(text->text(), lathe, error);
  if (!file) *error = path + ": " + *error;
  return file;
}

void put_tools(const std::vector<machine::Tool>& tools, machine::Profile& profile) {
  for (const auto& t : tools) {
    const auto same = [&t](const Tool& old) {
      return t.number != 0 ? old.number == t.number : !t.name.empty() && old.name == t.name;
    };
    std::erase_if(profile.tools, same);
    profile.tools.push_back(t);
  }
}

}  // namespace cnctrans::translator
