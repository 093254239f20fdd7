#include "sweep/sweep.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>

#include "hydro/base/error.hpp"
#include "sweep/queue.hpp"
#include "sweep/ranks.hpp"
#include "sweep/series.hpp"

namespace froude::sweep {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using hydro::InputError;

double seconds_since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

/// Thrown through a run that is to end.
struct Interrupted {};
struct TooLong {};

/// What a process that was killed has left behind.
void remove_leftovers(const fs::path& folder) {
  std::error_code failed;
  for (const fs::path& at : {folder, folder / "series"})
    for (fs::directory_iterator file(at, failed), end; !failed && file != end; file.increment(failed))
      if (file->path().string().ends_with(".froude.tmp")) fs::remove(file->path(), failed);
}

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

std::vector<Column> columns_of(const std::vector<Number>& numbers) {
  std::vector<Column> out;
  for (const Number& n : numbers) out.push_back({n.column, n.unit});
  return out;
}

/// A case answered, with what its row alone does not hold.
struct Case {
  Row row;
  std::vector<Column> columns;
  std::optional<Run> series;
};

/// \throws hydro::InputError where the study itself is wrong, and what `progress` throws
Case answer_of(const Study& study, const Cases& cases, std::size_t number, const std::shared_ptr<compile::Kept>& kept,
               const std::function<void(double)>& progress) {
  Case out{begun(cases, number, State::failed), {}, {}};
  const auto begin = Clock::now();
  try {
    Answered found = answer(study, cases.scene(number), kept, progress);
    out.row.state = State::done;
    out.row.warnings = fmt::format("{}", fmt::join(found.warnings, "; "));
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
  } catch (const TooLong&) {
    out.row.reason = fmt::format("took longer than {:.6g} s, the time_limit of the study", *study.time_limit_s);
  } catch (const std::bad_alloc&) {
    out.row.reason = "out of memory";
  }
  out.row.seconds = seconds_since(begin);
  return out;
}

/// Threads that answer cases, each taken by the one that is free first, and keep them in a store.
class Team {
 public:
  Team(const Study& study, const Cases& cases, Store& store, int threads, std::function<bool()> interrupted)
      : study_(study), cases_(cases), store_(store), threads_(threads), asked_to_end_(std::move(interrupted)) {
    if (study_.series) fs::create_directories(store_.folder() / "series");
  }

  bool interrupted() const { return stop_ || (asked_to_end_ && asked_to_end_()); }
  std::size_t answered() const { return answered_; }
  double seconds_a_case() const { return answered_ > 0 ? seconds_ / static_cast<double>(answered_) : 0; }

  /// One case, by this thread, whose numbers name the columns where the store has none yet. False where interrupted.
  bool answer_one(std::size_t number) {
    auto found = one(number);
    if (!found) return false;
    if (found->row.state == State::done && store_.columns().empty()) store_.set_columns(found->columns);
    keep({&found->row, 1});
    return true;
  }

