#pragma once
/// \file  Where the cases of a sweep are kept: an SQLite database in a folder that one process at a time may write.
///
/// Tables: `cases`, one row a case with its axes and numbers, named as in the study; `columns`, their units; `series`,
/// files of time series and the digests of their bytes; `work`, seconds and seals of rows; `study`, what the sweep is
/// of.
#include <cstddef>
#include <filesystem>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "sweep/cases.hpp"

struct sqlite3;

namespace froude::sweep {

/// What a sweep is of.
struct Identity {
  std::string definition;    ///< Cases::definition()
  std::string name;          ///< of the study's file
  std::string study, scene;  ///< their texts
  std::size_t cases = 0;
  std::vector<Column> axes;
};

enum class State { done, failed, skipped };

/// A case that is over.
struct Row {
  std::size_t number;
  State state;
  std::string reason;  ///< why it failed or was skipped, or why numbers of it are missing
  std::string warnings;
  std::vector<Cell> axes, numbers;  ///< one a column; no numbers unless it is done
  std::string series, digest;       ///< file below the folder, and what its bytes come to; empty where none is kept
  double seconds = 0;
};

class Store {
 public:
  /// Opens the sweep of a folder, which is made if there is none. \throws hydro::InputError where another process has
  /// it, where it is of another study, naming both and the first difference, or where nothing can be written
  Store(const std::filesystem::path& folder, const Identity& identity);
  /// Opens one that is there to read it: nothing of it is changed, in a folder that is read-only as well. Of a sweep
  /// that is at work it has what was over when it was opened. \throws hydro::InputError where there is none
  explicit Store(const std::filesystem::path& folder);
  ~Store();
  Store(const Store&) = delete;
  Store& operator=(const Store&) = delete;

  const std::filesystem::path& folder() const { return folder_; }
  const Identity& identity() const { return identity_; }
  /// \throws hydro::InputError unless the sweep is of this study
  void require_same(const Identity& asked) const;
  /// Of outputs; none before the first case is done.
  const std::vector<Column>& columns() const { return columns_; }
  void set_columns(const std::vector<Column>& columns);

  /// All of them or none. What was known of a case is replaced. \throws hydro::InputError where the disk is full or the
  /// like
  void put(std::span<const Row> rows);
  /// By rising number, without those that are no longer as they were written. \throws hydro::InputError for a damaged
  /// database
  std::vector<Row> rows() const;
  /// True if all cases are over.
  void close(bool whole);

 private:
  class Lock;
  void open(int flags);
  void create();
  void read();
  void execute(const std::string& sql) const;
  void set(const std::string& key, const std::string& value) const;

  std::filesystem::path folder_;
  std::unique_ptr<Lock> lock_;  ///< of what is written
  std::unique_ptr<sqlite3, int (*)(sqlite3*)> database_;
  Identity identity_;
  std::vector<Column> columns_;
};

/// The name of the database in its folder.
std::filesystem::path database_of(const std::filesystem::path& folder);

/// "done", "failed", "skipped"
const std::string& name_of(State state);

}  // namespace froude::sweep
