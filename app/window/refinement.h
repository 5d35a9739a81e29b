#pragma once

#include "app/window/pane_tracer.h"
#include "renderer/image.h"
#include "renderer/paths/progressive_image.h"
#include "renderer/renderer.h"
#include "ui/view.h"

#include <memory>
#include <optional>

namespace encore::app {

/// A picture of several rays a pixel that is drawn in parts of 1, 1, 2, 4, 8, … samples, so that
/// there is something to see at once and its error is known as it falls. Parts that would take long
/// are cut.
class Refinement {
 public:
  /// Begins a picture of so many samples a pixel; what there was is forgotten.
  void begin(int samples);
  /// The samples that are to be drawn next; nothing once all are there.
  [[nodiscard]] std::optional<SampleRange> next() const;
  /// Takes the picture of `samples`, which next() has named, drawn in `seconds`. `rays`: what it
  /// was made of, where that is known.
  void add(const renderer::Image& part, const SampleRange& samples, double seconds,
           const std::optional<renderer::RayFigures>& rays);

  /// The mean of all samples so far; null before the first part.
  [[nodiscard]] const std::shared_ptr<const renderer::Image>& picture() const { return picture_; }
  /// Its errors are renderer::ProgressiveImage's, each time that the samples have doubled.
  [[nodiscard]] const ui::RefinementView& view() const { return view_; }
  [[nodiscard]] bool complete() const { return view_.complete(); }
  /// Of all parts so far; nothing where one of them did not tell.
  [[nodiscard]] const std::optional<renderer::RayFigures>& rays() const { return rays_; }
  [[nodiscard]] double seconds() const { return seconds_; }

 private:
  ui::RefinementView view_;
  renderer::ProgressiveImage mean_;
  std::shared_ptr<const renderer::Image> picture_;
  std::optional<renderer::RayFigures> rays_;
  double seconds_ = 0.0;
};

}  // namespace encore::app
