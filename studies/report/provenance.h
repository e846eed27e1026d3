// Where results come from: commit, compiler, flags, library versions, processor, command, checksums of the files.
#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace studies {

// Writes the files of a study (name in the folder to content), and provenance.json with a checksum (FNV-1a, 64 bits) of
// each. It is the one file of a study that differs from machine to machine, beside those of timing.
void write_results(const std::filesystem::path& folder, const std::string& command,
                   const std::map<std::string, std::string>& files);

// Of the build: its commit, with a mark where files differed from it.
std::string commit();

// Processor, compiler and flags in one line, for the head of timing tables.
std::string machine_line();

}  // namespace studies
