#pragma once

#include "energy/clock.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace encore::energy {

/// The kinds of work whose time (and energy) is told apart.
enum class Phase : std::uint8_t { animate, build, update, transfer, render };
inline constexpr std::size_t kPhaseCount = 5;
inline constexpr std::array<Phase, kPhaseCount> kPhases = {
    Phase::animate, Phase::build, Phase::update, Phase::transfer, Phase::render};

/// The words exactly as files hold them.
std::string_view to_string(Phase phase);

/// One value a phase, indexed by the phase.
template <class T>
struct PerPhase : std::array<T, kPhaseCount> {
  using Base = std::array<T, kPhaseCount>;
  T& operator[](Phase phase) { return Base::operator[](static_cast<std::size_t>(phase)); }
  const T& operator[](Phase phase) const {
    return Base::operator[](static_cast<std::size_t>(phase));
  }
};

/// A stretch of time that one phase took, in the clock's seconds.
struct PhaseSpan {
  Phase phase = Phase::render;
  Seconds start;
  Seconds end;
};

/// Is told of phases as they begin and end, on the thread that marks them.
class PhaseListener {
 public:
  virtual ~PhaseListener() = default;
  /// Before the phase's time starts to count.
  virtual void before(Phase phase) = 0;
  virtual void began(Phase phase, Seconds now) = 0;
  virtual void ended(Phase phase, Seconds now) = 0;
};

/// Records which phase ran when. A mark costs two readings of the clock and one store: memory is
/// set aside beforehand.
///
///   {
///     const auto mark = log.mark(Phase::build);
///     structure.build(triangles);
///   }
class PhaseLog {
 public:
  /// Ends its phase when it goes out of scope.
  class [[nodiscard]] Mark {
   public:
    ~Mark() { log_.end(); }
    Mark(const Mark&) = delete;
    Mark& operator=(const Mark&) = delete;

   private:
    friend class PhaseLog;
    Mark(PhaseLog& log, Phase phase) : log_(log) { log_.begin(phase); }
    PhaseLog& log_;
  };

  /// `capacity`: the most marks between two clear(); the clock must outlive the log.
  explicit PhaseLog(const Clock& clock, std::size_t capacity = 64);

  /// Tells `listener` of each phase from now on (null: nobody). It must outlive the log's marks.
  void tell(PhaseListener* listener) { listener_ = listener; }

  /// Starts a phase. Throws std::logic_error if another one is still open (phases do not nest) or
  /// the capacity is used up.
  Mark mark(Phase phase) { return {*this, phase}; }

  /// The finished phases since the last clear(), in order.
  [[nodiscard]] std::span<const PhaseSpan> spans() const { return spans_; }
  void clear() { spans_.clear(); }

 private:
  void begin(Phase phase);
  void end();

  const Clock& clock_;
  std::vector<PhaseSpan> spans_;
  PhaseSpan open_;
  bool is_open_ = false;
  PhaseListener* listener_ = nullptr;
};

}  // namespace encore::energy
