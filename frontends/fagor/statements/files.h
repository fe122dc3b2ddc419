// OPEN and WRITE: a program writes another one (12.8).
#pragma once

#include <optional>
#include <string>

#include "frontends/common/syntax.h"
#include "frontends/fagor/state/state.h"

namespace cnctrans::fagor {

/// `(OPEN P12, A|D, "comment")`; `source`: the statement as it was written. None: reported.
std::optional<ir::Message> lower_open(const syntax::Statement& s, std::string source, LowerState& state);
/// `(WRITE text)`: the parameters of the text are read when the line is written.
std::optional<ir::Message> lower_write(const syntax::Statement& s, std::string source, LowerState& state);

}  // namespace cnctrans::fagor
