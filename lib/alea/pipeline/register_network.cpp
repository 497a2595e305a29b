#include "alea/pipeline/register_network.hpp"

#include "alea/core/error.hpp"
#include "alea/core/parallel.hpp"
#include "alea/transform/reference_point.hpp"

namespace alea {
namespace {

std::vector<std::optional<PreparedScan>> prepare_all(const std::vector<Cloud>& scans,
                                                     const MarkerlessOptions& options) {
  PrepareOptions prepare;
  prepare.levelled = options.levelled;
  std::vector<std::optional<PreparedScan>> prepared(scans.size());
  parallel_chunks(scans.size(), 1, [&](std::size_t i, std::size_t) {
    prepared[i] = prepare_scan(scans[i], prepare);
  });
  return prepared;
}

NetworkPair register_pair(const PreparedScan& a, const PreparedScan& b,
                          const MarkerlessOptions& options) {
  const MarkerlessRegistration found = register_prepared(a, b, options);
  NetworkPair pair;
  pair.refusal = found.registration.refusal;
  pair.overlap = (found.report.overlap_fixed + found.report.overlap_moving) / 2;
  if (pair.refusal) return pair;
  const TransformCovariance about_origin =
      moved_to(*found.registration.covariance, Eigen::Vector3d::Zero());
  pair.edge = PoseEdge{0, 0, *found.registration.master_from_slave, about_origin.covariance};
  return pair;
}

}  // namespace

NetworkRegistration register_network(const std::vector<Cloud>& scans,
                                     const NetworkOptions& options) {
  if (scans.size() < 2) throw usage_error("register network: at least two scans are needed");
  const auto prepared = prepare_all(scans, options.pair);
  NetworkRegistration network;
  std::vector<PoseEdge> edges;
  std::vector<std::size_t> pair_of_edge;
  const std::size_t pairs = scans.size() * (scans.size() - 1) / 2;
  for (std::size_t a = 0; a < scans.size(); ++a)
    for (std::size_t b = a + 1; b < scans.size(); ++b) {
      NetworkPair pair = register_pair(*prepared[a], *prepared[b], options.pair);
      pair.a = a;
      pair.b = b;
      if (pair.edge) {
        pair.edge->a = a;
        pair.edge->b = b;
        edges.push_back(*pair.edge);
        pair_of_edge.push_back(network.pairs.size());
        pair.accepted = true;
      }
      network.pairs.push_back(pair);
      if (options.progress) options.progress("pairs", network.pairs.size(), pairs);
    }
  const auto graph = solve_pose_graph(scans.size(), edges, options.graph);
  if (!graph) {
    network.refusal = graph.refusal();
    return network;
  }
  for (const std::size_t e : graph->rejected) network.pairs[pair_of_edge[e]].accepted = false;
  network.chi_square = graph->chi_square;
  network.master_from_scan = graph->network_from_scan;
  for (std::size_t s = 0; s < scans.size(); ++s) {
    const TransformCovariance about_station{graph->covariance[s],
                                            graph->network_from_scan[s].translation};
    network.covariance.push_back(
        moved_to(about_station, reference_point(graph->network_from_scan[s].translation)));
  }
  return network;
}

}  // namespace alea
