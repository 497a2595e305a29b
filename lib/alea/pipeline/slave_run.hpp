#pragma once

#include <optional>
#include <span>
#include <vector>

#include "alea/core/cloud.hpp"
#include "alea/pipeline/die_pair.hpp"

namespace alea {

/// One scan with what it has to say by itself.
struct Observed {
  Cloud cloud;  ///< in canonical order
  ScanSighting sighting;
};

/// One slave on its way through a registration.
struct SlaveRun {
  std::optional<DiePair> pair;
  /// The master and this slave alone do not determine the transform; other slaves may.
  bool tied_by_others = false;
  std::vector<CommonPlane> planes;
  std::vector<CheckPlaneRole> roles;
  DieTransform transform;  ///< by the pair alone, then by the adjustment
  std::optional<AdjustmentReport> adjustment;
  std::optional<Refusal> refusal;
};

/// The master and its slaves, side by side.
std::vector<Observed> observe_all(const Cloud& master, std::span<const Cloud> slaves,
                                  const DieRegistrationOptions& options);

/// Why there is no die in one of the scans. A die of the other hand in one scan only is a mirrored
/// scan.
std::optional<Refusal> sighting_refusal(const ScanSighting& master, const ScanSighting& slave);

/// The orientations that a refusal for want of pips leaves open; empty where there are none.
std::optional<AmbiguityReport> open_orientations(const ScanSighting& master,
                                                 const ScanSighting& slave, bool levelled);

/// Warnings and times of both scans.
void add_sighting_notes(const ScanSighting& master, const ScanSighting& slave, Registration& out);

/// The die that both scans mean and the transform that it gives, by this pair alone.
void choose_pair(const Observed& master, const Observed& slave, bool has_others,
                 const DieRegistrationOptions& options, SlaveRun& run);

/// Pairs that mean another die of the master than the first pair does are chosen again.
/// `observed` holds the master, then the slaves in the order of the runs.
void agree_on_one_die(const std::vector<Observed>& observed, const DieRegistrationOptions& options,
                      std::vector<SlaveRun>& runs);

/// The planes of the scene that both scans see, and what each is for.
void find_planes(const Observed& master, const Observed& slave,
                 const DieRegistrationOptions& options, SlaveRun& run);

/// The transform at lengths that the calibration planes give.
void calibrate(const Observed& master, const Observed& slave, const DieRegistrationOptions& options,
               SlaveRun& run);

/// What is reported of a registered pair.
void conclude(const Observed& master, const Observed& slave, const DieRegistrationOptions& options,
              SlaveRun& run, Registration& out);

}  // namespace alea
