#include "sweep/team.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <poll.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <nlohmann/json.hpp>
#include <thread>

#include "hydro/base/error.hpp"
#include "sweep/series.hpp"

namespace froude::sweep {
namespace {

namespace fs = std::filesystem;
using hydro::InputError;
using Clock = Team::Clock;
using Json = nlohmann::json;

constexpr const char* out_of_memory = "out of memory";

/// Thrown through a run that is to end.
struct Interrupted {};

/// Whoever waits for more is told that there is none.
void end(Queue& queue) {
  queue.clear();
  queue.close();
}

std::vector<Column> columns_of(const std::vector<Number>& numbers) {
  std::vector<Column> out;
  for (const Number& n : numbers) out.push_back({n.column, n.unit});
  return out;
}

// What a process tells of a case: the case, or what it throws, which ends the sweep.

std::string text_of(const Case& of) {
  Json numbers = Json::array(), columns = Json::array();
  for (const Cell& cell : of.row.numbers)
    numbers.push_back(std::holds_alternative<double>(cell) ? Json(std::get<double>(cell)) : Json());
  for (const Column& c : of.columns) columns.push_back(Json::array({c.name, c.unit}));
  const auto bytes = Json::to_cbor({{"state", static_cast<int>(of.row.state)},
                                    {"reason", of.row.reason},
                                    {"warnings", of.row.warnings},
                                    {"numbers", numbers},
                                    {"columns", columns},
                                    {"series", of.row.series},
                                    {"digest", of.row.digest},
                                    {"seconds", of.row.seconds}});
  return {bytes.begin(), bytes.end()};
}

std::string text_of(const InputError& e) {
  const hydro::Place& at = e.where();
  const auto bytes =
      Json::to_cbor({{"thrown", Json::array({e.rule(), e.remedy(), at.file, at.line, at.column, at.text, at.width})}});
  return {bytes.begin(), bytes.end()};
}

[[noreturn]] void throw_again(const Json& thrown) {
  hydro::Place at;
  thrown[2].get_to(at.file);
  thrown[3].get_to(at.line);
  thrown[4].get_to(at.column);
  thrown[5].get_to(at.text);
  thrown[6].get_to(at.width);
  throw InputError(thrown[0].get<std::string>(), at, thrown[1].get<std::string>());
}

/// \throws hydro::InputError that the process has told
Case case_of(const std::string& text, Row row) {
  const Json told = Json::from_cbor(text);
  if (told.contains("thrown")) throw_again(told["thrown"]);
  Case out{std::move(row), {}, {}};
  out.row.state = static_cast<State>(told["state"].get<int>());
  told["reason"].get_to(out.row.reason);
  told["warnings"].get_to(out.row.warnings);
  told["series"].get_to(out.row.series);
  told["digest"].get_to(out.row.digest);
  told["seconds"].get_to(out.row.seconds);
  for (const Json& number : told["numbers"])
    out.row.numbers.push_back(number.is_null() ? Cell() : Cell(number.get<double>()));
  for (const Json& column : told["columns"]) out.columns.push_back({column[0], column[1]});
  return out;
}

}  // namespace

Row begun(const Cases& cases, std::size_t number, State state) {
  return {.number = number,
          .state = state,
          .reason = {},
          .warnings = {},
          .axes = cases.cells(number),
          .numbers = {},
          .series = {},
          .digest = {}};
}

/// Why numbers of a case that is done are missing.
static std::string reason_of_blanks(const std::vector<Number>& numbers) {
  std::vector<std::string> out;
  for (const Number& n : numbers)
    if (!std::isfinite(n.value)) out.push_back(fmt::format("no {}: {}", n.column, n.why));
  return fmt::format("{}", fmt::join(out, "; "));
}

Case answer_of(const Study& study, const Cases& cases, std::size_t number, const std::shared_ptr<compile::Kept>& kept,
               const std::function<void(double)>& progress) {
  Case out{begun(cases, number, State::failed), {}, {}};
  const auto begin = Clock::now();
  try {
    Answered found = answer(study, cases.scene(number), kept, progress);
    out.row.state = State::done;
    out.row.warnings = fmt::format("{}", fmt::join(found.warnings, "; "));
    out.row.reason = reason_of_blanks(found.numbers);
    // SQLite knows no -0, which + 0.0 takes the sign from.
    for (const Number& n : found.numbers)
      out.row.numbers.push_back(std::isfinite(n.value) ? Cell(n.value + 0.0) : Cell());
    out.columns = columns_of(found.numbers);
    out.series = std::move(found.run);
  } catch (const InputError& e) {
    if (e.where().file == study.file.string()) throw;
    out.row.reason = e.rule();
  } catch (const hydro::NumericsError& e) {
    out.row.reason = e.what();
  } catch (const std::bad_alloc&) {
    out.row.reason = out_of_memory;
  }
  out.row.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  return out;
}

Team::Team(const Study& study, const Cases& cases, Store& store, int count, std::function<bool()> interrupted)
    : study_(study),
      cases_(cases),
      store_(store),
      count_(count),
      asked_to_end_(std::move(interrupted)),
      kept_(std::make_shared<compile::Kept>()) {
  if (study_.series) fs::create_directories(store_.folder() / "series");
}

bool Team::answer_one(std::size_t number) {
  const std::size_t before = answered_;
  if (has_limits()) {
    Queue queue;
    queue.add({number});
    queue.close();
    by_processes(queue, std::chrono::milliseconds(100), [] {});
  } else if (auto found = one(number)) {
    accept(*found);
    keep({&found->row, 1});
  }
  return answered_ > before;
}

void Team::answer_all(Queue& queue, Clock::duration rest, const std::function<void()>& meanwhile) {
  has_limits() ? by_processes(queue, rest, meanwhile) : by_threads(queue, rest, meanwhile);
}

/// What cases share. Where each has coefficients of its own, older ones go: a fit takes a megabyte for five bodies.
std::shared_ptr<compile::Kept> Team::kept() {
  constexpr std::size_t most = 128;
  const std::scoped_lock lock(mutex_);
  if (kept_->made() > most) kept_ = std::make_shared<compile::Kept>();
  return kept_;
}

/// None where it was interrupted.
std::optional<Case> Team::one(std::size_t number) {
  std::optional<Case> out;
  try {
    out = answer_of(study_, cases_, number, kept(), [&](double) {
      if (interrupted()) throw Interrupted{};
    });
  } catch (const Interrupted&) {
    return out;
  }
  if (out->series) keep_series(*std::exchange(out->series, {}), store_.folder(), out->row);
  return out;
}

/// A case whose numbers are others than the first one's has no place in the table.
void Team::require_columns(Case& of) const {
  const auto same = [](const Column& a, const Column& b) { return a.name == b.name && a.unit == b.unit; };
  const auto& columns = store_.columns();
  if (of.row.state != State::done ||
      std::equal(columns.begin(), columns.end(), of.columns.begin(), of.columns.end(), same))
    return;
  of.row.state = State::failed;
  of.row.numbers.clear();
  of.row.reason = "it tells other signals, or in other units, than the first case";
}

/// By the thread that calls: the first case that has numbers names the columns.
void Team::accept(Case& found) {
  if (found.row.state == State::done && store_.columns().empty()) store_.set_columns(found.columns);
  require_columns(found);
}

void Team::keep(std::span<const Row> rows) {
  store_.put(rows);
  answered_ += rows.size();
  for (const Row& row : rows) seconds_ += row.seconds;
}

/// What is ready, if the last time is long enough ago.
void Team::keep_now_and_then(bool now) {
  constexpr auto between_commits = std::chrono::milliseconds(200);
  std::unique_lock lock(mutex_);
  if (ready_.empty() || (!now && Clock::now() - committed_ < between_commits)) return;
  const std::vector<Row> rows = std::exchange(ready_, {});
  lock.unlock();
  keep(rows);
  committed_ = Clock::now();
}

// Threads

void Team::by_threads(Queue& queue, Clock::duration rest, const std::function<void()>& meanwhile) {
  std::vector<std::thread> threads;
  active_ = count_;
  for (int t = 0; t < count_; ++t) threads.emplace_back([&] { work(queue); });
  try {
    collect(queue, rest, meanwhile);
  } catch (...) {
    fail();
  }
  end(queue);
  for (std::thread& thread : threads) thread.join();
  if (failure_) std::rethrow_exception(failure_);
}

void Team::work(Queue& queue) {
  try {
    while (!interrupted()) {
      const auto number = queue.take();
      if (!number) break;
      auto found = one(*number);
      if (!found) break;
      require_columns(*found);
      const std::scoped_lock lock(mutex_);
      ready_.push_back(std::move(found->row));
    }
  } catch (...) {
    fail();
  }
  const std::scoped_lock lock(mutex_);
  --active_;
  changed_.notify_one();
}

/// What is being thrown ends the sweep, and all threads.
void Team::fail() {
  const std::scoped_lock lock(mutex_);
  if (!failure_) failure_ = std::current_exception();
  stop_ = true;
}

void Team::collect(Queue& queue, Clock::duration rest, const std::function<void()>& meanwhile) {
  for (bool active = true; active;) {
    if (interrupted()) end(queue);
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, rest, [&] { return active_ == 0; });
    active = active_ > 0;
    lock.unlock();
    keep_now_and_then(!active);
    meanwhile();
  }
}

