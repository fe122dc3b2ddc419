#include "translator/files/registry.h"

#include <algorithm>

#include "backends/fagor/backend.h"
#include "backends/heidenhain/backend.h"
#include "backends/linuxcnc/backend.h"
#include "backends/num/backend.h"
#include "backends/sinumerik/backend.h"
#include "dialects/num/gcodes.h"
#include "dialects/sinumerik/beside.h"
#include "frontends/fagor/program/frontend.h"
#include "frontends/heidenhain/program/frontend.h"
#include "frontends/num/program/frontend.h"
#include "frontends/sinumerik/program/frontend.h"

namespace cnctrans::translator {

namespace {

/// The program 12 is the file 000012.PIM.
std::string fagor_file(std::string_view name, bool lathe) {
  constexpr std::size_t digits = 6;
  return std::string(digits - std::min(digits, name.size()), '0') + std::string(name) + (lathe ? ".PIT" : ".PIM");
}

/// The file of `/_N_WKS_DIR/_N_JOB_WPD/_N_LOG_MPF` is LOG.MPF; a name without a type is one of a main program.
std::string sinumerik_file(std::string_view name, bool /*lathe*/) {
  if (const auto slash = name.rfind('/'); slash != std::string_view::npos) name.remove_prefix(slash + 1);
  if (name.starts_with("_N_")) name.remove_prefix(3);
  constexpr std::size_t type = 4;  // _MPF
  const bool typed = name.size() > type && name[name.size() - type] == '_';
  const std::string_view extension = typed ? name.substr(name.size() - type + 1) : std::string_view("MPF");
  return std::string(typed ? name.substr(0, name.size() - type) : name) + '.' + std::string(extension);
}

std::string sinumerik_definition(std::string_view name, const std::vector<std::int64_t>& sizes) {
  std::string list;
  for (const auto n : sizes) list += (list.empty() ? "" : ",") + std::to_string(n);
  return "DEF CHAN REAL " + std::string(name) + (list.empty() ? "" : '[' + list + ']');
}

}  // namespace

const std::vector<Dialect>& dialects() {
  static const std::vector<Dialect> all{
      {"fagor",
       "Fagor 8055",
       {"pim"},
       {"pit"},
       {},
       1,
       "",
       ';',
       0,
       {{151, 152}, {"DIAM"}, {96}},
       {{12, 'Y'}},
       frontends::fagor::make_frontend(),
       backends::fagor::make_backend(),
       {},
       fagor_file},
      {"num",
       "NUM 760/1060",
       {},
       {},
       {"xpi", "num", "nc", "txt"},
       0,
       "",
       '(',
       ')',
       {dialects::num::lathe_codes(), {}, {96}},
       {},
       frontends::num::make_frontend(),
       backends::num::make_backend()},
      {"sinumerik",
       "Sinumerik 840D sl / 828D",
       {},
       {},
       {"mpf", "spf", "arc"},
       0,
       "L",
       ';',
       0,
       {{}, {"DIAMON", "DIAMONA", "DIAM90", "DIAM90A"}, {96}, {"LIMS"}},
       {},
       frontends::sinumerik::make_frontend(),
       backends::sinumerik::make_backend(),
       {"def"},
       sinumerik_file,
       sinumerik_definition,
       sinumerik::beside_datum,
       sinumerik::is_setting},
      {"heidenhain",
       "Heidenhain iTNC 530",
       {"h"},
       {},
       {},
       0,
       "",
       ';',
       0,
       {},
       {},
       frontends::heidenhain::make_frontend(),
       backends::heidenhain::make_backend()},
      {"linuxcnc",
       "LinuxCNC (written only)",
       {},
       {},
       {"ngc"},
       0,
       "",
       ';',
       0,
       {},
       {},
       nullptr,
       backends::linuxcnc::make_backend()},
  };
  return all;
}

const Dialect* find_dialect(std::string_view name) {
  for (const auto& d : dialects()) {
    if (d.name == name) return &d;
  }
  return nullptr;
}

}  // namespace cnctrans::translator
