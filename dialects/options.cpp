#include "dialects/options.h"

#include "dialects/fagor/options.h"
#include "dialects/num/options.h"
#include "dialects/sinumerik/options.h"

namespace cnctrans::dialects {

const machine::OptionTable& options() {
  static constexpr auto fagor_rows = machine::specs_of(fagor::option_rows);
  static constexpr auto num_rows = machine::specs_of(num::option_rows);
  static constexpr auto sinumerik_rows = machine::specs_of(sinumerik::option_rows);
  static const machine::OptionTable table({fagor_rows, fagor::shared_option_rows, num_rows, num::shared_option_rows,
                                           sinumerik_rows, sinumerik::shared_option_rows});
  return table;
}

std::optional<machine::Profile> load_profile(const std::string& name_or_path, std::string* error) {
  return machine::load(name_or_path, options(), error);
}

std::optional<machine::Profile> profile_of(std::string_view json, std::string* error) {
  return machine::from_json(json, options(), error);
}

}  // namespace cnctrans::dialects
