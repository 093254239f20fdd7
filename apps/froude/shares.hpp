#pragma once
/// \file  Where the time of a command went, as one waits for it.
#include <chrono>
#include <string>
#include <utility>
#include <vector>

#include "froude/report.hpp"

namespace froude {

/// Shares of wall time one after the other, s, since this was made.
class Shares {
 public:
  /// What has passed since the last share ended belongs to this one.
  void end(const std::string& share) {
    const auto now = Clock::now();
    seconds_.emplace_back(share, std::chrono::duration<double>(now - last_).count());
    last_ = now;
  }
  /// The same, but for what is known to have gone into others: those stand before it.
  void end(const std::string& share, const std::vector<std::pair<std::string, double>>& known) {
    end(share);
    for (const auto& one : known) seconds_.back().second -= one.second;
    seconds_.insert(seconds_.end() - 1, known.begin(), known.end());
  }
  /// "time: 3.91 s: reading 0.01, preparing 1.1, stepping 2.8"; for programs under `time`, "reading_s" and so on.
  Report report() const;

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point last_ = Clock::now();
  std::vector<std::pair<std::string, double>> seconds_;
};

}  // namespace froude
