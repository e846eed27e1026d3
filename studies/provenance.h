// Where results come from: commit, compiler, flags, library versions, processor, command, checksums of the files.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace studies {

// Writes folder/provenance.json for the files of a study, with a checksum (FNV-1a, 64 bits) of each. It is the one
// file of a study that differs from machine to machine, beside those of timing.
void write_provenance(const std::filesystem::path& folder, const std::string& command,
                      const std::vector<std::string>& files);

// Processor, compiler and flags in one line, for the head of timing tables.
std::string machine_line();

}  // namespace studies
