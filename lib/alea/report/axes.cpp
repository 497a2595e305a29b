#include "alea/report/axes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace alea {
namespace {

constexpr double tick_px = 4, label_px = 9, title_px = 12;
constexpr double letter_px = 7.2;  // mean width of a letter of a label

std::string tick_label(double value, double step) {
  const int decimals = std::clamp(static_cast<int>(std::ceil(-std::log10(step) - 1e-9)), 0, 9);
  return fmt::format("{:.{}f}", std::abs(value) < step * 1e-6 ? 0.0 : value, decimals);
}

}  // namespace

PanelArea grid_panel(const Canvas& canvas, int columns, int rows, int number, double margin_px) {
  const double width = static_cast<double>(canvas.width()) / columns,
               height = static_cast<double>(canvas.height()) / rows;
  return {number % columns * width + margin_px, number / columns * height + margin_px,
          width - 2 * margin_px, height - 2 * margin_px};
}

std::vector<double> round_ticks(double low, double high, int count) {
  const double span = high - low;
  if (!(span > 0) || !std::isfinite(span) || count < 1) return {};
  const double rough = span / count;
  const double power = std::pow(10, std::floor(std::log10(rough)));
  const double share = rough / power;
  const double step = power * (share < 1.5 ? 1 : share < 3.5 ? 2 : share < 7.5 ? 5 : 10);
  std::vector<double> ticks;
  for (double k = std::ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; ++k)
    ticks.push_back(k * step);
  return ticks;
}

Axes::Axes(Canvas& canvas, const PanelArea& area, const AxesOptions& options) : canvas_(&canvas) {
  low_ = options.low;
  high_ = options.high.cwiseMax(options.low + Eigen::Vector2d::Constant(1e-12));
  const double left = options.frame ? 62 : 2, bottom = options.frame ? 42 : 2,
               top = options.title.empty() ? 6 : 26, right = options.frame ? 14 : 2;
  upper_left_ = {area.left + left, area.top + top};
  lower_right_ = {area.left + std::max(area.width - right, left + 10),
                  area.top + std::max(area.height - bottom, top + 10)};
  const Eigen::Vector2d room = lower_right_ - upper_left_;
  scale_ = room.cwiseQuotient(high_ - low_);
  if (options.equal_scale) {
    scale_.setConstant(scale_.minCoeff());
    const Eigen::Vector2d centre = (low_ + high_) / 2, shown = room.cwiseQuotient(scale_) / 2;
    low_ = centre - shown;
    high_ = centre + shown;
  }
  draw_frame(options, area);
}

void Axes::draw_frame(const AxesOptions& options, const PanelArea& area) {
  Canvas& canvas = *canvas_;
  const Eigen::Vector2d room = lower_right_ - upper_left_;
  if (!options.title.empty())
    canvas.text({(upper_left_.x() + lower_right_.x()) / 2, area.top + 13}, options.title,
                {.height_px = title_px, .anchor = TextAnchor::centre});
  if (!options.frame) return;
  for (int axis = 0; axis < 2; ++axis) {
    std::vector<double> ticks = round_ticks(
        low_[axis], high_[axis], std::max(2, static_cast<int>(room[axis] / (axis == 0 ? 75 : 55))));
    if (axis == 0 && options.whole_x)
      std::erase_if(ticks, [](double tick) { return tick != std::round(tick); });
    const double step = ticks.size() > 1 ? ticks[1] - ticks[0] : high_[axis] - low_[axis];
    for (const double tick : ticks) {
      Eigen::Vector2d from = low_, to = high_;
      from[axis] = to[axis] = tick;
      if (options.grid) line(from, to, colours::light);
      const Eigen::Vector2d foot = at(from);
      if (axis == 0) {
        canvas.line(foot, foot + Eigen::Vector2d(0, tick_px), colours::ink);
        canvas.text(foot + Eigen::Vector2d(0, tick_px + label_px), tick_label(tick, step),
                    {.height_px = label_px, .anchor = TextAnchor::centre});
      } else {
        canvas.line(foot, foot - Eigen::Vector2d(tick_px, 0), colours::ink);
        canvas.text(foot - Eigen::Vector2d(tick_px + 3, 0), tick_label(tick, step),
                    {.height_px = label_px, .anchor = TextAnchor::right});
      }
    }
  }
  const Eigen::Vector2d lower_left(upper_left_.x(), lower_right_.y()),
      upper_right(lower_right_.x(), upper_left_.y());
  canvas.line(upper_left_, lower_left, colours::ink);
  canvas.line(lower_left, lower_right_, colours::ink);
  canvas.line(lower_right_, upper_right, colours::ink);
  canvas.line(upper_right, upper_left_, colours::ink);
  canvas.text({(upper_left_.x() + lower_right_.x()) / 2, lower_right_.y() + 31}, options.x_name,
              {.height_px = label_px + 1, .anchor = TextAnchor::centre});
  canvas.text({area.left + 8, (upper_left_.y() + lower_right_.y()) / 2}, options.y_name,
              {.height_px = label_px + 1, .anchor = TextAnchor::centre, .upright = true});
}

