// Fenced blocks of a page of the documents.
#pragma once

#include <sstream>
#include <string>
#include <vector>

namespace page_blocks {

struct Block {
  int line;
  std::string info, text;
  bool follows_directly;  // nothing but empty lines between it and the block before
};

inline std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream input(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(input, line);) lines.push_back(line);
  return lines;
}

inline std::vector<Block> blocks_of(const std::string& page) {
  std::vector<Block> blocks;
  bool inside = false, direct = false;
  int number = 0;
  for (const std::string& line : lines_of(page)) {
    ++number;
    if (line.rfind("```", 0) == 0) {
      if (!inside) blocks.push_back({number, line.substr(3), "", direct});
      inside = !inside;
      direct = true;
    } else if (inside) {
      blocks.back().text += line + "\n";
    } else if (!line.empty()) {
      direct = false;
    }
  }
  if (inside) blocks.push_back({number, "(a block without its end)", "", false});
  return blocks;
}

// Whether `printed` is `expected`, in which ... stands for any text.
inline bool matches(const std::string& expected, const std::string& printed) {
  std::size_t at = 0, from = 0;
  for (bool first = true;; first = false) {
    const std::size_t dots = expected.find("...", from);
    const std::string piece = expected.substr(from, dots - from);
    const bool last = dots == std::string::npos;
    if (first && printed.compare(0, piece.size(), piece) != 0) return false;
    if (first && last) return printed.size() == piece.size();
    if (last) return printed.size() >= at + piece.size() && printed.ends_with(piece);
    const std::size_t found = printed.find(piece, at);
    if (found == std::string::npos) return false;
    at = found + piece.size();
    from = dots + 3;
  }
}

}  // namespace page_blocks
