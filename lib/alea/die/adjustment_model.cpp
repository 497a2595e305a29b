#include "alea/die/adjustment_model.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <utility>

#include "alea/die/facet_adjustment.hpp"

namespace alea {
namespace {

// Without noise every tilt (rad) and offset (m) weighs the same.
constexpr double equal_sd = 1e-6;

/// A plane of a scan against the plane that it should be, in the master frame.
struct PlaneObservation {
  Eigen::Vector3d misclosure;           ///< a, b, c: observed minus predicted
  Eigen::Matrix<double, 3, 6> by_pose;  ///< of master_from_scan; of the predicted plane's: minus it
  Eigen::Matrix3d weight;
};

/// Derivatives are taken at the predicted plane: with those of the observed one, noise would make
/// up information about what the scans cannot see.
PlaneObservation observe(const PlaneFit& predicted, const PlaneFit& seen,
                         const RigidTransform& master_from_scan, bool without_noise) {
  const Eigen::Vector3d normal = master_from_scan.rotation * seen.plane.normal;
  const Eigen::Vector3d lever = master_from_scan * seen.centroid_m - predicted.centroid_m;
  PlaneObservation out;
  out.misclosure << predicted.tangent.transpose() * normal, normal.dot(lever);
  out.by_pose.setZero();
  for (int k = 0; k < 2; ++k)
    out.by_pose.row(k).head<3>() = predicted.plane.normal.cross(predicted.tangent.col(k));
  out.by_pose.row(2) << predicted.centroid_m.cross(predicted.plane.normal).transpose(),
      predicted.plane.normal.transpose();
  Eigen::Matrix3d by_seen = Eigen::Matrix3d::Identity();
  const Eigen::Matrix<double, 3, 2> tangent = master_from_scan.rotation * seen.tangent;
  by_seen.topLeftCorner<2, 2>() = predicted.tangent.transpose() * tangent;
  by_seen.block<1, 2>(2, 0) = lever.transpose() * tangent;
  const Eigen::Matrix3d covariance =
      without_noise ? Eigen::Matrix3d(Eigen::Matrix3d::Identity() * equal_sd * equal_sd)
                    : seen.covariance;
  out.weight = (by_seen * covariance * by_seen.transpose()).inverse();
  out.weight = (out.weight + out.weight.transpose()).eval() / 2;
  return out;
}

PlaneFit moved(const PlaneFit& fit, const RigidTransform& to_from) {
  PlaneFit out = fit;
  out.plane.normal = to_from.rotation * fit.plane.normal;
  out.centroid_m = to_from * fit.centroid_m;
  out.plane.offset_m = out.plane.normal.dot(out.centroid_m);
  out.tangent = to_from.rotation * fit.tangent;
  return out;
}

class Lineariser {
 public:
  Lineariser(const AdjustmentProblem& problem, const AdjustmentLayout& layout,
             const AdjustmentState& state)
      : problem_(problem),
        layout_(layout),
        state_(state),
        facets_(departed_facets(problem.shape, state.departure)) {
    out_.constraints = Eigen::MatrixXd::Zero(0, layout.size);
  }

  LinearisedAdjustment all() {
    for (std::size_t s = 0; s < problem_.scans.size(); ++s) {
      for (const ObservedFacet& facet : problem_.scans[s].die.facets) add_facet(s, facet);
      for (const ScenePlane& plane : problem_.scans[s].planes) add_plane(s, plane);
      if (layout_.vertical >= 0) add_level(s);
    }
    add_shape();
    for (const KnownEdge& edge : problem_.edges) add_edge(edge);
    return std::move(out_);
  }

 private:
  AdjustmentObservation& add(ObservationGroup group, std::size_t scan, int label,
                             const Eigen::VectorXd& misclosure, const Eigen::MatrixXd& weight) {
    out_.observations.push_back({group, scan, label, misclosure,
                                 Eigen::MatrixXd::Zero(misclosure.size(), layout_.size), weight});
    return out_.observations.back();
  }

  AdjustmentObservation& add_seen(ObservationGroup group, std::size_t scan, int label,
                                  const PlaneFit& predicted, const PlaneFit& seen) {
    const PlaneObservation of_plane =
        observe(predicted, seen, state_.master_from_scan[scan], problem_.without_noise);
    AdjustmentObservation& added = add(group, scan, label, of_plane.misclosure, of_plane.weight);
    if (scan > 0) added.by_unknowns.block<3, 6>(0, layout_.scan(scan)) = of_plane.by_pose;
    if (group == ObservationGroup::facets)
      added.by_unknowns.block<3, 6>(0, layout_.die) = -of_plane.by_pose;
    return added;
  }

