// Study `sensing`: other starts, the arc laws as the estimator's model, and the time that estimates take.
#pragma once

#include "studies/report/table.h"

#include <filesystem>

namespace studies {

// Where the search ends from twelve starts each, and whether chi-squared tells a wrong minimum.
Table starts_table(const std::filesystem::path& cases);

// A follower's tip force from four positions without noise, by each law with its number of arcs: what the law's error
// does to the force.
Table laws_table();

// Of an Estimator made and asked once, and of one that goes on from the estimate before with new noise. Timed.
Table times_table(const std::filesystem::path& cases);

}  // namespace studies
