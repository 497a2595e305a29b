#pragma once

#include "experiments/die/published.hpp"
#include "experiments/engine/result_table.hpp"

namespace alea::experiments::die {

/// What the printed tables say about the paper's own statements: no simulation, every number
/// computed from the published data.
ResultTable audit_published(const PublishedTables& tables);

}  // namespace alea::experiments::die
