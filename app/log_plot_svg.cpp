#include "app/log_plot_svg.h"

#include "scene/diagnostics.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <string_view>

namespace encore::app {

namespace {

constexpr double kWidth = 800.0;
constexpr double kLeft = 80.0;
constexpr double kRight = 780.0;
constexpr double kTop = 40.0;
constexpr double kBottom = 360.0;  ///< of the axes; titles and legend follow
constexpr double kLegendLine = 18.0;

/// Told apart by people with any colour vision, and by their marks.
constexpr std::array<std::string_view, 8> kColours = {"#0072b2", "#d55e00", "#009e73", "#aa4499",
                                                      "#b07d00", "#3a3a3a", "#56b4e9", "#882255"};

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        // XML holds no other control characters, not even escaped.
        result += code < 0x20 ? ' ' : c;
    }
  }
  return result;
}

/// "10⁻³".
std::string power_of_ten(int exponent) {
  static constexpr std::array<std::string_view, 10> kDigits = {"⁰", "¹", "²", "³", "⁴",
                                                               "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = exponent < 0 ? "10⁻" : "10";
  for (const char digit : std::to_string(std::abs(exponent))) {
    text += kDigits[static_cast<std::size_t>(digit - '0')];
  }
  return text;
}

/// What maps values to places between two pixels.
class Axis {
 public:
  Axis(bool logarithmic, const std::vector<double>& values, double from, double to)
      : log_(logarithmic), from_(from), to_(to) {
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    low_ = scaled(*least);
    high_ = scaled(*most);
    step_ = log_ ? std::max(1.0, std::ceil((high_ - low_) / 10.0)) : nice((high_ - low_) / 8.0);
    low_ = std::floor(low_ / step_ + 1e-9) * step_;
    high_ = std::ceil(high_ / step_ - 1e-9) * step_;
    if (!(high_ > low_)) high_ = low_ + step_;
  }
  [[nodiscard]] double place(double value) const {
    return from_ + (to_ - from_) * ((scaled(value) - low_) / (high_ - low_));
  }
  /// Calls `draw(pixel, label)` for each tick.
  template <class Draw>
  void for_each_tick(const Draw& draw) const {
    const auto count = static_cast<int>(std::lround((high_ - low_) / step_));
    for (int i = 0; i <= count; ++i) {
      const double at = low_ + i * step_;
      const double pixel = from_ + (to_ - from_) * i / count;
      // No "-0" or 0.30000000000000004.
      draw(pixel, log_ ? power_of_ten(static_cast<int>(std::lround(at)))
                       : fmt::format("{:.6g}", std::fabs(at) < step_ * 1e-6 ? 0.0 : at));
    }
  }

 private:
  [[nodiscard]] double scaled(double value) const { return log_ ? std::log10(value) : value; }
  /// 1, 2 or 5 times a power of ten, at least this.
  static double nice(double least) {
    if (!(least > 0.0)) return 1.0;
    const double power = std::pow(10.0, std::floor(std::log10(least)));
    for (const double factor : {1.0, 2.0, 5.0}) {
      if (factor * power >= least) return factor * power;
    }
    return 10.0 * power;
  }

  bool log_;
  double from_;
  double to_;
  double low_ = 0.0;
  double high_ = 1.0;
  double step_ = 1.0;
};

/// The points that the plot can show, moved to its limits.
std::vector<PlotPoint> shown_points(const LogPlot& plot, const PlotSeries& series) {
  std::vector<PlotPoint> shown;
  for (PlotPoint point : series.points) {
    if (std::isnan(point.y)) continue;
    if (plot.most_y) point.y = std::min(point.y, *plot.most_y);
    if (plot.least_y) point.y = std::max(point.y, *plot.least_y);
    if (!std::isfinite(point.x) || !std::isfinite(point.y)) continue;
    if ((plot.log_x && point.x <= 0.0) || (plot.log_y && point.y <= 0.0)) continue;
    shown.push_back(std::move(point));
  }
  return shown;
}

/// One of four shapes about a place.
std::string mark(std::size_t kind, double x, double y, std::string_view colour) {
  switch (kind % 4) {
    case 0:
      return fmt::format(R"(<circle cx="{:.1f}" cy="{:.1f}" r="4" fill="{}"/>)", x, y, colour);
    case 1:
      return fmt::format(R"(<rect x="{:.1f}" y="{:.1f}" width="7" height="7" fill="{}"/>)", x - 3.5,
                         y - 3.5, colour);
    case 2:
      return fmt::format(R"(<path d="M{:.1f} {:.1f}l4.5 8h-9z" fill="{}"/>)", x, y - 5, colour);
    default:
      return fmt::format(R"(<path d="M{:.1f} {:.1f}l5 5l-5 5l-5 -5z" fill="{}"/>)", x, y - 5,
                         colour);
  }
}

std::string text_at(double x, double y, std::string_view anchor, std::string_view text,
                    std::string_view more = "") {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\"{}>{}</text>\n", x, y,
                     anchor, more, escaped(text));
}

