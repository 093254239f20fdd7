#pragma once
/// \file  Processes that share the cases of one sweep, which a launcher (mpirun, srun) has started together.
///
/// Rank 0 has the folder of the sweep and hands out its cases; each other rank keeps what it answers in a folder of its
/// own within it, rank-00001 and so on, which rank 0 takes over at the end, or when it starts again. Six kinds of
/// message pass:
///
///   rank 0 to r   begin, with the columns of the table; cases, an empty list if there are no more; stop; bye
///   r to rank 0   ask, when a thread of it waits; ended, with the reason if it is not that all is done
///
/// A rank goes when it has said `ended` and been told `bye`, so no message is ever left unread. That a rank has died
/// nobody tells rank 0: the launcher ends all others then, as MPI does, and what they had answered is in their folders.
#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sweep/cases.hpp"
#include "sweep/queue.hpp"

namespace froude::sweep {

/// How messages pass. Of each rank one thread alone uses it.
class Ranks {
 public:
  struct Message {
    int from;
    std::string text;
  };
  virtual ~Ranks() = default;
  virtual int rank() const = 0;
  virtual int count() const = 0;
  /// Those of one sender to one receiver arrive in their order.
  virtual void send(int to, const std::string& text) = 0;
  /// Does not wait.
  virtual std::optional<Message> received() = 0;
};

/// Rank 0's side.
class Master {
 public:
  explicit Master(Ranks& ranks) : ranks_(ranks), helped_(static_cast<std::size_t>(ranks.count())) {}

  int count() const { return ranks_.count(); }
  void begin(const std::vector<Column>& columns);
  /// Answers what the others have asked. `stop`: they get no more, and are told to end what they are at.
  void serve(Queue& cases, bool stop);
  /// The same until all have ended. Where nothing was begun they are told to stop.
  void finish(Queue& cases, const std::function<bool()>& stop);
  /// Ends the others wherever they are.
  void dismiss();

  std::size_t answered() const;                                       ///< by the others, as far as they have told
  const std::vector<std::string>& faults() const { return faults_; }  ///< why ranks have ended early

 private:
  struct Helped {
    std::size_t answered = 0;
    bool ended = false;
  };
  bool all_ended() const;
  void take(const Ranks::Message& message, Queue& cases, bool stop);

  Ranks& ranks_;
  std::vector<Helped> helped_;  ///< by rank; 0 is unused
  bool begun_ = false, stopped_ = false;
  std::vector<std::string> faults_;
};

/// The side of each other rank.
class Helper {
 public:
  explicit Helper(Ranks& ranks) : ranks_(ranks) {}

  int rank() const { return ranks_.rank(); }
  /// Does its work and says that it has ended, with what it throws as the reason; then waits for rank 0's bye.
  void run(const std::function<void()>& work);
  /// Waits for rank 0. None where there is nothing to do.
  std::optional<std::vector<Column>> begun(const std::function<bool()>& interrupted);
  /// Puts into the queue what has come, and asks for more where threads wait. `seconds_a_case`: 0 where none is known
  void serve(Queue& cases, std::size_t answered, double seconds_a_case);
  bool stopped() const { return stopped_; }

 private:
  void take(const std::string& text);

  Ranks& ranks_;
  std::optional<std::vector<Column>> columns_;
  std::vector<std::size_t> cases_;
  bool asked_ = false, no_more_ = false, stopped_ = false, dismissed_ = false;
  std::size_t answered_ = 0;
};

}  // namespace froude::sweep
