#include "alea/pipeline/scene_conflict.hpp"

#include "alea/core/error.hpp"
#include "alea/markerless/pose_evidence.hpp"

namespace alea {

std::vector<double> scene_conflicts(const Cloud& master, const Cloud& slave,
                                    const std::vector<RigidTransform>& master_from_slave) {
  if (!master.scanner_position || !slave.scanner_position)
    throw usage_error("scene conflicts: the scanners' positions must be known");
  const PreparedScan fixed = prepare_scan(master, {}), moving = prepare_scan(slave, {});
  std::vector<double> out;
  for (RigidTransform t : master_from_slave) {
    t.translation += t.rotation * moving.scanner_m - fixed.scanner_m;  // about the scanners
    out.push_back(pose_evidence(fixed, moving, t, {}).conflict_ratio());
  }
  return out;
}

}  // namespace alea
