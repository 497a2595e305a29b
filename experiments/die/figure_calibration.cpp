#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <iterator>

#include "alea/io/atomic_file.hpp"
#include "alea/simulate/scanner.hpp"
#include "experiments/die/figures.hpp"
#include "experiments/die/twin_estimate.hpp"

namespace alea::experiments::die {
namespace {

// Mean of the planes' squared union RMSE, as its root (mm).
double rmse_mm(const LengthFamily& family, double change_m, const Twin& twin,
               const TwinObservation& observed, CalibrationSet set) {
  Eigen::VectorXd change = Eigen::VectorXd::Zero(family.translation_by_length.cols());
  change[0] = change_m;
  double sum = 0, count = 0;
  for (std::size_t k = 0; k < twin.planes.size(); ++k) {
    if (twin.planes[k].check != (set == CalibrationSet::check)) continue;
    const PlaneMoments slave = moved(observed.planes[k].slave, family.at(change));
    sum += std::pow(1e3 * fit_rmse_m(joined(observed.planes[k].master, slave)), 2);
    ++count;
  }
  return std::sqrt(sum / count);
}

void append_curve(const std::string& method, const std::optional<LengthFamily>& family,
                  const Twin& twin, const TwinObservation& observed, std::string& csv) {
  if (!family) return;
  for (const auto& [set, name] : {std::pair{CalibrationSet::check, "check planes"},
                                  std::pair{CalibrationSet::independent, "other planes"}}) {
    for (int i = -60; i <= 60; ++i) {
      const double edge_m = twin.true_edge_m + 5e-4 * i;
      fmt::format_to(std::back_inserter(csv), "{},{},{},{:.4f},{:.5f}\n", twin.dataset, method,
                     name, edge_m,
                     rmse_mm(*family, edge_m - twin.nominal_edge_m, twin, observed, set));
    }
  }
}

// A cabinet beyond the die along the shared edge, where a wrong length shows.
Box cabinet(const Twin& twin) {
  Box box;
  box.size_m = {0.4, 0.8, 2.2};  // higher than any scanner: its top stays out of sight
  const Eigen::Vector3d sideways = twin.edge_direction.cross(Eigen::Vector3d::UnitZ());
  const Eigen::Vector3d behind =
      -(twin.scene_from_scan[0].translation + twin.scene_from_scan[1].translation);
  const Eigen::Vector3d away = sideways.dot(behind) > 0 ? sideways : Eigen::Vector3d(-sideways);
  const double heading = std::atan2(away.y(), away.x()) + 0.6;
  const Eigen::Vector3d place = 1.8 * away;
  box.scene_from_box = levelled_pose({place.x(), place.y(), 1.1}, heading);
  return box;
}

void append_cabinet(const Twin& twin, const LengthFamily& family, const Eigen::VectorXd& change,
                    std::uint64_t seed, std::string& csv) {
  Scene scene;
  scene.boxes.push_back(cabinet(twin));
  for (int scan = 0; scan < 2; ++scan) {
    const Station station =
        aimed_station(twin.scene_from_scan[scan], bounding_ball(scene.boxes.front()), 4e-3);
    const Cloud cloud =
        simulate_scan(scene, station, {seed, 7, 0, static_cast<std::uint32_t>(scan)});
    const auto append = [&](const char* state, const RigidTransform& master_from_scan) {
      const RigidTransform scene_from_scan = twin.scene_from_scan[0] * master_from_scan;
      for (const Eigen::Vector3d& p : cloud.positions) {
        const Eigen::Vector3d q = scene_from_scan * p;
        fmt::format_to(std::back_inserter(csv), "{},{},{},{:.5f},{:.5f}\n", twin.dataset, state,
                       scan == 0 ? "master" : "slave", q.x(), q.y());
      }
    };
    append("before", scan == 0 ? RigidTransform{} : family.nominal);
    append("after", scan == 0 ? RigidTransform{} : family.at(change));
  }
}

}  // namespace

void write_calibration_figures(const PublishedTables& tables, std::uint64_t seed,
                               const std::string& folder) {
  std::string curves = "dataset,method,planes,edge_m,rmse_mm\n";
  std::string clouds = "dataset,state,scan,x_m,y_m\n";
  for (const std::string dataset : {"A", "B", "C", "D"}) {
    const Twin twin = draw_twin(tables, dataset, {}, seed, 0);
    const TwinObservation observed = observe_twin(twin, seed, 0);
    const std::optional<LengthFamily> closed_form = closed_form_family(twin, observed);
    append_curve("closed form", closed_form, twin, observed, curves);
    append_curve("equations 1-8", paper_family(twin, observed, FrameRule::fix_z), twin, observed,
                 curves);
    if (!closed_form) continue;
    const auto change = calibrate(*closed_form, twin, observed, CalibrationSet::independent);
    if (change) append_cabinet(twin, *closed_form, *change, seed, clouds);
  }
  const std::filesystem::path path(folder);
  write_file_atomically(path / "figure10.csv", curves);
  write_file_atomically(path / "table7.csv", clouds);
}

}  // namespace alea::experiments::die
