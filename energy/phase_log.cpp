#include "energy/phase_log.h"

#include <stdexcept>

namespace encore::energy {

std::string_view to_string(Phase phase) {
  switch (phase) {
    case Phase::animate:
      return "animate";
    case Phase::build:
      return "build";
    case Phase::update:
      return "update";
    case Phase::transfer:
      return "transfer";
    case Phase::render:
      return "render";
  }
  return "";
}

PhaseLog::PhaseLog(const Clock& clock, std::size_t capacity) : clock_(clock) {
  spans_.reserve(capacity);
}

void PhaseLog::begin(Phase phase) {
  if (is_open_) throw std::logic_error("a phase was marked inside another one");
  if (spans_.size() == spans_.capacity()) throw std::logic_error("the phase log is full");
  is_open_ = true;
  open_.phase = phase;
  if (listener_ != nullptr) {
    listener_->before(phase);
    listener_->began(phase, clock_.now());
  }
  // The clock is read last here and first in end(), so that nothing of the log is in the phase.
  open_.start = clock_.now();
}

void PhaseLog::end() {
  open_.end = clock_.now();
  is_open_ = false;
  spans_.push_back(open_);  // never allocates: begin() saw to it
  if (listener_ != nullptr) listener_->ended(open_.phase, open_.end);
}

}  // namespace encore::energy
