// Plain blocks of straight-line programs.
#pragma once

#include <memory>

#include "backends/common/stream_writer.h"

namespace cnctrans::backends::fagor {

std::unique_ptr<StreamWriter> make_stream(const WriteOptions& options);

}  // namespace cnctrans::backends::fagor