  void add_facet(std::size_t scan, const ObservedFacet& seen) {
    const DepartedFacet& facet = facets_[seen.pips - 1];
    AdjustmentObservation& added = add_seen(ObservationGroup::facets, scan, seen.pips,
                                            moved(facet.fit, state_.master_from_die), seen.fit);
    const int column = layout_.facet[seen.pips - 1];
    if (column >= 0) added.by_unknowns.block<3, 3>(0, column) = -facet.by_departure;
  }

  void add_plane(std::size_t scan, const ScenePlane& seen) {
    AdjustmentObservation& added =
        add_seen(ObservationGroup::planes, scan, seen.id, state_.planes.at(seen.id), seen.fit);
    added.by_unknowns.block<3, 3>(0, layout_.planes.at(seen.id)) = -Eigen::Matrix3d::Identity();
  }

  /// The scan's z axis against the vertical, along two directions across it.
  void add_level(std::size_t scan) {
    const auto across = tangent_basis(state_.vertical);
    const Eigen::Vector3d axis = state_.master_from_scan[scan].rotation.col(2);
    const double sd = *problem_.level_sd_rad;
    AdjustmentObservation& added = add(ObservationGroup::levels, scan, 0, across.transpose() * axis,
                                       Eigen::Matrix2d::Identity() / (sd * sd));
    for (int k = 0; scan > 0 && k < 2; ++k)
      added.by_unknowns.block<1, 3>(k, layout_.scan(scan)) =
          state_.vertical.cross(across.col(k)).transpose();
    added.by_unknowns.block<2, 2>(0, layout_.vertical) = -Eigen::Matrix2d::Identity();
  }

  /// What the prior says of the departures; where it is blind to motions of the die as a whole, the
  /// departures do not make them.
  void add_shape() {
    std::vector<int> free;
    for (int f = 0; f < 6; ++f)
      for (int k = 0; layout_.facet[f] >= 0 && k < 3; ++k) free.push_back(3 * f + k);
    if (free.empty()) return;
    const auto count = static_cast<Eigen::Index>(free.size());
    const Eigen::MatrixXd information = problem_.shape.information(free, free);
    Eigen::MatrixXd select = Eigen::MatrixXd::Zero(count, layout_.size);
    for (Eigen::Index k = 0; k < count; ++k)
      select(k, layout_.facet[free[k] / 3] + free[k] % 3) = 1;
    if (!information.isZero(0))
      add(ObservationGroup::shape, 0, 0, state_.departure(free), information).by_unknowns = select;
    const Eigen::MatrixXd motions = rigid_departures(problem_.shape);
    const Eigen::MatrixXd redundant = redundant_motions(motions, information, free);
    for (Eigen::Index k = 0; k < redundant.cols(); ++k)
      constrain((motions(free, Eigen::all) * redundant.col(k)).transpose() * select, 0);
  }

  /// Motions of the die that neither the prior nor an exact facet in view would notice.
  Eigen::MatrixXd redundant_motions(const Eigen::MatrixXd& motions,
                                    const Eigen::MatrixXd& information,
                                    const std::vector<int>& free) const {
    Matrix6d noticed = Matrix6d::Zero();
    const Eigen::MatrixXd of_free = motions(free, Eigen::all);
    if (!information.isZero(0))
      noticed += of_free.transpose() * information * of_free / information.diagonal().maxCoeff();
    for (int f = 0; f < 6; ++f)
      if (problem_.shape.exact[f] && seen(f + 1)) {
        const Eigen::Matrix<double, 3, 6> rows = motions.middleRows<3>(3 * f);
        noticed += rows.transpose() * rows;
      }
    const Eigen::SelfAdjointEigenSolver<Matrix6d> spectrum(noticed);
    const auto count = (spectrum.eigenvalues().array() < 1e-9).count();
    return spectrum.eigenvectors().leftCols(count);
  }

  bool seen(int pips) const {
    return std::any_of(problem_.scans.begin(), problem_.scans.end(),
                       [&](const auto& scan) { return find_facet(scan.die, pips) != nullptr; });
  }

  void add_edge(const KnownEdge& known) {
    const int end = 4 - die_axis(known.edge.first_pips) - die_axis(known.edge.second_pips);
    for (const int pips : {known.edge.first_pips, known.edge.second_pips, end, opposite_pips(end)})
      if (layout_.facet[pips - 1] < 0 && !problem_.shape.exact[pips - 1]) return;  // not seen
    const EdgeByShape edge = edge_of(facets_, known.edge);
    Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(layout_.size);
    for (int f = 0; f < 6; ++f)
      if (layout_.facet[f] >= 0)
        row.segment<3>(layout_.facet[f]) = edge.by_departure.segment<3>(3 * f);
    if (row.isZero(0)) return;  // exact already
    const double misclosure = edge.length_m - known.length_m;
    if (!(known.sd_m > 0)) return constrain(row, -misclosure);
    add(ObservationGroup::edges, 0, 0, Eigen::VectorXd::Constant(1, misclosure),
        Eigen::MatrixXd::Constant(1, 1, 1 / (known.sd_m * known.sd_m)))
        .by_unknowns = row;
  }

