#include "cli/man_page.h"

#include <CLI/CLI.hpp>

#include "translator/version.h"

namespace cnctrans::cli {

namespace {

/// Nothing of it is a request of roff: no backslash, no point or quote at the start of a line.
std::string plain(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if ((c == '.' || c == '\'') && (out.empty() || out.back() == '\n')) out += "\\&";
    if (c == '\\') {
      out += "\\e";
    } else if (c == '-') {
      out += "\\-";
    } else {
      out += c;
    }
  }
  return out;
}

void add_options(const CLI::App& app, std::string& out) {
  for (const auto* o : app.get_options()) {
    out += ".TP\n.B " + plain(o->get_name(o->get_positional(), true));
    const std::string type = o->get_type_size() == 0 ? "" : o->get_type_name();
    out += (type.empty() ? "" : " " + plain(type)) + "\n" + plain(o->get_description()) + "\n";
  }
}

/// The examples and exit statuses keep their lines.
void add_footer(const CLI::App& app, std::string& out) {
  if (!app.get_footer().empty()) out += ".PP\n.nf\n" + plain(app.get_footer()) + "\n.fi\n";
}

}  // namespace

std::string man_page(const CLI::App& app) {
  std::string out = ".TH CNCTRANS 1 \"\" \"cnctrans " + std::string(translator::version) + "\" \"User Commands\"\n";
  out += ".SH NAME\ncnctrans \\- translate CNC part programs between controls\n.SH SYNOPSIS\n.B cnctrans\n";
  out +=
      "[\\fICOMMAND\\fR] [\\fIOPTION\\fR]... \\fIFILE\\fR...\n.SH DESCRIPTION\n" + plain(app.get_description()) + "\n";
  add_footer(app, out);
  out += ".SH OPTIONS\n";
  add_options(app, out);
  for (const auto* sub : app.get_subcommands({})) {
    out += ".SH \"CNCTRANS " + plain(CLI::detail::to_lower(sub->get_name())) + "\"\n" + plain(sub->get_description()) +
           "\n";
    add_options(*sub, out);
    add_footer(*sub, out);
  }
  return out;
}

}  // namespace cnctrans::cli
