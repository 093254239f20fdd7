#include "sweep/ranks.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <sstream>
#include <thread>

namespace froude::sweep {
namespace {

// How long a rank looks away from its messages: a thread that waits for a case waits about so long.
constexpr auto glance = std::chrono::milliseconds(2);
// The work that a thread is given at once, where cases are shorter than that: a hundred glances.
constexpr double portion_s = 0.2;

/// The first line of a message, its word, and the others.
std::pair<std::string, std::vector<std::string>> parsed(const std::string& text) {
  std::istringstream in(text);
  std::string word, line;
  std::getline(in, word);
  std::vector<std::string> lines;
  while (std::getline(in, line)) lines.push_back(line);
  return {word, lines};
}

std::string begin_of(const std::vector<Column>& columns) {
  std::string out = "begin\n";
  for (const Column& c : columns) out += c.name + '\n' + c.unit + '\n';
  return out;
}

}  // namespace

// Rank 0

void Master::begin(const std::vector<Column>& columns) {
  begun_ = true;
  for (int r = 1; r < count(); ++r)
    if (!helped_[static_cast<std::size_t>(r)].ended) ranks_.send(r, begin_of(columns));
}

void Master::serve(Queue& cases, bool stop) {
  if (stop && !stopped_) {
    stopped_ = true;
    for (int r = 1; r < count(); ++r)
      if (!helped_[static_cast<std::size_t>(r)].ended) ranks_.send(r, "stop");
  }
  while (const auto message = ranks_.received()) take(*message, cases, stop);
}

void Master::take(const Ranks::Message& message, Queue& cases, bool stop) {
  const auto [word, lines] = parsed(message.text);
  Helped& from = helped_[static_cast<std::size_t>(message.from)];
  from.answered = std::stoul(lines.at(0));
  if (word == "ask") {
    const auto given =
        stop ? std::vector<std::size_t>() : cases.take(std::stoul(lines.at(1)), 2 * static_cast<std::size_t>(count()));
    ranks_.send(message.from, fmt::format("cases\n{}", fmt::join(given, "\n")));
    return;
  }
  from.ended = true;
  if (lines.size() > 1)
    faults_.push_back(fmt::format("rank {}: {}", message.from, fmt::join(lines.begin() + 1, lines.end(), " ")));
  ranks_.send(message.from, "bye");
}

bool Master::all_ended() const {
  return std::all_of(helped_.begin() + 1, helped_.end(), [](const Helped& h) { return h.ended; });
}

void Master::finish(Queue& cases, const std::function<bool()>& stop) {
  while (true) {
    serve(cases, !begun_ || stop());
    if (all_ended()) return;
    std::this_thread::sleep_for(glance);
  }
}

void Master::dismiss() {
  Queue none;
  finish(none, [] { return true; });
}

std::size_t Master::answered() const {
  std::size_t out = 0;
  for (const Helped& h : helped_) out += h.answered;
  return out;
}

// The others

void Helper::run(const std::function<void()>& work) {
  std::string reason;
  try {
    work();
  } catch (const std::exception& e) {
    reason = e.what();
  }
  ranks_.send(0, fmt::format("ended\n{}\n{}", answered_, reason));
  while (!dismissed_) {
    while (const auto message = ranks_.received()) take(message->text);
    std::this_thread::sleep_for(glance);
  }
}

std::optional<std::vector<Column>> Helper::begun(const std::function<bool()>& interrupted) {
  while (!columns_ && !stopped_ && !interrupted()) {
    while (const auto message = ranks_.received()) take(message->text);
    std::this_thread::sleep_for(glance);
  }
  return stopped_ ? std::nullopt : columns_;
}

void Helper::serve(Queue& cases, std::size_t answered, double seconds_a_case) {
  answered_ = answered;
  while (const auto message = ranks_.received()) take(message->text);
  cases.add(std::exchange(cases_, {}));
  if (no_more_ || stopped_) cases.close();
  const std::size_t waiting = cases.waiting();
  if (waiting == 0 || asked_ || no_more_ || stopped_) return;
  const double each = seconds_a_case > 0 ? std::clamp(portion_s / seconds_a_case, 1.0, 1000.0) : 1;
  ranks_.send(0, fmt::format("ask\n{}\n{}", answered, waiting * static_cast<std::size_t>(each)));
  asked_ = true;
}

void Helper::take(const std::string& text) {
  const auto [word, lines] = parsed(text);
  if (word == "begin") {
    columns_.emplace();
    for (std::size_t i = 0; i + 1 < lines.size(); i += 2) columns_->push_back({lines[i], lines[i + 1]});
  } else if (word == "cases") {
    asked_ = false;
    no_more_ = lines.empty();
    for (const std::string& line : lines) cases_.push_back(std::stoul(line));
  } else {
    stopped_ = true;
    dismissed_ = word == "bye";
  }
}

}  // namespace froude::sweep
