#include "froude/progress.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace froude {
namespace {

std::string duration_text(double seconds) {
  const auto whole = static_cast<long>(std::ceil(seconds));
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} h {:02} min", whole / 3600, whole % 3600 / 60);
}

}  // namespace

std::string progress_line(const std::string& what, double fraction, double elapsed_s) {
  constexpr int width = 30;
  const double done = std::clamp(fraction, 0.0, 1.0);
  const int filled = static_cast<int>(done * width);
  std::string line = fmt::format("{}  [{:#<{}}{:.<{}}]  {:3.0f} %", what, "", filled, "", width - filled, 100 * done);
  // An estimate from the first percent would only be noise.
  if (done > 0.01) line += fmt::format("  {} left", duration_text(elapsed_s * (1 - done) / done));
  return line;
}

Progress::Progress(std::ostream& err, std::string what, bool shown)
    : err_(err), what_(std::move(what)), shown_(shown) {}

void Progress::update(double fraction) {
  if (!shown_) return;
  const auto now = Clock::now();
  if (drawn_ && now - last_drawn_ < std::chrono::milliseconds(100)) return;
  const std::chrono::duration<double> elapsed = now - start_;
  if (!drawn_ && elapsed.count() < 0.3) return;  // work that is over at once needs no bar
  err_ << "\r\033[K" << progress_line(what_, fraction, elapsed.count()) << std::flush;
  drawn_ = true;
  last_drawn_ = now;
}

Progress::~Progress() {
  if (drawn_) err_ << "\r\033[K" << std::flush;
}

}  // namespace froude
