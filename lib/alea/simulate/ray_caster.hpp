#pragma once

#include <cstdint>
#include <vector>

#include "alea/simulate/ray.hpp"
#include "alea/simulate/scene.hpp"

namespace alea {

/// An object and the columns of the grid in which a ray may meet it.
struct Candidate {
  SurfaceKind kind;
  std::uint32_t index;
  std::int64_t first_column;
  std::int64_t last_column;  ///< included
};

/// Finds the nearest surface along the rays of one station. Each object is tried only in the window
/// of the grid that its bounding ball covers, widened by the beam and its pointing noise.
class RayCaster {
 public:
  RayCaster(const Scene& scene, const Station& station);

  /// The objects that a ray of this row may meet.
  std::vector<Candidate> candidates(std::int64_t row) const;
  /// False where no ray that departs from the nominal one by the beam and at most eight standard
  /// deviations of the pointing noise can hit anything: spares the random numbers of a ray that
  /// passes a die or a sphere by.
  bool may_hit(const std::vector<Candidate>& candidates, std::int64_t column,
               const Ray& nominal) const;
  /// The nearest hit of a ray that belongs to `column`; infinite range where there is none.
  Hit cast(const std::vector<Candidate>& candidates, std::int64_t column, const Ray& ray) const;

 private:
  struct RowWindow {
    Candidate candidate;
    std::int64_t first_row;
    std::int64_t last_row;
  };
  template <typename Object>
  void add(SurfaceKind kind, const std::vector<Object>& objects, const Station& station);

  const Scene& scene_;
  std::vector<RowWindow> windows_;
  std::vector<double> die_margin_m_;    ///< how far a beam may be off at each die
  std::vector<double> sphere_reach_m_;  ///< the same at each sphere, from its centre
};

}  // namespace alea
