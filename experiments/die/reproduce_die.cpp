#include "experiments/die/reproduce_die.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <map>

#include "alea/core/error.hpp"
#include "experiments/die/audit.hpp"

namespace alea::experiments::die {
namespace {

std::string summary_line(const ResultTable& table) {
  std::map<Verdict, int> counts;
  for (const Cell& cell : table.cells) ++counts[cell.verdict];
  return fmt::format("{:<12} {:3} agree, {:3} differ, {:3} undecidable   {}\n", table.id,
                     counts[Verdict::agrees], counts[Verdict::differs],
                     counts[Verdict::undecidable], table.title);
}

}  // namespace

std::string reproduce_die(const ReproductionOptions& options) {
  std::error_code error;
  std::filesystem::create_directories(options.out, error);
  if (error)
    throw input_error(fmt::format("{}: cannot make the folder ({}); give another --out",
                                  options.out, error.message()));
  const PublishedTables published = load_published_tables();
  std::string report, summary;
  for (const ResultTable& table : {audit_published(published)}) {
    write_table(options.out, table);
    report += as_text(table) + "\n";
    summary += summary_line(table);
  }
  return report + summary;
}

}  // namespace alea::experiments::die
