// Which offset of the translation each one of the source is.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "interpreter/trace/trace.h"

namespace cnctrans::verifier {

/// An offset of a tool has one number in the translation, all through, and that number is no other one's: D1 of tool 1
/// may be D11, but not D11 here and D12 there. That the number is the right one only the machine's tables can say.
class OffsetNumbers {
 public:
  using Event = interpreter::Event;
  OffsetNumbers(const std::vector<Event>& source, const std::vector<Event>& target) : a_(source), b_(target) {}
  /// Of two moves, each with a D of its program in force. Empty: they agree with those before.
  [[nodiscard]] std::string difference(const Event& a, const Event& b);

 private:
  struct Offset {
    std::string tool;  ///< number and name
    std::int32_t number = -1;
    bool operator==(const Offset&) const = default;
    bool operator<(const Offset& o) const { return std::tie(tool, number) < std::tie(o.tool, o.number); }
  };
  /// The offset in force at each event of a trace.
  struct Side {
    explicit Side(const std::vector<Event>& trace);
    [[nodiscard]] const Offset& at(const Event& e) const { return offsets[of_event[std::size_t(&e - first)]]; }
    const Event* first;
    std::vector<Offset> offsets{1};
    std::vector<std::uint32_t> of_event;
  };
  Side a_, b_;
  const Offset *last_a_ = nullptr, *last_b_ = nullptr;
  std::map<Offset, std::int32_t> there_, here_;
};

}  // namespace cnctrans::verifier
