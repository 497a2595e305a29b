#include <gtest/gtest.h>

#include <algorithm>

#include "experiments/die/audit.hpp"

namespace alea::experiments::die {
namespace {

TEST(PublishedTables, HoldEveryPrintedNumber) {
  const PublishedTables tables = load_published_tables();
  EXPECT_EQ(tables.scans.size(), 8u);
  EXPECT_EQ(tables.check_planes.size(), 16u);
  EXPECT_EQ(tables.dice.size(), 8u);
  const auto printed =
      std::count_if(tables.check_planes.begin(), tables.check_planes.end(),
                    [](const PublishedCheckPlane& plane) { return !plane.calibrated_mm.empty(); });
  EXPECT_EQ(printed, 10);
  EXPECT_EQ(tables.scans[2].points, "100215");
  EXPECT_EQ(tables.scans[5].pips, (std::vector<int>{1, 3, 5}));
}

const Cell& cell_of(const ResultTable& table, const std::string& row, const std::string& column) {
  const auto found = std::find_if(table.cells.begin(), table.cells.end(), [&](const Cell& cell) {
    return cell.row == row && cell.column == column;
  });
  if (found == table.cells.end()) throw std::runtime_error("no cell " + row + ", " + column);
  return *found;
}

TEST(Audit, FindsTheContradictionsOfThePrint) {
  const ResultTable audit = audit_published(load_published_tables());
  const Cell& discrepancy = cell_of(audit, "dataset A", "largest RMSE gap to spheres");
  EXPECT_EQ(discrepancy.verdict, Verdict::differs);
  EXPECT_NEAR(discrepancy.ours->median, 0.8, 1e-9);
  EXPECT_EQ(discrepancy.note, "printed at A-3");
  EXPECT_EQ(cell_of(audit, "dataset C", "largest angle off 90").verdict, Verdict::differs);
  EXPECT_NEAR(cell_of(audit, "dataset B", "shared dihedral, scans apart by at least").ours->median,
              0.6, 1e-9);
  EXPECT_NO_THROW(cell_of(audit, "C-1 and D-1", "angles that repeat"));
  EXPECT_NEAR(cell_of(audit, "0.125 to 0.027 m3", "volume reduced by").ours->median, 78.4, 1e-9);
  EXPECT_NEAR(cell_of(audit, "vertical planes", "mean RMSE, calibrated").ours->median, 2.18, 1e-9);
  EXPECT_NEAR(cell_of(audit, "horizontal planes", "mean RMSE, uncalibrated").ours->median, 4.36,
              1e-9);
}

}  // namespace
}  // namespace alea::experiments::die
