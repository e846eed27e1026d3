// The study `campaign`: two campaigns and their page, as pure functions of their tallies.
#pragma once

#include "studies/campaign/tally.h"

#include <filesystem>
#include <map>
#include <string>

namespace studies {

struct CampaignData {
  Tally random, audit;  // whole
  Tally first;          // of both, their first scenes: what --quick solves anew
  std::string timing;   // what the page says of time, empty where nobody measured it
};

// random.csv, audit.csv and first.csv (Tally::text()), tables, picture, page and answers.
std::map<std::string, std::string> campaign_files(const CampaignData& data, const std::filesystem::path& page_md);

}  // namespace studies
