#pragma once
/// \file  Private to sweep: threads or processes that answer cases, each taken by the one that is free first.
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sweep/child.hpp"
#include "sweep/numbers.hpp"
#include "sweep/queue.hpp"
#include "sweep/store.hpp"

namespace froude::sweep {

/// A case answered, with what its row alone does not hold.
struct Case {
  Row row;
  std::vector<Column> columns;
  std::optional<Run> series;
};

/// A case that is over, or is about to be.
Row begun(const Cases& cases, std::size_t number, State state);

/// \throws hydro::InputError where the study itself is wrong, and what `progress` throws
Case answer_of(const Study& study, const Cases& cases, std::size_t number, const std::shared_ptr<compile::Kept>& kept,
               const std::function<void(double)>& progress);

/// Threads; where the study has limits processes, which alone can be ended wherever they are. All cases are kept in a
/// store, by the thread that calls.
class Team {
 public:
  using Clock = std::chrono::steady_clock;

  Team(const Study& study, const Cases& cases, Store& store, int count, std::function<bool()> interrupted);

  bool interrupted() const { return stop_ || (asked_to_end_ && asked_to_end_()); }
  std::size_t answered() const { return answered_; }
  double seconds_a_case() const { return answered_ > 0 ? seconds_ / static_cast<double>(answered_) : 0; }

  /// One case, whose numbers name the columns where the store has none yet. False where it was interrupted.
  bool answer_one(std::size_t number);

  /// All of the queue. This thread calls `meanwhile` every `rest`, and puts what is ready into the store a few times a
  /// second, each time in one transaction: on disk is what is older.
  void answer_all(Queue& queue, Clock::duration rest, const std::function<void()>& meanwhile);

 private:
  std::shared_ptr<compile::Kept> kept();
  std::optional<Case> one(std::size_t number);
  void require_columns(Case& of) const;
  void accept(Case& found);
  void keep(std::span<const Row> rows);
  void keep_now_and_then(bool now);

  void by_threads(Queue& queue, Clock::duration rest, const std::function<void()>& meanwhile);
  void work(Queue& queue);
  void collect(Queue& queue, Clock::duration rest, const std::function<void()>& meanwhile);
  void fail();

  using Process = std::unique_ptr<Child>;  // none: it is begun when there is a case for it
  bool has_limits() const { return study_.time_limit_s || study_.memory_limit_bytes; }
  void by_processes(Queue& queue, Clock::duration rest, const std::function<void()>& meanwhile);
  void give(Process& process, Queue& queue);
  std::string told(std::size_t number);
  std::size_t at_work() const;
  void wait(Clock::duration rest) const;
  void look_after(Process& process);
  void lost(Process& process, std::size_t number, const std::string& reason);
  void failed(std::size_t number, const std::string& reason, double seconds);

  const Study& study_;
  const Cases& cases_;
  Store& store_;
  int count_;
  std::function<bool()> asked_to_end_;
  std::shared_ptr<compile::Kept> kept_;
  std::size_t answered_ = 0;
  double seconds_ = 0;
  Clock::time_point committed_ = Clock::now();
  std::vector<Row> ready_;  // guarded, as are kept_, active_ and failure_

  std::atomic<bool> stop_ = false;
  std::mutex mutex_;
  std::condition_variable changed_;
  int active_ = 0;
  std::exception_ptr failure_;

  std::vector<Process> processes_;
  std::vector<std::size_t> again_;  // cases for a process that has answered none before
};

}  // namespace froude::sweep
