// What a long command is at: n of m, time elapsed and left.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <string>

namespace studies {

class Progress {
 public:
  // terminal: one line that is written over, with the time left; lines: a plain line a step, for a pipe; quiet:
  // nothing.
  enum class Style { terminal, lines, quiet };

  // The style for a stream: terminal if it is one.
  static Style style_of(std::FILE* stream);

  Progress(std::string name, std::size_t steps, Style style, std::FILE* stream = stderr);
  ~Progress();  // on a terminal: one closing line with the time it took
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  // Starts the next step.
  void step(const std::string& what);
  // `done` steps are done; for work that threads or blocks share out.
  void at(std::size_t done, const std::string& what);

 private:
  double elapsed_s() const;

  std::string name_;
  std::size_t steps_, started_ = 0;
  Style style_;
  std::FILE* stream_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

// "0:07", "12:30", "1:02:03".
std::string clock_text(double seconds);

// work(0) ... work(count - 1), in no order, shared out over two threads.
void in_parallel(std::uint64_t count, const std::string& name, Progress::Style style,
                 const std::function<void(std::uint64_t)>& work);

}  // namespace studies
