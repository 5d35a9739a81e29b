#include "ui/ui_state.h"

#include <utility>

namespace encore::ui {

void tell(UiState& state, std::string text, bool problem) {
  constexpr std::size_t kMost = 6;
  state.notices.push_back({std::move(text), problem, 0.0});
  while (state.notices.size() > kMost) state.notices.pop_front();
}

void remember(std::vector<std::string>& recent, const std::string& file, std::size_t most) {
  std::string first = file;  // `file` may be in the list
  std::erase(recent, first);
  recent.insert(recent.begin(), std::move(first));
  if (recent.size() > most) recent.resize(most);
}

}  // namespace encore::ui
