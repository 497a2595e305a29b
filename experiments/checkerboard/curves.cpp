#include "experiments/checkerboard/curves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "alea/report/axes.hpp"

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

void draw_success(Axes& axes, const Curve& curve, Rgb colour, double offset) {
  for (std::size_t k = 0; k < curve.points.size(); ++k) {
    const CurvePoint& p = curve.points[k];
    const double x = p.shift_percent + offset;
    axes.line({x, 100 * p.strict.low()}, {x, 100 * p.strict.high()}, colour);
    axes.point({x, 100 * p.strict.value()}, colour, 3);
    if (k > 0)
      axes.line(
          {curve.points[k - 1].shift_percent + offset, 100 * curve.points[k - 1].strict.value()},
          {x, 100 * p.strict.value()}, colour, 2);
  }
}

void draw_rmse(Axes& axes, const Curve& curve, Rgb colour, double offset, bool numbers) {
  const auto held = [](double value) { return std::min(value, most_rmse); };
  for (std::size_t k = 0; k < curve.points.size(); ++k) {
    const CurvePoint& p = curve.points[k];
    const double x = p.shift_percent + offset;
    axes.line({x, held(std::max(p.rmse_mean - p.rmse_sd, 0.0))}, {x, held(p.rmse_mean + p.rmse_sd)},
              colour);
    axes.point({x, held(p.rmse_mean)}, colour, 3);
    if (k > 0)
      axes.line({curve.points[k - 1].shift_percent + offset, held(curve.points[k - 1].rmse_mean)},
                {x, held(p.rmse_mean)}, colour, 2);
    if (!numbers) continue;
    TextStyle style;
    style.height_px = 7;
    style.colour = colour;
    style.halo = true;
    axes.text({x + 1, held(p.rmse_mean) + 0.05}, fmt::format("{:.2f}", p.rmse_sd), style);
  }
}

}  // namespace

std::string Curve::name() const {
  std::string text = to_string(method);
  std::replace(text.begin(), text.end(), '_', ' ');
  text += fmt::format(", {} deg", rotation_deg);
  if (synthetic.noise > 0) text += fmt::format(", noise {:g} %", 100 * synthetic.noise);
  if (synthetic.target != Target::identical)
    text += std::string(", ") + to_string(synthetic.target);
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
  Canvas canvas(1100, 1000);
  AxesOptions success;
  success.title = title + ": success (strict), 95 % intervals";
  success.x_name = "shift (% of the side)";
  success.y_name = "success (%)";
  success.high = {200, 100};
  success.equal_scale = false;
  AxesOptions rmse = success;
  rmse.title = fmt::format("RMSE, mean and standard deviation (held at {:g})", most_rmse);
  rmse.y_name = "RMSE (sides)";
  rmse.high = {200, most_rmse};
  Axes above(canvas, grid_panel(canvas, 1, 2, 0), success);
  Axes below(canvas, grid_panel(canvas, 1, 2, 1), rmse);
  std::vector<std::pair<std::string, Rgb>> names;
  for (std::size_t k = 0; k < curves.size(); ++k) {
    const Rgb colour = colours::categorical(k);
    const double offset = 0.6 * (static_cast<double>(k) - 0.5 * static_cast<double>(curves.size()));
    draw_success(above, curves[k], colour, offset);
    draw_rmse(below, curves[k], colour, offset, numbers);
    names.emplace_back(curves[k].name(), colour);
  }
  above.legend(names);
  write_png(path, canvas.picture());
}

}  // namespace alea::experiments::checkerboard
