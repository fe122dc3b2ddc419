#include "translator/batch/batch_record.h"

#include <fstream>
#include <nlohmann/json.hpp>

namespace cnctrans::translator {

std::string to_json(const BatchRecord& r) {
  nlohmann::ordered_json j{
      {"program", r.program}, {"status", r.status}, {"detail", r.detail}, {"max_length", r.max_length},
      {"moves", r.moves},     {"lines", r.lines},   {"errors", r.errors}, {"warnings", r.warnings},
      {"outputs", r.outputs}, {"read", r.read},     {"job", r.job}};
  if (!r.report.empty()) j["report"] = r.report;
  return j.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

std::optional<BatchRecord> read_record(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) return std::nullopt;
  const auto j = nlohmann::json::parse(in, nullptr, false);
  if (!j.is_object()) return std::nullopt;
  BatchRecord r;
  const auto take = [&j](const char* key, auto& value) {
    const auto it = j.find(key);
    if (it == j.end()) return false;
    using Wanted = std::decay_t<decltype(value)>;
    try {
      value = it->get<Wanted>();
    } catch (const nlohmann::json::exception&) {
      return false;
    }
    return true;
  };
  const bool good = take("program", r.program) && take("status", r.status) && take("detail", r.detail) &&
                    take("max_length", r.max_length) && take("moves", r.moves) && take("lines", r.lines) &&
                    take("errors", r.errors) && take("warnings", r.warnings) && take("outputs", r.outputs) &&
                    take("read", r.read) && take("job", r.job);
  (void)take("report", r.report);
  return good ? std::optional(std::move(r)) : std::nullopt;
}

}  // namespace cnctrans::translator
