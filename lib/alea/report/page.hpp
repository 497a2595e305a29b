#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "alea/report/picture.hpp"

namespace alea {

/// A picture with the file name it gets and what it shows.
struct PageFigure {
  std::string file;  ///< e.g. "planes_master.png"
  std::string title;
  std::string caption;  ///< with units
  Picture picture;
};

/// Numbers in rows under named columns.
struct PageTable {
  std::string title;
  std::vector<std::string> columns;  ///< with units
  std::vector<std::vector<std::string>> rows;
  std::string note;
};

/// What a result page shows: a heading, a verdict, tables, then figures.
struct Page {
  std::string title;
  std::string verdict;             ///< one line
  bool refused = false;            ///< the verdict is a refusal
  std::vector<std::string> notes;  ///< warnings, one line each
  std::vector<PageTable> tables;
  std::vector<PageFigure> figures;
};

/// One HTML file that needs no other: the pictures are inside it.
std::string page_html(const Page& page);

/// Writes index.html and each picture as a PNG file into `folder`, which is made where it is
/// missing. Every file is whole or not there, and none takes its place before all are written.
/// Throws Error(input) with path and cause where the folder cannot be made or written.
void write_page(const std::filesystem::path& folder, const Page& page);

}  // namespace alea
