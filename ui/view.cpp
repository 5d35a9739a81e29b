#include "ui/view.h"

namespace encore::ui {

double FrameFigures::total_s() const {
  double total = 0.0;
  for (const auto& part : {animate_s, build_s, update_s, transfer_s, render_s}) {
    total += part.value_or(0.0);
  }
  return total;
}

}  // namespace encore::ui
