// What an exhibit shows of a run, of lights or of a figure, as rows of its sheet.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "papers/exhibit.h"
#include "papers/sheet.h"
#include "report/report.h"

namespace vsglbench {

// Below, `problems` is told what is not shown, and what to do: a picture that can't be read, whose tile says
// so; a glob, or a kind of image, that matches nothing. `folder` is where the paths of the pictures begin.

// A block a scene; in it a row a kind of image, a tile a case. The reference stands first in the first row,
// and nothing below it.
std::vector<SheetRow> rows_of(const Report& report, const std::filesystem::path& folder,
                              const SheetPart& part, std::vector<std::string>* problems);

// Of the PNG files that the part names: a tile each, captioned with where it lies.
SheetRow files_of(const std::filesystem::path& folder, const SheetPart& part,
                  std::vector<std::string>* problems);

}  // namespace vsglbench