Eigen::Vector2d Axes::at(const Eigen::Vector2d& place) const {
  return {upper_left_.x() + (place.x() - low_.x()) * scale_.x(),
          lower_right_.y() - (place.y() - low_.y()) * scale_.y()};
}

Eigen::Vector2d Axes::place(const Eigen::Vector2d& pixel) const {
  return {low_.x() + (pixel.x() - upper_left_.x()) / scale_.x(),
          low_.y() + (lower_right_.y() - pixel.y()) / scale_.y()};
}

void Axes::point(const Eigen::Vector2d& place, Rgb colour, double radius_px) {
  if ((place.array() < low_.array()).any() || (place.array() > high_.array()).any()) return;
  const Eigen::Vector2d pixel = at(place);
  if (radius_px < 1)
    canvas_->pixel(static_cast<int>(pixel.x()), static_cast<int>(pixel.y()), colour);
  else
    canvas_->disc(pixel, radius_px, colour);
}

void Axes::points(std::span<const Eigen::Vector2d> places, Rgb colour, double radius_px) {
  for (const Eigen::Vector2d& place : places) point(place, colour, radius_px);
}

void Axes::line(const Eigen::Vector2d& from, const Eigen::Vector2d& to, Rgb colour, int width_px) {
  canvas_->line(at(from), at(to), colour, width_px);
}

void Axes::polyline(std::span<const Eigen::Vector2d> places, Rgb colour, int width_px) {
  for (std::size_t i = 1; i < places.size(); ++i) line(places[i - 1], places[i], colour, width_px);
}

void Axes::text(const Eigen::Vector2d& place, const std::string& words, const TextStyle& style) {
  canvas_->text(at(place), words, style);
}

void Axes::legend(const std::vector<std::pair<std::string, Rgb>>& entries) {
  std::size_t longest = 0;
  for (const auto& [name, colour] : entries) longest = std::max(longest, name.size());
  const double width = 26 + letter_px * static_cast<double>(longest);
  const double height = 6 + 17 * static_cast<double>(entries.size());
  const Eigen::Vector2d corner(lower_right_.x() - width - 4, upper_left_.y() + 4);
  canvas_->box(corner, corner + Eigen::Vector2d(width, height), colours::white);
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const Eigen::Vector2d spot = corner + Eigen::Vector2d(11, 12 + 17 * static_cast<double>(i));
    canvas_->disc(spot, 4, entries[i].second);
    canvas_->text(spot + Eigen::Vector2d(10, 0), entries[i].first, {.height_px = label_px});
  }
}

void draw_legend_row(Canvas& canvas, const Eigen::Vector2d& at,
                     const std::vector<std::pair<std::string, Rgb>>& entries) {
  Eigen::Vector2d spot = at;
  for (const auto& [name, colour] : entries) {
    canvas.disc(spot, 4, colour);
    canvas.text(spot + Eigen::Vector2d(10, 0), name, {.height_px = label_px});
    spot.x() += 40 + letter_px * static_cast<double>(name.size());
  }
}

void draw_colour_bar(Canvas& canvas, const PanelArea& area, Rgb (*colour)(double), double low,
                     double high, const std::vector<std::string>& names) {
  const int rows = static_cast<int>(area.height);
  for (int row = 0; row < rows; ++row) {
    const double value = high + (low - high) * (row + 0.5) / rows;
    canvas.box({area.left, area.top + row}, {area.left + area.width, area.top + row},
               colour(value));
  }
  const double last = std::max<double>(1, static_cast<double>(names.size()) - 1);
  for (std::size_t i = 0; i < names.size(); ++i)
    canvas.text(
        {area.left + area.width + 5, area.top + area.height * (1 - static_cast<double>(i) / last)},
        names[i], {.height_px = label_px});
}

}  // namespace alea
