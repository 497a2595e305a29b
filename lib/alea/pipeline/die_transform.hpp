#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "alea/core/result.hpp"
#include "alea/die/hand.hpp"
#include "alea/pipeline/observe_die.hpp"

namespace alea {

/// The transform that one die gives, and how it moves with the die's lengths.
struct DieTransform {
  RigidTransform master_from_slave;
  std::optional<TransformCovariance> covariance;
  std::optional<std::string> shared_edge;
  std::optional<double> edge_m;  ///< length that the transform rests on
  double edge_sd_m = 0;          ///< zero: exact
  /// Lengths that a calibration may change (m): the shared edge's; with the paper's method the
  /// common side length and the lift l_z. Empty where the transform rests on none.
  Eigen::VectorXd lengths_m;
  Eigen::MatrixXd directions;  ///< 3 by #lengths_m: derivative of the translation, master frame
  Eigen::Vector3d corner_master_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d corner_slave_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();  ///< of the die, roughly, master frame
  std::map<std::string, double> edges_m;               ///< those that the adjustment determined
  std::vector<std::string> warnings;
};

/// Registers by one pair of sightings with the options' method; the adjustment starts from the
/// closed form. `lengths_m` overrides the nominal
/// lengths (as many as DieTransform::lengths_m has), `lengths_sd_m` their standard deviations.
Result<DieTransform> transform_by_die(
    const DieSighting& master, const DieSighting& slave, const DieRegistrationOptions& options,
    const std::optional<Eigen::VectorXd>& lengths_m = std::nullopt, double length_sd_m = 0);

/// Which hands a registration accepts; empty: any.
HandRule hand_rule(const std::optional<Chirality>& chirality);

/// The length that the options give for an edge which the extents make about `measured_m` long;
/// empty where they give none. Of a cuboid the nearest of its three.
std::optional<double> nominal_edge_m(const DieRegistrationOptions& options, double measured_m);

/// An edge as both scans measured it by the facets' extents.
struct MeasuredEdge {
  std::string name;
  double length_m = 0;
  double sd_m = 0;
};

/// Every edge that either scan sees, in the order of their names; of one seen by both the weighted
/// mean. What footprint and edge radius hide of an edge is wrong by the same amount in both scans,
/// so the mean's standard deviation is the mean of theirs.
std::vector<MeasuredEdge> measured_edges(const DieSighting& master, const DieSighting& slave);

}  // namespace alea
