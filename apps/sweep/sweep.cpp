#include "sweep/sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <set>

#include "hydro/base/error.hpp"
#include "sweep/ranks.hpp"
#include "sweep/series.hpp"
#include "sweep/team.hpp"

namespace froude::sweep {
namespace {

namespace fs = std::filesystem;
using Clock = Team::Clock;
using hydro::InputError;

/// What a process that was killed has left behind.
void remove_leftovers(const fs::path& folder) {
  std::error_code failed;
  for (const fs::path& at : {folder, folder / "series"})
    for (fs::directory_iterator file(at, failed), end; !failed && file != end; file.increment(failed))
      if (file->path().string().ends_with(".froude.tmp")) fs::remove(file->path(), failed);
}

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
    Tally out = told(unfinished);
    if (!out.interrupted) require_whole();
    return out;
  }

 private:
  /// \throws hydro::InputError where ranks have failed, or have kept their cases where nobody finds them
  void require_whole() const {
    if (options_.ranks == nullptr) return;
    if (const auto& faults = options_.ranks->faults(); !faults.empty())
      throw InputError(faults.front(), {}, "what was done is kept: mend that and run the same command");
    std::set<std::size_t> lost(todo_.begin(), todo_.end());
    for (const Row& row : store_.rows()) lost.erase(row.number);
    if (!lost.empty())
      throw InputError(fmt::format("ranks have answered {} cases that are not in \"{}\", case {} among them: their "
                                   "machines see another folder of that name",
                                   lost.size(), store_.folder().string(), *lost.begin()),
                       {}, "name a folder that all machines share with -o, or give each machine a --part");
  }

  Tally told(std::size_t unfinished_ranks) const {
    Tally out = tally_of(store_);
    out.answered = over();
    out.interrupted = out.answered < todo_.size() && team_.interrupted();
    out.seconds = std::chrono::duration<double>(Clock::now() - begin_).count();
    out.unfinished_ranks = unfinished_ranks;
    store_.close(out.over() == cases_.count());
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
