// Work in a process of its own.
#ifndef _WIN32
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <utility>

#include "base/os/os.h"

namespace cnctrans::os {

struct Child::State {
  pid_t id = -1;
  std::FILE* in = nullptr;  ///< what it writes
  std::optional<End> end;
};

Child::Child() : state_(std::make_unique<State>()) {}
Child::Child(Child&&) noexcept = default;

Child::~Child() {
  if (state_ != nullptr) (void)ended(true);
}

Child& Child::operator=(Child&& other) noexcept {
  if (state_ != nullptr) (void)ended(true);
  state_ = std::move(other.state_);
  return *this;
}

bool Child::begin(const Work& work, std::optional<std::chrono::seconds> most) {
  (void)ended(true);
  *state_ = {};
  std::array<int, 2> ends{};
  if (::pipe(ends.data()) != 0) return false;
  state_->id = ::fork();
  if (state_->id == 0) {
    ::close(ends[0]);
    if (most) ::alarm(static_cast<unsigned>(most->count()));
    std::FILE* const out = ::fdopen(ends[1], "w");
    const bool good = out != nullptr && work(out) && std::fclose(out) == 0;
    ::_exit(good ? 0 : 1);
  }
  ::close(ends[1]);
  if (state_->id > 0) state_->in = ::fdopen(ends[0], "r");
  if (state_->in == nullptr) ::close(ends[0]);
  return state_->in != nullptr;
}

bool Child::begun() const {
  return state_->id > 0 || state_->end;
}

std::FILE* Child::written() const {
  return state_->in;
}

std::optional<Child::End> Child::ended(bool wait) {
  if (state_->end || state_->id <= 0) return state_->end;
  if (wait && state_->in != nullptr) std::fclose(std::exchange(state_->in, nullptr));  // else it waits for a reader
  int status = 0;
  if (::waitpid(state_->id, &status, wait ? 0 : WNOHANG) == 0) return std::nullopt;
  if (state_->in != nullptr) std::fclose(std::exchange(state_->in, nullptr));
  state_->id = -1;
  state_->end = End{WIFEXITED(status) && WEXITSTATUS(status) == 0, WIFSIGNALED(status) ? WTERMSIG(status) : 0};
  return state_->end;
}

void Child::kill() {
  if (state_->id <= 0) return;
  ::kill(state_->id, SIGKILL);
  (void)ended(true);
}

}  // namespace cnctrans::os
#endif
