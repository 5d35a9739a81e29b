#pragma once

#include "scene/diagnostics.h"

#include <gtest/gtest.h>

#include <string>
#include <string_view>

namespace encore::test {

inline bool contains(std::string_view text, std::string_view part) {
  return text.find(part) != std::string_view::npos;
}

/// The message of the InputError that `action` throws; a failure if it throws none.
template <typename Action>
std::string error_of(const Action& action) {
  try {
    action();
  } catch (const scene::InputError& error) {
    return error.what();
  }
  ADD_FAILURE() << "no InputError was thrown";
  return {};
}

}  // namespace encore::test
