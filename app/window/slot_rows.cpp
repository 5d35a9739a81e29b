#include "app/window/slot_rows.h"

#include <atomic>
#include <utility>

namespace encore::app {

namespace {

const std::atomic<bool> kNeverStopped{false};

/// What a row wants of a workload: its name.
class NamedConfiguration final : public energy::Workload {
 public:
  explicit NamedConfiguration(std::vector<energy::KeyValue> configuration)
      : configuration_(std::move(configuration)) {}
  [[nodiscard]] std::string name() const override { return {}; }
  [[nodiscard]] std::vector<energy::KeyValue> configuration() const override {
    return configuration_;
  }
  void prepare() override {}
  void operation(energy::PhaseLog&) override {}
  [[nodiscard]] std::vector<energy::Counter> counters(
      const energy::PerPhase<energy::Seconds>&) const override {
    return {};
  }

 private:
  std::vector<energy::KeyValue> configuration_;
};

energy::RunContext context_of(const PowerSet* power, const energy::Clock& clock) {
  energy::RunContext context{clock, energy::Seconds(0), kNeverStopped, {}, nullptr, {}, nullptr};
  if (power != nullptr && power->sampler) {
    context.sampler = power->sampler.get();
    context.total = power->total;
  }
  return context;
}

}  // namespace

struct SlotRows::Impl {
  Impl(const Slot& slot, std::shared_ptr<const PowerSet> set, const energy::Clock& clock,
       energy::Seconds least)
      : power(std::move(set)),
        context(context_of(power.get(), clock)),
        workload(slot.configuration),
        length(least),
        edges(context.sampler, nullptr),
        builder(context) {}

  std::shared_ptr<const PowerSet> power;
  energy::RunContext context;
  NamedConfiguration workload;
  energy::Seconds length;
  energy::PhaseProbe edges;
  energy::PhaseProbe no_edges{nullptr, nullptr};
  energy::RowBuilder builder;
  energy::PerPhase<std::uint64_t> counts{};
  energy::Seconds last_operation;
  bool begun = false;
};

SlotRows::SlotRows(const Slot& slot, std::shared_ptr<const PowerSet> power,
                   const energy::Clock& clock, energy::Seconds row)
    : impl_(std::make_unique<Impl>(slot, std::move(power), clock, row)) {}
SlotRows::~SlotRows() = default;

void SlotRows::begin() {
  if (impl_->begun) return;
  impl_->builder.start(std::max(impl_->length, impl_->last_operation));
  impl_->begun = true;
}

std::optional<energy::FrameRow> SlotRows::add(const Operation& operation, bool edges) {
  begin();
  for (const energy::PhaseSpan& span : operation.spans) impl_->edges.learn(span);
  impl_->last_operation = operation.ended - operation.began;
  impl_->builder.add(operation.spans, edges ? impl_->edges : impl_->no_edges, impl_->counts);
  if (operation.ended - impl_->builder.started() < impl_->length) return std::nullopt;
  return finish();
}

std::optional<energy::FrameRow> SlotRows::finish() {
  if (impl_->builder.empty()) return std::nullopt;
  impl_->begun = false;
  return impl_->builder.take(impl_->workload);
}

}  // namespace encore::app
