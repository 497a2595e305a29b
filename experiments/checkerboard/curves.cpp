#include "experiments/checkerboard/curves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "alea/report/axes.hpp"
#include "alea/report/colours.hpp"

namespace alea::experiments::checkerboard {
namespace {

CurvePoint point_of(int shift_percent, const std::vector<SyntheticOutcome>& outcomes) {
  CurvePoint point;
  point.shift_percent = shift_percent;
  std::vector<double> rmse;
  double sum = 0, squares = 0;
  for (const SyntheticOutcome& one : outcomes) {
    point.strict.good += one.strict;
    point.symmetric.good += one.symmetric;
    rmse.push_back(one.rmse);
    sum += one.rmse;
    squares += one.rmse * one.rmse;
  }
  const double n = static_cast<double>(outcomes.size());
  point.strict.of = point.symmetric.of = outcomes.size();
  point.rmse_mean = sum / n;
  point.rmse_sd = std::sqrt(std::max(squares - sum * sum / n, 0.0) / std::max(n - 1, 1.0));
  std::sort(rmse.begin(), rmse.end());
  point.rmse_median = rmse[rmse.size() / 2];
  return point;
}

constexpr double most_rmse = 1.6;  // shown

/// Places of one line and its intervals.
struct Drawn {
  std::vector<Eigen::Vector2d> places, low, high;
};

Drawn success_of(const Curve& curve, double offset) {
  Drawn drawn;
  for (const CurvePoint& p : curve.points) {
    const double x = p.shift_percent + offset;
    drawn.places.emplace_back(x, 100 * p.strict.value());
    drawn.low.emplace_back(x, 100 * p.strict.low());
    drawn.high.emplace_back(x, 100 * p.strict.high());
  }
  return drawn;
}

Drawn rmse_of(const Curve& curve, double offset) {
  const auto held = [](double value) { return std::clamp(value, 0.0, most_rmse); };
  Drawn drawn;
  for (const CurvePoint& p : curve.points) {
    const double x = p.shift_percent + offset;
    drawn.places.emplace_back(x, held(p.rmse_mean));
    drawn.low.emplace_back(x, held(p.rmse_mean - p.rmse_sd));
    drawn.high.emplace_back(x, held(p.rmse_mean + p.rmse_sd));
  }
  return drawn;
}

/// All intervals, pale, below all lines.
void draw(Axes& axes, const std::vector<Drawn>& lines) {
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const Rgb pale = colours::mixed(colours::categorical(k), colours::white, 0.6);
    for (std::size_t i = 0; i < lines[k].places.size(); ++i)
      axes.line(lines[k].low[i], lines[k].high[i], pale);
  }
  for (std::size_t k = 0; k < lines.size(); ++k) {
    axes.polyline(lines[k].places, colours::categorical(k), 2);
    axes.points(lines[k].places, colours::categorical(k), 3);
  }
}

void write_deviations(Axes& axes, const Curve& curve, const Drawn& drawn, Rgb colour) {
  TextStyle style;
  style.height_px = 8;
  style.colour = colour;
  style.halo = true;
  for (std::size_t i = 0; i < drawn.places.size(); ++i)
    axes.text(drawn.places[i] + Eigen::Vector2d(0.5, 0.05),
              fmt::format("{:.2f}", curve.points[i].rmse_sd), style);
}

/// Success above and RMSE below in column `column` of `columns`.
void draw_column(Canvas& canvas, int columns, int column, const std::string& title,
                 const std::vector<Curve>& curves, bool numbers) {
  AxesOptions success;
  success.title = title + ": success (strict), 95 % intervals";
  success.x_name = "shift (% of the side)";
  success.y_name = "success (%)";
  success.low = {-4, 0};
  success.high = {215, 100};  // beyond 150 % stands the legend
  success.equal_scale = false;
  AxesOptions rmse = success;
  rmse.title = fmt::format("RMSE, mean and standard deviation (cut off at {:g})", most_rmse);
  rmse.y_name = "RMSE (sides)";
  rmse.high = {215, most_rmse};
  Axes above(canvas, grid_panel(canvas, columns, 2, column), success);
  Axes below(canvas, grid_panel(canvas, columns, 2, columns + column), rmse);
  std::vector<std::pair<std::string, Rgb>> names;
  std::vector<Drawn> shares, errors;
  for (std::size_t k = 0; k < curves.size(); ++k) {
    const double offset = 0.4 * (static_cast<double>(k) - 0.5 * static_cast<double>(curves.size()));
    shares.push_back(success_of(curves[k], offset));
    errors.push_back(rmse_of(curves[k], offset));
    names.emplace_back(curves[k].name(), colours::categorical(k));
  }
  draw(above, shares);
  draw(below, errors);
  if (numbers)
    for (std::size_t k = 0; k < curves.size(); ++k)
      write_deviations(below, curves[k], errors[k], colours::categorical(k));
  above.legend(names);
}

}  // namespace

std::string Curve::name() const {
  std::string text = to_string(method);
  text += fmt::format(", {} deg", rotation_deg);
  if (synthetic.noise > 0) text += fmt::format(", noise {:g} %", 100 * synthetic.noise);
  if (synthetic.target != Target::identical)
    text += std::string(", ") + to_string(synthetic.target);
  std::replace(text.begin(), text.end(), '_', ' ');
  return text;
}

Curve run_curve(const std::string& figure, Method method, const SyntheticCase& synthetic,
                int rotation_deg, std::uint64_t seed, std::uint64_t pairs) {
  Curve curve{figure, method, synthetic, rotation_deg, {}};
  for (int shift = 0; shift <= 150; shift += 10) {
    SyntheticCase one = synthetic;
    one.shift = shift / 100.0;
    one.rotation_rad = rotation_deg * std::numbers::pi / 180;
    curve.points.push_back(point_of(shift, run_trials(one, method, seed, pairs)));
  }
  return curve;
}

std::string curves_csv(const std::vector<Curve>& curves) {
  std::string out =
      "method,target,noise,rotation_deg,shift_percent,pairs,strict,strict_low,strict_high,"
      "symmetric,symmetric_low,symmetric_high,rmse_mean,rmse_sd,rmse_median\n";
  for (const Curve& curve : curves)
    for (const CurvePoint& p : curve.points)
      out += fmt::format(
          "{},{},{:g},{},{},{},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.5f},"
          "{:.5f},{:.5f}\n",
          to_string(curve.method), to_string(curve.synthetic.target), curve.synthetic.noise,
          curve.rotation_deg, p.shift_percent, p.strict.of, p.strict.value(), p.strict.low(),
          p.strict.high(), p.symmetric.value(), p.symmetric.low(), p.symmetric.high(), p.rmse_mean,
          p.rmse_sd, p.rmse_median);
  return out;
}

void draw_curves(const std::string& path, const std::string& title,
                 const std::vector<Curve>& curves, bool numbers) {
  constexpr std::size_t most_in_a_panel = 8;
  std::vector<std::vector<Curve>> panels;
  for (const Curve& curve : curves) {
    const auto same = std::find_if(panels.begin(), panels.end(), [&](const auto& panel) {
      return curves.size() <= most_in_a_panel || panel[0].method == curve.method;
    });
    if (same == panels.end())
      panels.push_back({curve});
    else
      same->push_back(curve);
  }
  const int columns = static_cast<int>(panels.size());
  Canvas canvas(columns == 1 ? 1100 : 900 * columns, 1000);
  for (int k = 0; k < columns; ++k) draw_column(canvas, columns, k, title, panels[k], numbers);
  write_png(path, canvas.picture());
}

}  // namespace alea::experiments::checkerboard
