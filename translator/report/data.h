// The data of a report as JSON text, for the JSON form and for the page. Only for the .cpp files of this folder.
#pragma once

#include <string>

#include "translator/report/report.h"

namespace cnctrans::translator {

std::string report_data(const Report& r, bool with_paths);

}  // namespace cnctrans::translator
