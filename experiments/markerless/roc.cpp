#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <map>
#include <set>

#include "alea/core/seed.hpp"
#include "alea/report/axes.hpp"
#include "experiments/markerless/success.hpp"

namespace alea::experiments::markerless {
namespace {

struct Scores {
  std::vector<double> right, wrong;  ///< less is better
};

Scores scores_of(const std::vector<JudgedPose>& poses, const PoseFigure& figure) {
  Scores scores;
  for (const JudgedPose& pose : poses)
    (pose.error.is_right() ? scores.right : scores.wrong)
        .push_back(figure.sign * pose.*figure.value);
  return scores;
}

double wins(const std::vector<double>& right, const std::vector<double>& wrong) {
  double sum = 0;
  for (const double r : right)
    for (const double w : wrong) sum += r < w ? 1 : r == w ? 0.5 : 0;
  return sum;
}

/// Won comparisons between the true poses of one pair and the false ones of another.
struct Comparisons {
  std::vector<double> right, wrong;  ///< counts of each pair
  std::vector<std::vector<double>> won;

  /// `times`: how often each pair counts. 0.5 where there is nothing to compare.
  double area(const std::vector<double>& times) const {
    double sum = 0, all_right = 0, all_wrong = 0;
    for (std::size_t g = 0; g < times.size(); ++g) {
      all_right += times[g] * right[g];
      all_wrong += times[g] * wrong[g];
      for (std::size_t h = 0; h < times.size(); ++h) sum += times[g] * times[h] * won[g][h];
    }
    return all_right * all_wrong > 0 ? sum / (all_right * all_wrong) : 0.5;
  }
};

Comparisons compare(const std::vector<JudgedPose>& poses, const PoseFigure& figure) {
  std::map<std::string, std::vector<JudgedPose>> of_pair;
  for (const JudgedPose& pose : poses) of_pair[pose.pair].push_back(pose);
  std::vector<Scores> scores;
  for (const auto& [pair, members] : of_pair) scores.push_back(scores_of(members, figure));
  Comparisons out;
  for (const Scores& g : scores) {
    out.right.push_back(static_cast<double>(g.right.size()));
    out.wrong.push_back(static_cast<double>(g.wrong.size()));
    out.won.emplace_back();
    for (const Scores& h : scores) out.won.back().push_back(wins(g.right, h.wrong));
  }
  return out;
}

/// Share of the true poses that are kept where the limit lets no false pose through.
double kept_without_a_false_one(const Scores& scores) {
  if (scores.right.empty()) return 0;
  double best_wrong = std::numeric_limits<double>::infinity();
  for (const double w : scores.wrong) best_wrong = std::min(best_wrong, w);
  const auto kept = std::count_if(scores.right.begin(), scores.right.end(),
                                  [&](double r) { return r < best_wrong; });
  return static_cast<double>(kept) / static_cast<double>(scores.right.size());
}

/// Shares of false poses let through (x) and of true ones kept (y), for every limit.
std::vector<Eigen::Vector2d> roc_line(const Scores& scores) {
  std::set<double> limits(scores.right.begin(), scores.right.end());
  limits.insert(scores.wrong.begin(), scores.wrong.end());
  const auto share = [](const std::vector<double>& values, double limit) {
    const auto within =
        std::count_if(values.begin(), values.end(), [&](double v) { return v <= limit; });
    return static_cast<double>(within) /
           static_cast<double>(std::max<std::size_t>(values.size(), 1));
  };
  std::vector<Eigen::Vector2d> line{{0, 0}};
  for (const double limit : limits)
    line.emplace_back(share(scores.wrong, limit), share(scores.right, limit));
  return line;
}

}  // namespace

const std::vector<PoseFigure>& pose_figures() {
  static const std::vector<PoseFigure> figures{
      {"RMSE of all points", 1, &JudgedPose::rmse_m},
      {"overlap", -1, &JudgedPose::overlap},
      {"least information", -1, &JudgedPose::least_information},
      {"tilt", 1, &JudgedPose::tilt_deg},
      {"forward-backward closure", 1, &JudgedPose::closure_m},
      {"free-space conflict ratio", 1, &JudgedPose::conflict_ratio},
      {"margin", -1, &JudgedPose::margin}};
  return figures;
}

Interval area_under_roc(const std::vector<JudgedPose>& poses, const PoseFigure& figure,
                        std::uint64_t seed) {
  const Comparisons comparisons = compare(poses, figure);
  const std::size_t pairs = comparisons.right.size();
  const double area = comparisons.area(std::vector<double>(pairs, 1));
  if (pairs == 0) return {0, 0.5, 1};
  RandomStream stream({seed, 6, 0, 0, Purpose::bootstrap});
  std::vector<double> drawn;
  for (int draw = 0; draw < 1000; ++draw) {
    std::vector<double> times(pairs, 0);
    for (std::size_t i = 0; i < pairs; ++i) times[stream.below(pairs)] += 1;
    drawn.push_back(comparisons.area(times));
  }
  const Interval spread = central_interval(drawn);
  return {std::min(area, spread.low), area, std::max(area, spread.high)};
}

ResultTable success_table(const std::vector<JudgedPose>& poses, std::uint64_t seed) {
  ResultTable table{"success",
                    "How well each figure tells true poses from false ones",
                    "Area under the ROC, 0.5 tells nothing; 95 % interval by drawing pairs again.",
                    {}};
  std::set<std::string> pairs;
  for (const JudgedPose& pose : poses) pairs.insert(pose.pair);
  for (const PoseFigure& figure : pose_figures()) {
    const Scores scores = scores_of(poses, figure);
    table.cells.push_back({figure.name, "area under ROC", "", "",
                           area_under_roc(poses, figure, seed), Verdict::ours,
                           fmt::format("{} true, {} false poses of {} pairs", scores.right.size(),
                                       scores.wrong.size(), pairs.size())});
    table.cells.push_back(own_cell(figure.name, "true poses kept where no false one passes", "",
                                   {kept_without_a_false_one(scores)}));
  }
  return table;
}

void draw_roc(const std::vector<JudgedPose>& poses, const std::string& folder,
              const std::string& name) {
  Canvas canvas(1150, 760);
  AxesOptions options;
  options.title = "true poses kept against false poses let through";
  options.x_name = "false poses let through (share)";
  options.y_name = "true poses kept (share)";
  Axes axes(canvas, {0, 0, 760, 760}, options);
  axes.line({0, 0}, {1, 1}, colours::middle);
  const auto& figures = pose_figures();
  for (std::size_t i = 0; i < figures.size(); ++i) {
    const std::vector<Eigen::Vector2d> line = roc_line(scores_of(poses, figures[i]));
    axes.polyline(line, colours::categorical(i), 3);
    const double y = 120 + 34 * static_cast<double>(i);
    canvas.line({785, y}, {825, y}, colours::categorical(i), 4);
    canvas.text({835, y}, figures[i].name);
  }
  write_png(std::filesystem::path(folder) / (name + ".png"), canvas.picture());
}

}  // namespace alea::experiments::markerless