  void constrain(const Eigen::RowVectorXd& row, double closure) {
    const Eigen::Index rows = out_.constraints.rows();
    out_.constraints.conservativeResize(rows + 1, layout_.size);
    out_.constraints.row(rows) = row;
    out_.closure.conservativeResize(rows + 1);
    out_.closure[rows] = closure;
  }

  const AdjustmentProblem& problem_;
  const AdjustmentLayout& layout_;
  const AdjustmentState& state_;
  std::array<DepartedFacet, 6> facets_;
  LinearisedAdjustment out_;
};

}  // namespace

AdjustmentLayout layout_of(const AdjustmentProblem& problem) {
  AdjustmentLayout layout;
  layout.facet.fill(-1);
  layout.die = 6 * (static_cast<int>(problem.scans.size()) - 1);
  layout.size = layout.die + 6;
  for (int f = 0; f < 6; ++f)
    for (const AdjustmentScan& scan : problem.scans) {
      if (problem.shape.exact[f] || layout.facet[f] >= 0) continue;
      if (find_facet(scan.die, f + 1) == nullptr) continue;
      layout.facet[f] = layout.size;
      layout.size += 3;
    }
  for (const AdjustmentScan& scan : problem.scans)
    for (const ScenePlane& plane : scan.planes)
      if (layout.planes.try_emplace(plane.id, layout.size).second) layout.size += 3;
  if (problem.level_sd_rad) {
    layout.vertical = layout.size;
    layout.size += 2;
  }
  return layout;
}

AdjustmentState starting_state(const AdjustmentProblem& problem) {
  AdjustmentState state;
  for (const AdjustmentScan& scan : problem.scans) {
    const RigidTransform scan_from_die = place_shape(scan.die, problem.shape.nominal);
    if (state.master_from_scan.empty()) state.master_from_die = scan_from_die;
    state.master_from_scan.push_back(state.master_from_die * scan_from_die.inverse());
    for (const ScenePlane& plane : scan.planes)
      state.planes.try_emplace(plane.id, moved(plane.fit, state.master_from_scan.back()));
  }
  state.master_from_scan[0] = {};
  return state;
}

LinearisedAdjustment linearise(const AdjustmentProblem& problem, const AdjustmentLayout& layout,
                               const AdjustmentState& state) {
  return Lineariser(problem, layout, state).all();
}

NormalSystem normal_system(const LinearisedAdjustment& linearised, int size) {
  NormalSystem system{Eigen::MatrixXd::Zero(size, size), Eigen::VectorXd::Zero(size),
                      linearised.constraints, linearised.closure};
  for (const AdjustmentObservation& o : linearised.observations) {
    const Eigen::MatrixXd weighted = o.by_unknowns.transpose() * o.weight;
    system.normal += weighted * o.by_unknowns;
    system.right -= weighted * o.misclosure;
  }
  return system;
}

AdjustmentState corrected(const AdjustmentState& state, const AdjustmentLayout& layout,
                          const Eigen::VectorXd& correction) {
  AdjustmentState next = state;
  const Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  for (std::size_t s = 1; s < next.master_from_scan.size(); ++s)
    next.master_from_scan[s] =
        perturb_left(state.master_from_scan[s], correction.segment<6>(layout.scan(s)), origin);
  next.master_from_die =
      perturb_left(state.master_from_die, correction.segment<6>(layout.die), origin);
  for (int f = 0; f < 6; ++f)
    if (layout.facet[f] >= 0)
      next.departure.segment<3>(3 * f) += correction.segment<3>(layout.facet[f]);
  for (auto& [id, fit] : next.planes) {
    const Eigen::Vector3d abc = correction.segment<3>(layout.planes.at(id));
    fit.plane.normal = (fit.plane.normal + fit.tangent * abc.head<2>()).normalized();
    fit.centroid_m += abc[2] * fit.plane.normal;
    fit.plane.offset_m = fit.plane.normal.dot(fit.centroid_m);
    fit.tangent = tangent_basis(fit.plane.normal);
  }
  if (layout.vertical >= 0)
    next.vertical =
        (state.vertical + tangent_basis(state.vertical) * correction.segment<2>(layout.vertical))
            .normalized();
  return next;
}

}  // namespace alea