  /// All of the queue. This thread calls `meanwhile` every `rest`, and puts what is ready into the store a few times a
  /// second, each time in one transaction: on disk is what is older.
  void answer_all(Queue& queue, Clock::duration rest, const std::function<void()>& meanwhile) {
    std::vector<std::thread> threads;
    active_ = threads_;
    for (int t = 0; t < threads_; ++t) threads.emplace_back([&] { work(queue); });
    try {
      collect(queue, rest, meanwhile);
    } catch (...) {
      fail();
    }
    end(queue);
    for (std::thread& thread : threads) thread.join();
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  /// What cases share. Where each has coefficients of its own, older ones go: a fit takes a megabyte for five bodies.
  std::shared_ptr<compile::Kept> kept() {
    constexpr std::size_t most = 128;
    const std::scoped_lock lock(mutex_);
    if (kept_->made() > most) kept_ = std::make_shared<compile::Kept>();
    return kept_;
  }

  /// None where it was interrupted.
  std::optional<Case> one(std::size_t number) {
    const auto begin = Clock::now();
    const auto guard = [&](double) {
      if (interrupted()) throw Interrupted{};
      if (study_.time_limit_s && seconds_since(begin) > *study_.time_limit_s) throw TooLong{};
    };
    std::optional<Case> out;
    try {
      out = answer_of(study_, cases_, number, kept(), guard);
    } catch (const Interrupted&) {
      return out;
    }
    if (out->series) keep_series(*std::exchange(out->series, {}), store_.folder(), out->row);
    return out;
  }

  void work(Queue& queue) {
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
  void fail() {
    const std::scoped_lock lock(mutex_);
    if (!failure_) failure_ = std::current_exception();
    stop_ = true;
  }

  /// A case whose numbers are others than the first one's has no place in the table.
  void require_columns(Case& of) const {
    const auto same = [](const Column& a, const Column& b) { return a.name == b.name && a.unit == b.unit; };
    const auto& columns = store_.columns();
    if (of.row.state != State::done ||
        std::equal(columns.begin(), columns.end(), of.columns.begin(), of.columns.end(), same))
      return;
    of.row.state = State::failed;
    of.row.numbers.clear();
    of.row.reason = "it tells other signals, or in other units, than the first case";
  }

  /// Whoever waits for more is told that there is none.
  static void end(Queue& queue) {
    queue.clear();
    queue.close();
  }

  void collect(Queue& queue, Clock::duration rest, const std::function<void()>& meanwhile) {
    constexpr auto between_commits = std::chrono::milliseconds(200);
    auto committed = Clock::now();
    for (bool active = true; active;) {
      if (interrupted()) end(queue);
      std::unique_lock lock(mutex_);
      changed_.wait_for(lock, rest, [&] { return active_ == 0; });
      active = active_ > 0;
      std::vector<Row> rows;
      if (!active || Clock::now() - committed >= between_commits) rows.swap(ready_);
      lock.unlock();
      if (!rows.empty()) keep(rows), committed = Clock::now();
      meanwhile();
    }
  }

  void keep(std::span<const Row> rows) {
    store_.put(rows);
    answered_ += rows.size();
    for (const Row& row : rows) seconds_ += row.seconds;
  }

  const Study& study_;
  const Cases& cases_;
  Store& store_;
  int threads_;
  std::function<bool()> asked_to_end_;
  std::shared_ptr<compile::Kept> kept_ = std::make_shared<compile::Kept>();
  std::size_t answered_ = 0;
  double seconds_ = 0;
  std::atomic<bool> stop_ = false;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Row> ready_;  // guarded, as are the two below and kept_
  int active_ = 0;
  std::exception_ptr failure_;
};

/// How often threads are looked after: without other ranks only to keep what is ready, else as often as messages come.
constexpr Clock::duration among_threads = std::chrono::milliseconds(200), among_ranks = std::chrono::milliseconds(2);

/// A sweep at work.
class Work {
 public:
  Work(const Study& study, const Cases& cases, Store& store, const Options& options, const Watch& watch)
      : study_(study),
        cases_(cases),
        store_(store),
        options_(options),
        watch_(watch),
        team_(study, cases, store, options.threads, watch.interrupted) {}

  Tally run() {
    remove_leftovers(store_.folder());
    const std::size_t unfinished = take_over_ranks(store_);
    choose();
    find_columns();
    if (!todo_.empty() && !team_.interrupted()) {
      if (watch_.expected && next_ < todo_.size())
        watch_.expected(todo_.size() - next_, team_.answered() > 0 ? team_.seconds_a_case() : known_seconds_a_case_);
      share_out();
    }
    if (options_.ranks != nullptr) {
      options_.ranks->finish(queue_, [this] { return team_.interrupted(); });
      take_over_ranks(store_);
    }
    return told(unfinished);
  }

 private:
  Tally told(std::size_t unfinished_ranks) const {
    Tally out = tally_of(store_);
    out.answered = over();
    out.interrupted = out.answered < todo_.size() && team_.interrupted();
    out.seconds = seconds_since(begin_);
    out.unfinished_ranks = unfinished_ranks;
    store_.close(out.over() == cases_.count());
    if (options_.ranks != nullptr && !options_.ranks->faults().empty() && !out.interrupted)
      throw InputError(options_.ranks->faults().front(), {},
                       "what was done is kept: mend that and run the same command");
    return out;
  }

  std::size_t over() const { return team_.answered() + (options_.ranks == nullptr ? 0 : options_.ranks->answered()); }

  /// What is to be answered; cases that are skipped are told to the store at once.
  void choose() {
    std::vector<bool> known(cases_.count() + 1, false);
    double seconds = 0;
    std::size_t done = 0;
    for (const Row& row : store_.rows()) {
      const bool redo = row.state == State::done ? study_.series && !has_series(store_.folder(), row)
                                                 : row.state == State::failed && options_.retry;
      known[row.number] = !redo;
      if (row.state == State::done) seconds += row.seconds, ++done;
    }
    if (done > 0) known_seconds_a_case_ = seconds / static_cast<double>(done);
    std::vector<Row> skipped;
    for (std::size_t n = options_.part; n <= cases_.count(); n += options_.parts) {
      if (known[n]) continue;
      if (auto reason = cases_.skipped(n)) {
        skipped.push_back(begun(cases_, n, State::skipped));
        skipped.back().reason = std::move(*reason);
      } else {
        todo_.push_back(n);
      }
    }
    store_.put(skipped);
  }

  /// Cases one by one until the first that has numbers: they name the columns of all.
  void find_columns() {
    while (store_.columns().empty() && next_ < todo_.size() && !team_.interrupted())
      if (team_.answer_one(todo_[next_])) ++next_;
  }

  /// The other cases, to threads and ranks.
  void share_out() {
    queue_.add({todo_.begin() + static_cast<std::ptrdiff_t>(next_), todo_.end()});
    queue_.close();
    if (options_.ranks != nullptr) options_.ranks->begin(store_.columns());
    team_.answer_all(queue_, options_.ranks == nullptr ? among_threads : among_ranks, [this] {
      if (options_.ranks != nullptr) options_.ranks->serve(queue_, team_.interrupted());
      if (watch_.progress) watch_.progress(static_cast<double>(over()) / static_cast<double>(todo_.size()));
    });
  }

  const Study& study_;
  const Cases& cases_;
  Store& store_;
  const Options& options_;
  const Watch& watch_;
  const Clock::time_point begin_ = Clock::now();
  Team team_;
  Queue queue_;
  std::vector<std::size_t> todo_;
  std::size_t next_ = 0;  // of todo_, that no thread has been given yet
  double known_seconds_a_case_ = 0;
};

}  // namespace

Row answer_case(const Study& study, const Cases& cases, std::size_t number, const std::shared_ptr<compile::Kept>& kept,
                const std::function<void(double)>& progress) {
  return answer_of(study, cases, number, kept, progress).row;
}

Tally carry_out(const Study& study, const Cases& cases, Store& store, const Options& options, const Watch& watch) {
  return Work(study, cases, store, options, watch).run();
}

void help_out(const Study& study, const Cases& cases, const fs::path& sweep, const Identity& identity, int threads,
              Helper& helper, const std::function<bool()>& interrupted) {
  const auto columns = helper.begun(interrupted);
  if (!columns || columns->empty()) return;
  Store store(folder_of_rank(sweep, helper.rank()), identity);
  if (store.columns().empty()) store.set_columns(*columns);
  Team team(study, cases, store, threads, [&] { return helper.stopped() || interrupted(); });
  Queue queue;
  team.answer_all(queue, among_ranks, [&] { helper.serve(queue, team.answered(), team.seconds_a_case()); });
  helper.serve(queue, team.answered(), team.seconds_a_case());
  store.close(false);
  if (interrupted() && !helper.stopped()) throw InputError("it was interrupted", {}, "");
}

Tally tally_of(const Store& store) {
  Tally out;
  constexpr std::size_t told = 5;
  for (const Row& row : store.rows()) {
    out.done += row.state == State::done ? 1U : 0U;
    out.skipped += row.state == State::skipped ? 1U : 0U;
    out.warned += row.warnings.empty() ? 0U : 1U;
    if (row.state != State::failed) continue;
    ++out.failed;
    if (out.failures.size() < told) out.failures.emplace_back(row.number, row.reason);
  }
  return out;
}

}  // namespace froude::sweep
