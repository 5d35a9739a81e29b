#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace encore::scene {

/// Input that cannot be used. what() is the whole message for the user:
/// "file[:line[:column]]: what is wrong; what to do". The program exits with code 3.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Things that were wrong but could be worked around; each names its place, as InputError does.
struct Warnings {
  std::vector<std::string> messages;

  void add(std::string message) { messages.push_back(std::move(message)); }
  void add(const Warnings& other) {
    messages.insert(messages.end(), other.messages.begin(), other.messages.end());
  }
};

}  // namespace encore::scene