std::string line(double x1, double y1, double x2, double y2, std::string_view colour) {
  return fmt::format(
      "<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"{}\"/>\n", x1, y1, x2,
      y2, colour);
}

std::string axes_svg(const Axis& x, const Axis& y) {
  constexpr std::string_view kGrid = "#d8d8d8";
  std::string svg;
  x.for_each_tick([&](double pixel, const std::string& label) {
    svg += line(pixel, kTop, pixel, kBottom, kGrid);
    svg += text_at(pixel, kBottom + 18, "middle", label);
  });
  y.for_each_tick([&](double pixel, const std::string& label) {
    svg += line(kLeft, pixel, kRight, pixel, kGrid);
    svg += text_at(kLeft - 8, pixel + 4, "end", label);
  });
  return svg + fmt::format(
                   "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"none\" "
                   "stroke=\"#404040\"/>\n",
                   kLeft, kTop, kRight - kLeft, kBottom - kTop);
}

std::string series_svg(const std::vector<PlotPoint>& points, std::size_t number, bool joined,
                       const Axis& x, const Axis& y) {
  const std::string_view colour = kColours[number % kColours.size()];
  std::string svg;
  if (joined && points.size() > 1) {
    svg += "<polyline points=\"";
    for (const PlotPoint& p : points)
      svg += fmt::format("{:.1f},{:.1f} ", x.place(p.x), y.place(p.y));
    svg += fmt::format("\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.5\"/>\n", colour);
  }
  for (const PlotPoint& p : points) {
    const double px = x.place(p.x);
    const double py = y.place(p.y);
    svg += mark(number, px, py, colour) + "\n";
    if (p.label.empty()) continue;
    // Towards the middle, where there is room.
    const bool right = px > 0.5 * (kLeft + kRight);
    svg += text_at(px + (right ? -7 : 7), py - 5, right ? "end" : "start", p.label);
  }
  return svg;
}

double height_of(const LogPlot& plot) {
  return kBottom + 60.0 + kLegendLine * static_cast<double>(plot.series.size());
}

std::string plot_svg(const LogPlot& plot) {
  std::vector<std::vector<PlotPoint>> shown;
  std::vector<double> xs;
  std::vector<double> ys;
  for (const PlotSeries& series : plot.series) {
    shown.push_back(shown_points(plot, series));
    for (const PlotPoint& point : shown.back()) {
      xs.push_back(point.x);
      ys.push_back(point.y);
    }
  }
  const double middle = 0.5 * (kLeft + kRight);
  std::string svg =
      text_at(middle, 24, "middle", plot.title, " font-size=\"16\" font-weight=\"bold\"");
  if (xs.empty()) return svg + text_at(middle, 0.5 * (kTop + kBottom), "middle", "no points");
  const Axis x(plot.log_x, xs, kLeft, kRight);
  const Axis y(plot.log_y, ys, kBottom, kTop);
  svg += axes_svg(x, y);
  svg += text_at(middle, kBottom + 38, "middle", plot.x_title);
  svg += text_at(18, 0.5 * (kTop + kBottom), "middle", plot.y_title,
                 fmt::format(" transform=\"rotate(-90 18 {:.1f})\"", 0.5 * (kTop + kBottom)));
  for (std::size_t i = 0; i < shown.size(); ++i) {
    svg += series_svg(shown[i], i, plot.series[i].joined, x, y);
    const double line_y = kBottom + 60.0 + kLegendLine * static_cast<double>(i);
    svg += mark(i, kLeft + 10, line_y - 4, kColours[i % kColours.size()]) + "\n";
    svg += text_at(kLeft + 24, line_y, "start", plot.series[i].label);
  }
  return svg;
}

}  // namespace

std::string plots_svg(const std::vector<LogPlot>& plots) {
  double height = 0.0;
  std::string body;
  for (const LogPlot& plot : plots) {
    body += fmt::format("<g transform=\"translate(0 {:.1f})\">\n{}</g>\n", height, plot_svg(plot));
    height += height_of(plot);
  }
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<svg xmlns=\"http://www.w3.org/2000/svg\" version=\"1.1\" width=\"{0:.0f}\" "
      "height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} {1:.0f}\" font-family=\"sans-serif\" "
      "font-size=\"13\" fill=\"#202020\">\n"
      "<rect width=\"{0:.0f}\" height=\"{1:.0f}\" fill=\"#ffffff\"/>\n{2}</svg>\n",
      kWidth, std::max(height, 1.0), body);
}

void write_plots_svg(const std::filesystem::path& file, const std::vector<LogPlot>& plots) {
  errno = 0;
  std::ofstream out(file, std::ios::binary);
  out << plots_svg(plots);
  out.close();
  if (out) return;
  throw scene::InputError(fmt::format("{}: the plot cannot be written: {}", file.string(),
                                      std::strerror(errno != 0 ? errno : EIO)));
}

}  // namespace encore::app