// Processes

void Team::by_processes(Queue& queue, Clock::duration rest, const std::function<void()>& meanwhile) {
  processes_.resize(static_cast<std::size_t>(count_));
  while (!interrupted()) {
    for (Process& process : processes_) give(process, queue);
    queue.lack(processes_.size() - at_work());
    if (at_work() == 0 && queue.is_over()) break;
    wait(rest);
    for (Process& process : processes_)
      if (process && process->at_work()) look_after(process);
    keep_now_and_then(false);
    meanwhile();
  }
  if (interrupted()) {
    end(queue);
    processes_.clear();
  }
  keep_now_and_then(true);
  meanwhile();
}

/// The next case to a process that is idle.
void Team::give(Process& process, Queue& queue) {
  if (process && process->at_work()) return;
  std::vector<std::size_t> next;
  if (again_.empty()) {
    next = queue.take(1, 1);
  } else {
    next.push_back(again_.back());
    again_.pop_back();
    process.reset();
  }
  if (next.empty()) return;
  if (!process)
    process = std::make_unique<Child>([this](std::size_t number) { return told(number); }, study_.memory_limit_bytes);
  process->give(next.front());
}

/// In the process.
std::string Team::told(std::size_t number) {
  try {
    if (const auto found = one(number)) return text_of(*found);
    return text_of(InputError("interrupted"));
  } catch (const InputError& e) {
    return text_of(e);
  } catch (const std::exception& e) {
    return text_of(InputError(e.what()));
  }
}

