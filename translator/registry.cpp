#include "translator/registry.h"

#include "backends/fagor/backend.h"
#include "backends/linuxcnc/backend.h"
#include "backends/num/backend.h"
#include "backends/sinumerik/backend.h"
#include "dialects/num/gcodes.h"
#include "frontends/fagor/frontend.h"
#include "frontends/num/frontend.h"
#include "frontends/sinumerik/frontend.h"

namespace cnctrans::translator {

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
       backends::fagor::make_backend()},
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
       {"def"}},
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
