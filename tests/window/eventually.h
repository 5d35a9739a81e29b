#pragma once

#include <chrono>
#include <string>
#include <thread>

namespace encore::test {

/// How long a person waits before they call a program stuck: a failsafe, not a promise of speed.
inline constexpr std::chrono::seconds kPatience{60};

/// Asks until the answer is yes. False if patience ended first.
template <class Condition>
bool eventually(const Condition& condition, std::chrono::milliseconds patience = kPatience) {
  const auto end = std::chrono::steady_clock::now() + patience;
  for (;;) {
    if (condition()) return true;
    if (std::chrono::steady_clock::now() >= end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(15));
  }
}

}  // namespace encore::test
