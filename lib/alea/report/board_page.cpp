#include "alea/report/board_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "alea/report/view.hpp"

namespace alea {
namespace {

/// How the pictures look at the board: along its normal, and along its rows.
struct BoardViews {
  ParallelView front, side;
};

BoardViews views_of(const RigidTransform& scan_from_board) {
  const Eigen::Matrix3d& r = scan_from_board.rotation;
  BoardViews views;
  views.front = {r.col(0), r.col(1), r.col(2)};
  views.side = {r.col(2), r.col(1), -r.col(0)};
  return views;
}

std::vector<Rgb> greys(const Cloud& cloud) {
  std::vector<float> sorted = cloud.intensity;
  std::sort(sorted.begin(), sorted.end());
  const float low = sorted[sorted.size() / 50],
              high = sorted[sorted.size() - 1 - sorted.size() / 50];
  std::vector<Rgb> colours;
  for (const float value : cloud.intensity)  // the lightest is not quite the paper's white
    colours.push_back(colours::grey(0.9 * (value - low) / std::max(high - low, 1e-30f)));
  return colours;
}

struct StagePicture {
  const Cloud& cloud;
  const BoardSpec& board;
  BoardViews views;
  Eigen::Vector3d centre;
};

void draw_outline(Axes& axes, const ParallelView& view, const StagePicture& stage,
                  const RigidTransform& pose) {
  const double w = stage.board.side_m() / 2, h = stage.board.height_m() / 2;
  const auto at = [&](double x, double y) {
    return view(pose * Eigen::Vector3d(x, y, 0) - stage.centre);
  };
  const std::vector<Eigen::Vector2d> outline{at(-w, -h), at(w, -h), at(w, h), at(-w, h),
                                             at(-w, -h)};
  axes.polyline(outline, colours::slave, 2);
  for (int k = 1; k < stage.board.columns; ++k) {
    const double x = k * stage.board.cell_m - w;
    axes.line(at(x, -h), at(x, h), colours::slave, 1);
  }
  for (int k = 1; k < stage.board.rows; ++k) {
    const double y = k * stage.board.cell_m - h;
    axes.line(at(-w, y), at(w, y), colours::slave, 1);
  }
  axes.point(at(0, 0), colours::master, 4);
}

Picture draw_stage(const StagePicture& stage, const RigidTransform* pose) {
  Canvas canvas(1000, 520);
  const std::vector<Rgb> shade = greys(stage.cloud);
  std::vector<Eigen::Vector3d> local;
  for (const Eigen::Vector3d& p : stage.cloud.positions) local.push_back(p - stage.centre);
  const double reach = 0.75 * stage.board.side_m();
  const char* titles[] = {"front", "side"};
  const ParallelView* views[] = {&stage.views.front, &stage.views.side};
  for (int k = 0; k < 2; ++k) {
    AxesOptions options;
    options.title = titles[k];
    options.x_name = k == 0 ? "along columns (m)" : "along the normal (m)";
    options.y_name = "along rows (m)";
    options.low = Eigen::Vector2d::Constant(-reach);
    options.high = Eigen::Vector2d::Constant(reach);
    Axes axes(canvas, grid_panel(canvas, 2, 1, k), options);
    std::vector<Eigen::Vector3d> shown;
    std::vector<Rgb> colours_shown;
    for (std::size_t i = 0; i < local.size(); ++i) {
      const Eigen::Vector2d at = (*views[k])(local[i]);
      if (at.cwiseAbs().maxCoeff() > reach) continue;
      shown.push_back(local[i]);
      colours_shown.push_back(shade[i]);
    }
    draw_points(axes, *views[k], shown, colours_shown, 2);
    if (pose) draw_outline(axes, *views[k], stage, *pose);
  }
  return canvas.picture();
}

RigidTransform pose_of(const BoardMeasurement& m) {
  RigidTransform pose;
  pose.rotation << m.axes, m.normal;
  pose.translation = m.centre_m;
  return pose;
}

PageTable numbers(const BoardMeasurement& m) {
  PageTable table;
  table.title = "Measurement";
  table.columns = {"quantity", "value"};
  table.rows = {
      {"centre (m)",
       fmt::format("{:.5f}, {:.5f}, {:.5f}", m.centre_m.x(), m.centre_m.y(), m.centre_m.z())},
      {"normal", fmt::format("{:.5f}, {:.5f}, {:.5f}", m.normal.x(), m.normal.y(), m.normal.z())},
      {"cell (m)", fmt::format("{:.5f}{}", m.cell_m, m.cell_estimated ? "" : " (given)")},
      {"rmse along the normal (mm)", fmt::format("{:.2f}", 1e3 * m.rmse_m)},
      {"colour score", fmt::format("{:.3f}", m.colour_score)},
      {"points", std::to_string(m.points)}};
  if (m.covariance)
    table.rows.push_back(
        {"standard deviations (mm)",
         fmt::format("{:.3f}, {:.3f}, {:.3f}", 1e3 * std::sqrt((*m.covariance)(0, 0)),
                     1e3 * std::sqrt((*m.covariance)(1, 1)),
                     1e3 * std::sqrt((*m.covariance)(2, 2)))});
  return table;
}

}  // namespace

Page board_page(const Cloud& cloud, const Eigen::Vector3d& near_m,
                const MeasureCheckerboardOptions& options) {
  MeasureCheckerboardOptions here = options;
  here.near_m = near_m;
  const auto result = measure_checkerboard(cloud, here);
  Page page;
  page.title = "Checkerboard";
  page.refused = !result;
  page.verdict = result ? fmt::format("measured by {}", to_string(options.method))
                        : fmt::format("refused: {}", result.refusal().message);
  ColouredBoardStages stages;
  const auto coloured =
      measure_by_coloured_icp(cloud, near_m, options.target, options.coloured, &stages);
  if (!coloured) page.notes.push_back("published pipeline: " + coloured.refusal().message);
  if (result) page.tables.push_back(numbers(result->front()));
  if (stages.poses.empty()) return page;
  const RigidTransform seen_from = result ? pose_of(result->front()) : stages.poses.back().second;
  const auto add = [&](const std::string& name, const std::string& caption, const Cloud& points,
                       const RigidTransform* pose) {
    const StagePicture stage{points, options.target.board, views_of(seen_from),
                             seen_from.translation};
    std::string title = name;
    std::replace(title.begin(), title.end(), '_', ' ');
    page.figures.push_back({name + ".png", title, caption, draw_stage(stage, pose)});
  };
  add("crop", "the points near the place, by intensity", stages.cropped, nullptr);
  add("outliers_removed", "without the points off the plane", stages.without_outliers, nullptr);
  add("binarised", "intensities by Otsu's threshold", stages.binarised, nullptr);
  for (const auto& [name, pose] : stages.poses)
    add("template_" + name, "the template (red) after this step", stages.binarised, &pose);
  if (result && options.method == BoardMethod::likelihood)
    add("likelihood", "the board as measured by likelihood", stages.cropped, &seen_from);
  return page;
}

}  // namespace alea
