#include "experiments/die/reproduce_die.hpp"

#include "experiments/die/audit.hpp"
#include "experiments/die/errata.hpp"
#include "experiments/die/figures.hpp"
#include "experiments/die/statements.hpp"
#include "experiments/die/twin_tables.hpp"
#include "experiments/engine/folder.hpp"
#include "experiments/engine/pictures.hpp"

namespace alea::experiments::die {

Reproduction reproduce_die(const ReproductionOptions& options) {
  make_folder(options.out);
  const PublishedTables published = load_published_tables();
  TwinTrialOptions trial;
  trial.seed = options.seed;
  TwinRuns runs;
  for (const std::string dataset : {"A", "B", "C", "D"})
    runs[dataset] =
        run_twins(published, dataset, trial, options.smoke ? 24 : 300, options.progress);

  Reproduction result;
  std::vector<ResultTable>& tables = result.tables;
  tables.push_back(twin_table1(published, runs));
  for (const std::string dataset : {"A", "B", "C", "D"})
    tables.push_back(twin_check_plane_table(published, runs, dataset));
  tables.push_back(twin_table6(published, runs));
  tables.push_back(twin_statements(published, runs));
  tables.push_back(shape_statements(options.smoke ? 60 : 400, options.seed));
  tables.push_back(audit_published(published));
  tables.push_back(errata_table(options.seed));
  tables.push_back(frame_rule_table(options.smoke ? 24 : 400, options.seed));

  for (const ResultTable& table : tables) write_table(options.out, table);
  write_figure_data(published, options.seed, options.out);
  result.no_pictures = draw_pictures(options.out);
  return result;
}

}  // namespace alea::experiments::die
