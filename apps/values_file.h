// The values that `fam batch` reads: CSV, a header of columns <load>.<component>, a row for each rod.
#pragma once

#include "fam/batch.h"

#include <string>

namespace apps {

struct Values {
  std::vector<fam::BatchColumn> columns;
  fam::RowMajorMatrix values;
};

// From a file, or from standard input where path is "-". Blank lines, spaces around a value, quotes about it, a byte
// order mark and carriage returns do not matter. Throws scene::SceneError naming file, line, column, value and rule.
Values read_values_file(const std::string& path, const scene::Scene& scene);

}  // namespace apps
