#pragma once

#include <string>

namespace alea::experiments {

/// Runs scripts/plot.py on a folder of results: it draws a picture (PNG and PDF) from every CSV
/// file that it knows. Returns a line for the reader where pictures could not be drawn, else
/// nothing: the tables are whole without them.
std::string draw_pictures(const std::string& folder);

}  // namespace alea::experiments
