#include "tests/splice/watch.h"

#include <sys/time.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstring>

extern "C" void __sanitizer_set_death_callback(void (*)()) __attribute__((weak));

namespace cnctrans::splice {

namespace {

constexpr int most_seconds = 30;  ///< for one program: more is a hang

const char* test_name = "";
char now[1 << 16];  ///< what runs now

void say_now() {
  const auto ignored = write(STDERR_FILENO, now, std::strlen(now));
  (void)ignored;
}
void die(int signal) {
  say_now();
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

}  // namespace

void watch_for_crashes(const char* test) {
  test_name = test;
  for (const int signal : {SIGSEGV, SIGABRT, SIGFPE, SIGBUS, SIGILL, SIGPROF}) std::signal(signal, die);
  if (__sanitizer_set_death_callback != nullptr) __sanitizer_set_death_callback(say_now);
}

void begins(const std::string& what, const std::string& program) {
  std::snprintf(now, sizeof now, "\n%s: crashed, or took more than %d s: %s\n%s", test_name, most_seconds, what.c_str(),
                program.c_str());
  const itimerval timer{{0, 0}, {most_seconds, 0}};  // of the processor: a busy machine is no hang
  setitimer(ITIMER_PROF, &timer, nullptr);
}

}  // namespace cnctrans::splice
