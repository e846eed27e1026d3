// `fam-studies campaign KIND`
#pragma once

#include "studies/report/progress.h"

#include <CLI/CLI.hpp>

#include <functional>

namespace studies {

// Adds the kinds to the study's command; sets `chosen` to the work of the one that is named.
void add_campaign_commands(CLI::App& campaign, const Progress::Style& style, std::function<int()>& chosen);

}  // namespace studies
