#include "experiments/command/reproduction_json.hpp"

#include "alea/core/version.hpp"

namespace alea::command {
namespace {

nlohmann::json cell_json(const experiments::Cell& cell) {
  nlohmann::json ours = nullptr;
  if (cell.ours)
    ours = {{"low", cell.ours->low}, {"median", cell.ours->median}, {"high", cell.ours->high}};
  nlohmann::json verdict = nullptr;
  if (cell.verdict != experiments::Verdict::ours) verdict = experiments::to_string(cell.verdict);
  return {
      {"row", cell.row},
      {"column", cell.column},
      {"unit", cell.unit},
      {"printed", cell.printed.empty() ? nlohmann::json(nullptr) : nlohmann::json(cell.printed)},
      {"ours", ours},
      {"verdict", verdict},
      {"note", cell.note}};
}

}  // namespace

nlohmann::json reproduction_json(const std::vector<experiments::ResultTable>& tables,
                                 std::uint64_t seed, bool smoke) {
  nlohmann::json all = nlohmann::json::array();
  for (const experiments::ResultTable& table : tables) {
    nlohmann::json cells = nlohmann::json::array();
    for (const experiments::Cell& cell : table.cells) cells.push_back(cell_json(cell));
    all.push_back(
        {{"id", table.id}, {"title", table.title}, {"note", table.note}, {"cells", cells}});
  }
  return {{"alea", version()}, {"seed", seed}, {"smoke", smoke}, {"tables", all}};
}

}  // namespace alea::command
