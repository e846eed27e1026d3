// Scenes by the million: shared out in chunks to the processes of a crew, each chunk a file of its own, written whole,
// so that a killed run goes on where it was, with another crew, too.
//
//   FOLDER/manifest.json     what the folder holds, and which builds wrote it
//   FOLDER/chunks/M/F-L.csv  of scenes F to L, M the number of their million; its last line says so: a file without
//                            it (cut off, empty after a power cut, of other scenes) is done again
//   FOLDER/timing.csv        a line a run: ranks, scenes, seconds
//
// All but manifest and timing are functions of kind, seed, number of scenes and chunk alone.
#pragma once

#include "studies/engine/crew.h"
#include "studies/report/progress.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace studies {

struct CampaignPlan {
  std::string kind;
  std::string identity;  // of what is asked: another one refuses the folder
  std::uint64_t items = 0;
  std::uint64_t chunk = 100;
  std::filesystem::path folder;
};

// The text of a chunk's file, of the items from .. to - 1. help: to be called after each item.
using ChunkWork = std::function<std::string(std::uint64_t from, std::uint64_t to, const std::function<void()>& help)>;

// Works off what is missing. Throws OutputError in a process that cannot write, and scene::SceneError in the leader
// where the folder holds another campaign; in the others it is then false, and all stop.
bool run_chunks(Crew& crew, const CampaignPlan& plan, const ChunkWork& work, Progress::Style style);

// Of a campaign that is whole, in the order of the scenes.
void read_chunks(const CampaignPlan& plan, const std::function<void(const std::string& text)>& take);

}  // namespace studies