std::size_t Team::at_work() const {
  return static_cast<std::size_t>(
      std::count_if(processes_.begin(), processes_.end(), [](const Process& p) { return p && p->at_work(); }));
}

/// For an answer, for the end of some case's time, or for `rest` at most.
void Team::wait(Clock::duration rest) const {
  std::vector<pollfd> watched;
  double most = std::chrono::duration<double>(rest).count();
  for (const Process& process : processes_) {
    if (!process || !process->at_work()) continue;
    watched.push_back({process->descriptor(), POLLIN, 0});
    if (study_.time_limit_s) most = std::min(most, *study_.time_limit_s - process->seconds());
  }
  ::poll(watched.data(), watched.size(), static_cast<int>(std::ceil(1000 * std::max(0.0, most))));
}

void Team::look_after(Process& process) {
  const std::size_t number = *process->at_work();
  const double seconds = process->seconds();
  try {
    if (const auto text = process->answered()) {
      Case found = case_of(*text, begun(cases_, number, State::failed));
      if (found.row.reason == out_of_memory && study_.memory_limit_bytes)
        return lost(process, number,
                    fmt::format("needs more than {:.6g} MB of memory, the memory_limit of the study",
                                *study_.memory_limit_bytes / 1e6));
      accept(found);
      ready_.push_back(std::move(found.row));
      return;
    }
  } catch (const Child::Ended& ended) {
    return lost(process, number, ended.what());
  }
  if (!study_.time_limit_s || seconds <= *study_.time_limit_s) return;
  process.reset();
  failed(number, fmt::format("took longer than {:.6g} s, the time_limit of the study", *study_.time_limit_s), seconds);
}

/// A case that has spoilt its process. Where other cases were answered in that before, it is tried in one of its own:
/// so what becomes of a case does not depend on those before it.
void Team::lost(Process& process, std::size_t number, const std::string& reason) {
  const bool alone = process->is_fresh();
  const double seconds = process->seconds();
  process.reset();
  alone ? failed(number, reason, seconds) : again_.push_back(number);
}

void Team::failed(std::size_t number, const std::string& reason, double seconds) {
  ready_.push_back(begun(cases_, number, State::failed));
  ready_.back().reason = reason;
  ready_.back().seconds = seconds;
}

}  // namespace froude::sweep
