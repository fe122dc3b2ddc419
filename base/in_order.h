// The parts of something long, made side by side and taken in their order.
#pragma once

#include <deque>
#include <future>
#include <thread>
#include <utility>

namespace cnctrans {

/// How many parts are worth making at once: the processors that this process may use, as far as anybody knows.
inline unsigned parts_at_once() {
#if defined(__EMSCRIPTEN__) && !defined(__EMSCRIPTEN_PTHREADS__)
  return 1;
#else
  const unsigned processors = std::thread::hardware_concurrency();
  return processors == 0 ? 1 : processors;
#endif
}

/// Calls `take(make(i))` for 0 to count - 1, in this order; `make` may run in other threads, and at most a few parts
/// ahead. False: a part was not taken (`take` gave false), and no further one is.
template <class Make, class Take>
bool in_order(std::size_t count, const Make& make, const Take& take) {
  const std::size_t at_once = count < 2 ? 1 : parts_at_once();
  const auto how = at_once == 1 ? std::launch::deferred : std::launch::async;
  std::deque<std::future<decltype(make(std::size_t{}))>> ahead;
  for (std::size_t next = 0, taken = 0; taken < count; ++taken) {
    for (; next < count && ahead.size() <= at_once; ++next) ahead.push_back(std::async(how, make, next));
    auto part = ahead.front().get();
    ahead.pop_front();
    if (!take(std::move(part))) return false;
  }
  return true;
}

}  // namespace cnctrans
