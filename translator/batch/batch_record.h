// Results of a batch on disk.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "translator/batch/batch.h"

namespace cnctrans::translator {

/// Name of the file with a program's result, in the folder of its outputs.
inline constexpr std::string_view record_name = "result.json";
/// Of the page about the program, beside it.
inline constexpr std::string_view report_name = "report.html";

std::string to_json(const BatchRecord& r);
std::optional<BatchRecord> read_record(const std::string& path);

/// The summary as HTML and CSV. `all`: programs below the input folder.
std::string summary_html(const std::vector<BatchRecord>& records, const BatchOptions& options, std::size_t all);
std::string summary_csv(const std::vector<BatchRecord>& records, std::size_t all);
std::string programs_csv(const std::vector<BatchRecord>& records);

}  // namespace cnctrans::translator
