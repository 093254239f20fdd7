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

#include "hydro/base/digest.hpp"
#include "hydro/base/error.hpp"
#include "hydro/io/atomic_file.hpp"

namespace froude::sweep {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using hydro::InputError;

double seconds_since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

/// Thrown through a run that is to end.
struct Interrupted {};
struct TooLong {};

/// "series/case-000017.run.h5"
fs::path series_of(std::size_t number) { return fs::path("series") / fmt::format("case-{:06}.run.h5", number); }

std::string digest_of(const fs::path& file) {
  return fmt::format("{:016x}", hydro::digest(hydro::io::read_text(file)));
}

bool has_series(const Store& store, const Row& row) {
  std::error_code unknown;
  const fs::path file = store.folder() / row.series;
  return !row.series.empty() && fs::is_regular_file(file, unknown) && digest_of(file) == row.digest;
}

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
Case answered(const Study& study, const Cases& cases, std::size_t number, const std::shared_ptr<compile::Kept>& kept,
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

/// A sweep at work.
class Work {
 public:
  Work(const Study& study, const Cases& cases, Store& store, const Options& options, const Watch& watch)
      : study_(study), cases_(cases), store_(store), options_(options), watch_(watch) {}

  Tally run() {
    remove_leftovers(store_.folder());
    if (study_.series) fs::create_directories(store_.folder() / "series");
    choose();
    find_columns();
    if (!todo_.empty() && !interrupted()) {
      if (watch_.expected && next_ < todo_.size()) watch_.expected(todo_.size() - next_, seconds_a_case_);
      go_on();
    }
    Tally out = tally_of(store_);
    out.interrupted = over_ < todo_.size() && interrupted();
    out.answered = over_;
    out.seconds = seconds_since(begin_);
    store_.close(out.over() == cases_.count());
    return out;
  }

 private:
  bool interrupted() const { return stop_ || (watch_.interrupted && watch_.interrupted()); }

  /// What is to be answered; cases that are skipped are told to the store at once.
  void choose() {
    std::vector<bool> known(cases_.count() + 1, false);
    double seconds = 0;
    std::size_t done = 0;
    for (const Row& row : store_.rows()) {
      const bool redo = row.state == State::done ? study_.series && !has_series(store_, row)
                                                 : row.state == State::failed && options_.retry;
      known[row.number] = !redo;
      if (row.state == State::done) seconds += row.seconds, ++done;
    }
    if (done > 0) seconds_a_case_ = seconds / static_cast<double>(done);
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
    while (store_.columns().empty() && next_ < todo_.size() && !interrupted()) {
      auto found = one(todo_[next_]);
      if (!found) return;
      if (found->row.state == State::done) {
        store_.set_columns(found->columns);
        seconds_a_case_ = found->row.seconds;
      }
      store_.put({&found->row, 1});
      ++next_;
      ++over_;
    }
  }

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
      out = answered(study_, cases_, number, kept(), guard);
    } catch (const Interrupted&) {
      return out;
    }
    keep_series(*out);
    return out;
  }

  void keep_series(Case& of) const {
    if (!of.series) return;
    of.row.series = series_of(of.row.number).string();
    const fs::path file = store_.folder() / of.row.series;
    of.series->write(file);
    of.row.digest = digest_of(file);
    of.series.reset();
  }

  /// The other cases, each taken by the thread that is free first.
  void go_on() {
    std::vector<std::thread> threads;
    active_ = options_.threads;
    for (int t = 0; t < options_.threads; ++t) threads.emplace_back([this] { work(); });
    try {
      collect();
    } catch (...) {
      fail();
    }
    for (std::thread& thread : threads) thread.join();
    if (failure_) std::rethrow_exception(failure_);
  }

  void work() {
    try {
      while (!interrupted()) {
        const std::size_t at = next_++;
        if (at >= todo_.size()) break;
        auto found = one(todo_[at]);
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

  /// What is ready goes into the store a few times a second, each time in one transaction: on disk is what is older.
  void collect() {
    constexpr auto rest = std::chrono::milliseconds(200);
    for (bool active = true; active;) {
      std::unique_lock lock(mutex_);
      changed_.wait_for(lock, rest, [&] { return active_ == 0; });
      active = active_ > 0;
      const std::vector<Row> rows = std::exchange(ready_, {});
      lock.unlock();
      store_.put(rows);
      over_ += rows.size();
      if (watch_.progress) watch_.progress(static_cast<double>(over_) / static_cast<double>(todo_.size()));
    }
  }

  const Study& study_;
  const Cases& cases_;
  Store& store_;
  const Options& options_;
  const Watch& watch_;
  const Clock::time_point begin_ = Clock::now();
  std::shared_ptr<compile::Kept> kept_ = std::make_shared<compile::Kept>();
  std::vector<std::size_t> todo_;
  std::size_t over_ = 0;
  double seconds_a_case_ = 0;
  std::atomic<std::size_t> next_ = 0;
  std::atomic<bool> stop_ = false;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Row> ready_;  // guarded, as are the two below and kept_
  int active_ = 0;
  std::exception_ptr failure_;
};

/// The same case of two sweeps. What takes time, and how often it was tried, may differ.
bool agree(const Row& a, const Row& b) {
  return a.state == b.state && a.reason == b.reason && a.warnings == b.warnings && a.axes == b.axes &&
         a.numbers == b.numbers;
}

void copy_series(const Store& from, const Row& row, const Store& into) {
  if (row.series.empty()) return;
  if (!has_series(from, row))
    throw InputError(fmt::format("\"{}\" is torn or missing", (from.folder() / row.series).string()), {},
                     "run that sweep again, which redoes the case");
  fs::create_directories((into.folder() / row.series).parent_path());
  hydro::io::write_atomically(into.folder() / row.series, hydro::io::read_text(from.folder() / row.series));
}

/// True if a row adds to what is known of its case. \throws hydro::InputError where the two contradict each other
bool adds(const Store& from, const Row& row, const Store& into, const Row& known) {
  if (known.state != row.state) return known.state == State::failed;
  if (!agree(known, row))
    throw InputError(fmt::format("case {} of \"{}\" has other numbers than that of \"{}\"", row.number,
                                 from.folder().string(), into.folder().string()),
                     {}, "run it again with the same program: `froude sweep -o` another folder");
  return !row.series.empty() && !has_series(into, known);
}

void take_over(const Store& from, Store& into) {
  if (into.columns().empty() && !from.columns().empty()) into.set_columns(from.columns());
  std::map<std::size_t, Row> known;
  for (Row& row : into.rows()) known.emplace(row.number, std::move(row));
  std::vector<Row> taken;
  for (Row& row : from.rows()) {
    const auto at = known.find(row.number);
    if (at != known.end() && !adds(from, row, into, at->second)) continue;
    copy_series(from, row, into);
    taken.push_back(std::move(row));
  }
  into.put(taken);
}

}  // namespace

Row answer_case(const Study& study, const Cases& cases, std::size_t number, const std::shared_ptr<compile::Kept>& kept,
                const std::function<void(double)>& progress) {
  return answered(study, cases, number, kept, progress).row;
}

Tally carry_out(const Study& study, const Cases& cases, Store& store, const Options& options, const Watch& watch) {
  return Work(study, cases, store, options, watch).run();
}

void merge(const std::vector<fs::path>& folders, Store& into) {
  for (const fs::path& folder : folders) {
    const Store from(folder);
    from.require_same(into.identity());
    take_over(from, into);
  }
  into.close(tally_of(into).over() == into.identity().cases);
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
