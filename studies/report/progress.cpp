#include "studies/report/progress.h"

#include <fmt/format.h>

#include <atomic>
#include <cmath>
#include <future>
#include <mutex>

#include <unistd.h>

namespace studies {

std::string clock_text(double seconds) {
  const long whole = std::lround(seconds);
  const long hours = whole / 3600, minutes = whole / 60 % 60;
  return hours > 0 ? fmt::format("{}:{:02}:{:02}", hours, minutes, whole % 60)
                   : fmt::format("{}:{:02}", minutes, whole % 60);
}

Progress::Style Progress::style_of(std::FILE* stream) {
  return isatty(fileno(stream)) ? Style::terminal : Style::lines;
}

Progress::Progress(std::string name, std::size_t steps, Style style, std::FILE* stream)
    : name_(std::move(name)), steps_(steps), style_(style), stream_(stream) {}

Progress::~Progress() {
  if (style_ != Style::terminal || started_ == 0) return;
  fmt::print(stream_, "\r\033[K{}: {} steps in {}\n", name_, started_, clock_text(elapsed_s()));
}

void Progress::step(const std::string& what) {
  at(started_, what);
}

void Progress::at(std::size_t done, const std::string& what) {
  started_ = done + 1;
  if (style_ == Style::lines) fmt::print(stream_, "{}: {} of {}: {}\n", name_, started_, steps_, what);
  if (style_ != Style::terminal) return;
  const double elapsed = elapsed_s();
  const std::string left =
      done == 0 ? ""
                : ", " + clock_text(elapsed * static_cast<double>(steps_ - done) / static_cast<double>(done)) + " left";
  fmt::print(stream_, "\r\033[K{}: {} of {}: {} ({}{})", name_, started_, steps_, what, clock_text(elapsed), left);
  std::fflush(stream_);
}

double Progress::elapsed_s() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

void in_parallel(std::uint64_t count, const std::string& name, Progress::Style style,
                 const std::function<void(std::uint64_t)>& work) {
  Progress progress(name, count, style);
  std::mutex reporting;
  std::atomic<std::uint64_t> next = 0;
  const auto take = [&] {
    for (std::uint64_t i = next++; i < count; i = next++) {
      work(i);
      if (i % 100 != 99) continue;
      const std::lock_guard<std::mutex> lock(reporting);
      progress.at(i, "scenes");
    }
  };
  std::future<void> other = std::async(std::launch::async, take);
  take();
  other.get();
}

}  // namespace studies
