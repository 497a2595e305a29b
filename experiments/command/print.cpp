#include <fmt/format.h>

#include <memory>

#include "alea/core/error.hpp"
#include "alea/io/atomic_file.hpp"
#include "alea/report/target_pdf.hpp"
#include "experiments/command/measure.hpp"

namespace alea::command {
namespace {

struct PrintArguments {
  BoardArguments board;
  double edge_m = 0;
  std::string out;
};

void finish(const std::string& path, const std::string& pdf, const std::string& what) {
  write_file_atomically(path, pdf);
  fmt::print("{}: {}; print it at 100 %, then check the ruler\n", path, what);
}

}  // namespace

void add_print(CLI::App& app, int& exit_code) {
  CLI::App* parent = app.add_subcommand("print", "Targets at 1:1 as PDF");
  parent->require_subcommand(1);

  auto board = std::make_shared<PrintArguments>();
  CLI::App* boards = parent->add_subcommand("checkerboard", "A checkerboard, one page of its size");
  add_board_options(*boards, board->board);
  boards->add_option("OUT", board->out, "PDF file")->required();
  boards->callback([board, &exit_code] {
    const BoardSpec spec = board_spec(board->board);
    finish(board->out, checkerboard_pdf(spec),
           fmt::format("{} x {} cells of {:g} mm", spec.columns, spec.rows, 1000 * spec.cell_m));
    exit_code = exit_done;
  });

  auto pips = std::make_shared<PrintArguments>();
  CLI::App* dice = parent->add_subcommand("pips", "The six facets of a die, a page each");
  dice->add_option("--side", pips->edge_m, "Edge of the die (m)")->required();
  dice->add_option("OUT", pips->out, "PDF file")->required();
  dice->callback([pips, &exit_code] {
    if (!(pips->edge_m >= 0.02 && pips->edge_m <= 10))
      throw usage_error(fmt::format(
          "--side: {} m is not the edge of a die; give metres from 0.02 to 10", pips->edge_m));
    finish(pips->out, pips_pdf(pips->edge_m),
           fmt::format("six facets of {:g} mm", 1000 * pips->edge_m));
    exit_code = exit_done;
  });
}

}  // namespace alea::command
