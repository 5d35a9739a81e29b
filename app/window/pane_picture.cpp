#include "app/window/pane_picture.h"

#include "app/window/heatmap_colors.h"
#include "renderer/difference_image.h"
#include "renderer/image_diff.h"
#include "renderer/overlay/screen_texture.h"

#include <algorithm>
#include <utility>

namespace encore::app {

bool PanePicture::wants_counters(const PaneTracer& tracer, const PaneRequest& request) {
  return request.content == ui::PaneContent::heatmap && request.device &&
         traces_rays(*request.device) && tracer.scene() != nullptr;
}

bool PanePicture::wants_hits(const PaneTracer& tracer, const PaneRequest& request) {
  return request.hits && request.device && traces_rays(*request.device) &&
         tracer.scene() != nullptr;
}

bool PanePicture::whole(const PaneTracer& tracer, const PaneRequest& request) const {
  const Made wanted{tracer.content_serial(), request.camera, request.width, request.height};
  return image_made_ == wanted && complete_ &&
         (!wants_counters(tracer, request) || counters_made_ == wanted) &&
         (!wants_hits(tracer, request) || hits_made_ == wanted);
}

bool PanePicture::draw(PaneTracer& tracer, const PaneRequest& request, const Made& wanted,
                       energy::PhaseLog& log, const std::atomic<bool>* cancel) {
  // Whoever looks at a coarse picture wants it soon.
  const bool coarse = wanted.width < request.width || wanted.height < request.height;
  std::optional<SampleRange> samples;
  if (coarse && tracer.samples() > 1) samples = SampleRange{0, 1};
  if (!tracer.draw(request.camera, wanted.width, wanted.height, log, cancel, samples)) return false;
  auto image = std::make_shared<renderer::Image>();
  image->resize(wanted.width, wanted.height);
  tracer.renderer()->read(*image);
  image_ = std::move(image);
  refined_ = false;
  complete_ = !samples;
  return true;
}

bool PanePicture::refine(PaneTracer& tracer, const PaneRequest& request, const Made& wanted,
                         energy::PhaseLog& log, const std::atomic<bool>* cancel) {
  if (image_made_ != wanted || !refined_) {
    refinement_.begin(tracer.samples());
    refined_ = false;
  }
  const auto samples = refinement_.next();
  if (!samples) return true;
  const std::size_t marks = log.spans().size();
  if (!tracer.draw(request.camera, wanted.width, wanted.height, log, cancel, samples)) return false;
  double seconds = 0.0;
  for (const energy::PhaseSpan& span : log.spans().subspan(marks)) {
    seconds += (span.end - span.start).value;
  }
  renderer::Image part;
  part.resize(wanted.width, wanted.height);
  tracer.renderer()->read(part);
  refinement_.add(part, *samples, seconds, tracer.renderer()->last_rays());
  image_ = refinement_.picture();
  refined_ = true;
  complete_ = refinement_.complete();
  return true;
}

bool PanePicture::trace(PaneTracer& tracer, const PaneRequest& request, int divisor,
                        energy::PhaseLog& log, const std::atomic<bool>* cancel) {
  const Made wanted{tracer.content_serial(), request.camera, std::max(request.width / divisor, 1),
                    std::max(request.height / divisor, 1)};
  drew_ = false;
  wanted_width_ = request.width;
  wanted_height_ = request.height;
  const auto cancelled = [cancel] {
    return cancel != nullptr && cancel->load(std::memory_order_relaxed);
  };
  if (image_made_ != wanted || (divisor == 1 && !complete_)) {
    const bool parts = divisor == 1 && tracer.samples() > 1;
    if (!(parts ? refine(tracer, request, wanted, log, cancel)
                : draw(tracer, request, wanted, log, cancel))) {
      return false;
    }
    image_made_ = wanted;
    drew_ = true;
  }
  if (wants_counters(tracer, request) && counters_made_ != wanted) {
    if (cancelled()) return false;
    tracer.tracer()->trace_counters(request.camera, wanted.width, wanted.height, counters_);
    counters_made_ = wanted;
    colored_.reset();
  }
  if (divisor == 1 && wants_hits(tracer, request) && hits_made_ != wanted) {
    if (cancelled()) return false;
    std::vector<scene::Hit> hits;
    tracer.tracer()->trace_hits(request.camera, wanted.width, wanted.height, hits);
    keep_hits(hits);
    hits_made_ = wanted;
    colored_.reset();
  }
  return true;
}

void PanePicture::take_drawn(PaneTracer& tracer, const PaneRequest& request) {
  auto image = std::make_shared<renderer::Image>();
  image->resize(request.width, request.height);
  tracer.renderer()->read(*image);
  image_ = std::move(image);
  image_made_ = {tracer.content_serial(), request.camera, request.width, request.height};
  refined_ = false;
  complete_ = true;
  wanted_width_ = request.width;
  wanted_height_ = request.height;
}

void PanePicture::keep_hits(const std::vector<scene::Hit>& hits) {
  auto distances = std::make_shared<std::vector<float>>(hits.size());
  auto triangles = std::make_shared<std::vector<std::uint32_t>>(hits.size());
  for (std::size_t i = 0; i < hits.size(); ++i) {
    (*distances)[i] = hits[i].found() ? hits[i].t : std::numeric_limits<float>::infinity();
    (*triangles)[i] = hits[i].triangle;
  }
  distances_ = std::move(distances);
  hit_triangles_ = std::move(triangles);
}

void PanePicture::color(const PaneRequest& request) {
  if (!image_) return;
  const std::uint64_t other = request.other ? request.other->serial : 0;
  const bool counters = counters_made_ == image_made_;
  const bool same = screen_ && colored_ == image_ && content_ == request.content &&
                    heatmap_ == request.heatmap && joules_ == request.frame_joules &&
                    (content_ != ui::PaneContent::difference || other_serial_ == other) &&
                    colored_counters_ == counters;
  if (same) return;
  colored_ = image_;
  content_ = request.content;
  heatmap_ = request.heatmap;
  joules_ = request.frame_joules;
  other_serial_ = other;
  colored_counters_ = counters;
  heatmap_view_.reset();
  difference_view_.reset();
  auto screen = std::make_shared<ScreenPicture>();
  screen->width = image_->width;
  screen->height = image_->height;
  screen->rgba.resize(image_->pixels.size() * 4);
  if (content_ == ui::PaneContent::heatmap && counters) {
    color_heatmap(request, *screen);
  } else if (content_ == ui::PaneContent::difference && request.other && request.other->image) {
    color_difference(request, *screen);
  } else {
    renderer::picture_to_rgba8(*image_, screen->rgba);
  }
  screen_ = std::move(screen);
}

void PanePicture::color_heatmap(const PaneRequest& request, ScreenPicture& screen) {
  heatmap_view_ = heatmap_colors(counters_, request.heatmap, request.frame_joules,
                                 request.frame_energy, screen);
}

void PanePicture::color_difference(const PaneRequest& request, ScreenPicture& screen) {
  const renderer::Image& other = *request.other->image;
  if (other.width != image_->width || other.height != image_->height) {
    renderer::picture_to_rgba8(*image_, screen.rgba);
    return;
  }
  ui::DifferenceView view;
  view.pixels = image_->pixels.size();
  const auto& theirs = request.other->hit_triangles;
  std::vector<std::uint8_t> marked;
  if (hit_triangles_ && theirs && hit_triangles_->size() == theirs->size() &&
      hit_triangles_->size() == image_->pixels.size()) {
    marked.resize(theirs->size());
    std::uint64_t differing = 0;
    for (std::size_t i = 0; i < marked.size(); ++i) {
      marked[i] = (*theirs)[i] != (*hit_triangles_)[i] ? 1 : 0;
      differing += marked[i];
    }
    view.differing_hits = differing;
  }
  const renderer::ImageDifference difference = renderer::compare_images(*image_, other);
  view.rmse = difference.rmse;
  view.largest = difference.largest;
  view.differing_pixels = difference.differing;
  renderer::picture_to_rgba8(renderer::difference_image(*image_, other, marked), screen.rgba);
  difference_view_ = view;
}

void PanePicture::fill(PaneOutput& output) const {
  output.screen = screen_;
  output.image = image_;
  const bool hits = hits_made_ && hits_made_ == image_made_;
  output.distances = hits ? distances_ : nullptr;
  output.hit_triangles = hits ? hit_triangles_ : nullptr;
  if (image_made_) output.camera = image_made_->camera;
  output.width = wanted_width_;
  output.height = wanted_height_;
  output.whole =
      image_ && complete_ && image_->width == wanted_width_ && image_->height == wanted_height_;
  if (refined_) output.refinement = refinement_.view();
  output.heatmap = heatmap_view_;
  output.difference = difference_view_;
}

}  // namespace encore::app
