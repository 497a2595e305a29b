#include "alea/markerless/yaw_sweep.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <opencv2/core.hpp>

#include "alea/core/parallel.hpp"
#include "alea/markerless/height_vote.hpp"

namespace alea {
namespace {

using std::numbers::pi;

/// Points of vertical surfaces seen from above, upright frame.
struct WallPoint {
  Eigen::Vector2d place_m;
  std::complex<float> facing;
};

std::vector<WallPoint> wall_points(const PreparedScan& scan) {
  std::vector<WallPoint> points;
  for (std::size_t i = 0; i < scan.fine.size(); ++i) {
    const Eigen::Vector3d n = scan.upright_from_scan * scan.fine.normals[i].cast<double>();
    if (std::abs(n.z()) > 0.5) continue;
    const Eigen::Vector3d p = scan.upright_from_scan * scan.fine.positions[i];
    const Eigen::Vector2f facing = n.head<2>().normalized().cast<float>();
    points.push_back({p.head<2>(), {facing.x(), facing.y()}});
  }
  return points;
}

double reach_m(const std::vector<WallPoint>& points) {
  std::vector<double> reach;
  for (const WallPoint& p : points) reach.push_back(p.place_m.norm());
  if (reach.empty()) return 0;
  const auto at = reach.begin() + static_cast<long>(reach.size() * 95 / 100);
  std::nth_element(reach.begin(), at, reach.end());
  return *at;
}

struct Raster {
  int cells;
  double cell_m;
};

/// The image of the points turned by `yaw`; high walls count by the root of their points, so that
/// one facade does not outvote everything else.
cv::Mat image_of(const std::vector<WallPoint>& points, double yaw, const Raster& raster) {
  cv::Mat image = cv::Mat::zeros(raster.cells, raster.cells, CV_32FC2);
  const double c = std::cos(yaw), s = std::sin(yaw);
  const std::complex<float> turn(static_cast<float>(c), static_cast<float>(s));
  for (const WallPoint& p : points) {
    const double x = c * p.place_m.x() - s * p.place_m.y();
    const double y = s * p.place_m.x() + c * p.place_m.y();
    const int column = static_cast<int>(std::floor(x / raster.cell_m)) + raster.cells / 2;
    const int row = static_cast<int>(std::floor(y / raster.cell_m)) + raster.cells / 2;
    if (column < 0 || column >= raster.cells || row < 0 || row >= raster.cells) continue;
    const std::complex<float> facing = p.facing * turn;
    image.at<cv::Vec2f>(row, column) += cv::Vec2f(facing.real(), facing.imag());
  }
  for (int row = 0; row < raster.cells; ++row)
    for (int column = 0; column < raster.cells; ++column) {
      cv::Vec2f& value = image.at<cv::Vec2f>(row, column);
      const float length = std::hypot(value[0], value[1]);
      if (length > 0) value *= 1 / std::sqrt(length);
    }
  return image;
}

/// Real part of the circular correlation: cell (dy, dx) for the shift that moves `moving`.
cv::Mat correlation(const cv::Mat& fixed_spectrum, const cv::Mat& moving) {
  cv::Mat spectrum, product, back;
  cv::dft(moving, spectrum);
  cv::mulSpectrums(fixed_spectrum, spectrum, product, 0, true);
  cv::idft(product, back, cv::DFT_SCALE);
  cv::Mat real;
  cv::extractChannel(back, real, 0);
  return real;
}

struct Peak {
  float value;
  int row, column;
};

std::vector<Peak> highest_peaks(const cv::Mat& correlation, int count) {
  const int n = correlation.rows;
  std::vector<Peak> peaks;
  for (int row = 0; row < n; ++row)
    for (int column = 0; column < n; ++column) {
      const float value = correlation.at<float>(row, column);
      if (static_cast<int>(peaks.size()) == count && value <= peaks.back().value) continue;
      bool highest = value > 0;
      for (int dr = -1; dr <= 1 && highest; ++dr)
        for (int dc = -1; dc <= 1; ++dc)
          if ((dr != 0 || dc != 0) &&
              correlation.at<float>((row + dr + n) % n, (column + dc + n) % n) > value)
            highest = false;
      if (!highest) continue;
      const auto place =
          std::find_if(peaks.begin(), peaks.end(), [&](const Peak& p) { return p.value < value; });
      peaks.insert(place, {value, row, column});
      if (static_cast<int>(peaks.size()) > count) peaks.pop_back();
    }
  return peaks;
}

double energy(const cv::Mat& image) {
  return cv::norm(image, cv::NORM_L2);
}

}  // namespace

std::vector<PoseCandidate> yaw_sweep(const PreparedScan& fixed, const PreparedScan& moving,
                                     const YawSweepOptions& options) {
  const std::vector<WallPoint> of_fixed = wall_points(fixed), of_moving = wall_points(moving);
  Raster raster{options.image_cells, options.cell_m};
  const double reach = std::max(reach_m(of_fixed), reach_m(of_moving));
  if (2 * reach > raster.cells * raster.cell_m) raster.cells *= 2;
  raster.cell_m = std::max(raster.cell_m, 2 * reach / raster.cells);
  const cv::Mat fixed_image = image_of(of_fixed, 0, raster);
  cv::Mat fixed_spectrum;
  cv::dft(fixed_image, fixed_spectrum);
  const HeightVote heights(fixed, moving, options.height_range_m);
  const auto yaws = static_cast<std::size_t>(std::round(2 * pi / options.yaw_step_rad));
  std::vector<std::vector<PoseCandidate>> found(yaws);
  parallel_chunks(yaws, 1, [&](std::size_t k, std::size_t) {
    const double yaw = 2 * pi * static_cast<double>(k) / static_cast<double>(yaws);
    const cv::Mat moving_image = image_of(of_moving, yaw, raster);
    const double most = energy(fixed_image) * energy(moving_image);
    if (!(most > 0)) return;
    const cv::Mat response = correlation(fixed_spectrum, moving_image);
    for (const Peak& peak : highest_peaks(response, options.peaks_per_yaw)) {
      const auto shift = [&](int cell) {
        return raster.cell_m * (cell >= raster.cells / 2 ? cell - raster.cells : cell);
      };
      const Eigen::Vector2d shift_m(shift(peak.column), shift(peak.row));
      for (const double height_m : heights.best(yaw, shift_m)) {
        RigidTransform upright;
        upright.rotation = Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix();
        upright.translation = {shift_m.x(), shift_m.y(), height_m};
        const RigidTransform up_fixed{fixed.upright_from_scan, Eigen::Vector3d::Zero()};
        const RigidTransform up_moving{moving.upright_from_scan, Eigen::Vector3d::Zero()};
        found[k].push_back({up_fixed.inverse() * upright * up_moving, peak.value / most,
                            CandidateSource::yaw_sweep});
      }
    }
  });
  std::vector<PoseCandidate> all;
  for (const auto& part : found) all.insert(all.end(), part.begin(), part.end());
  return all;
}

}  // namespace alea
