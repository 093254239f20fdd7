#include "sweep/store.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sqlite3.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <set>
#include <sstream>
#include <system_error>

#include "hydro/base/digest.hpp"
#include "hydro/base/error.hpp"

namespace froude::sweep {
namespace {

namespace fs = std::filesystem;
using hydro::InputError;

const std::array<std::string, 3> state_names{"done", "failed", "skipped"};

[[noreturn]] void refuse(const fs::path& folder, sqlite3* database, int code) {
  const int kind = code & 0xff;
  const std::string remedy =
      kind == SQLITE_FULL || kind == SQLITE_IOERR ? "free some space and run the same command: what was done is kept"
      : kind == SQLITE_CORRUPT || kind == SQLITE_NOTADB
          ? "take the file away and run the sweep again; series that are whole are made again too"
          : "name a folder that you may write to with -o";
  throw InputError(fmt::format("cannot use \"{}\": {}", database_of(folder).string(),
                               database == nullptr ? sqlite3_errstr(code) : sqlite3_errmsg(database)),
                   {}, remedy);
}

/// A name or a text in SQL.
std::string quoted(const std::string& name, char quote) {
  std::string out(1, quote);
  for (const char c : name) out += c == quote ? std::string(2, c) : std::string(1, c);
  return out + quote;
}
std::string identifier(const std::string& name) { return quoted(name, '"'); }

/// A statement with values in its places, stepped row by row.
class Statement {
 public:
  Statement(const fs::path& folder, sqlite3* database, const std::string& sql) : folder_(folder), database_(database) {
    check(sqlite3_prepare_v2(database, sql.c_str(), -1, &statement_, nullptr));
  }
  ~Statement() { sqlite3_finalize(statement_); }
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;

  Statement& add(const Cell& cell) {
    const int at = ++bound_;
    if (const auto* number = std::get_if<double>(&cell); number != nullptr && !std::isnan(*number))
      check(sqlite3_bind_double(statement_, at, *number));
    else if (const auto* text = std::get_if<std::string>(&cell))
      check(sqlite3_bind_text(statement_, at, text->data(), static_cast<int>(text->size()), SQLITE_TRANSIENT));
    else
      check(sqlite3_bind_null(statement_, at));
    return *this;
  }
  Statement& add(std::size_t number) {
    check(sqlite3_bind_int64(statement_, ++bound_, static_cast<sqlite3_int64>(number)));
    return *this;
  }
  /// True if there is a row.
  bool step() {
    const int code = sqlite3_step(statement_);
    if (code != SQLITE_ROW && code != SQLITE_DONE) check(code);
    return code == SQLITE_ROW;
  }
  void run() {
    step();
    check(sqlite3_reset(statement_));
    bound_ = 0;
  }

  Cell cell(int at) const {
    if (sqlite3_column_type(statement_, at) == SQLITE_NULL) return {};
    if (sqlite3_column_type(statement_, at) == SQLITE_TEXT) return text(at);
    return sqlite3_column_double(statement_, at);
  }
  std::string text(int at) const {
    const unsigned char* value = sqlite3_column_text(statement_, at);
    return value == nullptr ? std::string() : std::string(reinterpret_cast<const char*>(value));
  }
  std::size_t number(int at) const { return static_cast<std::size_t>(sqlite3_column_int64(statement_, at)); }
  double real(int at) const { return sqlite3_column_double(statement_, at); }

 private:
  void check(int code) const {
    if (code != SQLITE_OK) refuse(folder_, database_, code);
  }
  const fs::path& folder_;
  sqlite3* database_;
  sqlite3_stmt* statement_ = nullptr;
  int bound_ = 0;
};

/// Names that SQLite takes for one, since it does not tell capitals apart, or has no room for.
void require_distinct(const std::vector<Column>& axes, const std::vector<Column>& columns) {
  std::set<std::string> taken{"case", "state", "reason", "warnings"};
  for (const auto* all : {&axes, &columns})
    for (const Column& column : *all) {
      std::string name = column.name;
      std::transform(name.begin(), name.end(), name.begin(),
                     [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
      if (!taken.insert(name).second)
        throw InputError(fmt::format("two columns of the table are called \"{}\"", column.name), {},
                         "let each output tell something else, and give axes other names");
    }
  constexpr std::size_t most = 2000;  // SQLite's
  if (taken.size() > most)
    throw InputError(fmt::format("the study tells {} numbers a case, and a table holds {}", taken.size(), most), {},
                     "name fewer signals or statistics");
}

std::string text_of(const Cell& cell) {
  if (const auto* number = std::get_if<double>(&cell)) return fmt::format("{}", *number);
  const auto* text = std::get_if<std::string>(&cell);
  return text == nullptr ? "" : *text;
}

/// By which a row is known to be what was written: SQLite does not look whether bytes of a value have changed on the
/// disk.
std::string seal_of(const Row& row) {
  std::string all = fmt::format("{}\n{}\n{}\n{}\n{}\n{}", row.number, name_of(row.state), row.reason, row.warnings,
                                row.series, row.digest);
  for (const auto* cells : {&row.axes, &row.numbers})
    for (const Cell& cell : *cells) all += '\n' + text_of(cell);
  return fmt::format("{:016x}", hydro::digest(all));
}

/// The same of what is known beside the rows: names and units of their columns above all.
std::string seal_of(const Identity& identity, const std::vector<Column>& columns) {
  std::string all = fmt::format("{}\n{}\n{}\n{}\n{}", identity.definition, identity.name, identity.study,
                                identity.scene, identity.cases);
  for (const auto* of : {&identity.axes, &columns})
    for (const Column& c : *of) all += fmt::format("\n{}\n{}\n{}", c.name, c.unit, c.is_text);
  return fmt::format("{:016x}", hydro::digest(all));
}

/// The first line in which two definitions differ.
std::pair<std::string, std::string> difference(const std::string& a, const std::string& b) {
  std::istringstream in_a(a), in_b(b);
  std::string x, y;
  do {
    if (!std::getline(in_a, x)) x = "nothing";
    if (!std::getline(in_b, y)) y = "nothing";
  } while (x == y && in_a && in_b);
  return {x, y};
}

}  // namespace

/// Held as long as the process lives, however it ends.
class Store::Lock {
 public:
  explicit Lock(const fs::path& folder) {
    const fs::path path = folder / "lock";
    file_ = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
    if (file_ < 0)
      throw InputError(fmt::format("cannot write \"{}\": {}", path.string(), std::generic_category().message(errno)),
                       {}, "name a folder that you may write to with -o");
    if (::flock(file_, LOCK_EX | LOCK_NB) == 0) return;
    ::close(file_);
    throw InputError(fmt::format("another sweep is at work in \"{}\"", folder.string()), {},
                     "wait for it, or name another folder with -o");
  }
  ~Lock() { ::close(file_); }
  Lock(const Lock&) = delete;
  Lock& operator=(const Lock&) = delete;

 private:
  int file_ = -1;
};

fs::path database_of(const fs::path& folder) { return folder / "sweep.sqlite"; }
const std::string& name_of(State state) { return state_names[static_cast<std::size_t>(state)]; }

Store::Store(const fs::path& folder, const Identity& identity)
    : folder_(folder), database_(nullptr, &sqlite3_close), identity_(identity) {
  std::error_code failed;
  fs::create_directories(folder, failed);
  if (failed)
    throw InputError(fmt::format("cannot make the folder \"{}\": {}", folder.string(), failed.message()), {},
                     "name another one with -o");
  lock_ = std::make_unique<Lock>(folder);
  open(SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE);
  // A commit is on the disk when it returns, and a reader sees the last one while the next is written.
  execute("PRAGMA journal_mode = WAL; PRAGMA synchronous = FULL");
  Statement known(folder_, database_.get(), "SELECT count(*) FROM sqlite_master WHERE name = 'study'");
  known.step();
  if (known.number(0) == 0) {
    create();
  } else {
    read();
    require_same(identity);
  }
}

Store::Store(const fs::path& folder) : folder_(folder), database_(nullptr, &sqlite3_close) {
  std::error_code unknown;
  if (!fs::is_regular_file(database_of(folder), unknown))
    throw InputError(fmt::format("there is no sweep in \"{}\"", folder.string()), {},
                     "name a folder that `froude sweep` has written");
  open(SQLITE_OPEN_READONLY);
  execute("BEGIN");  // columns and rows of one moment
  read();
}

Store::~Store() = default;

void Store::open(int flags) {
  sqlite3* database = nullptr;
  const int code = sqlite3_open_v2(database_of(folder_).c_str(), &database, flags | SQLITE_OPEN_FULLMUTEX, nullptr);
  database_.reset(database);
  if (code != SQLITE_OK) refuse(folder_, database, code);
  execute("PRAGMA busy_timeout = 10000");
}

void Store::execute(const std::string& sql) const {
  const int code = sqlite3_exec(database_.get(), sql.c_str(), nullptr, nullptr, nullptr);
  if (code != SQLITE_OK) refuse(folder_, database_.get(), code);
}

void Store::set(const std::string& key, const std::string& value) const {
  Statement(folder_, database_.get(), "INSERT OR REPLACE INTO study VALUES (?, ?)")
      .add(Cell(key))
      .add(Cell(value))
      .run();
}

void Store::create() {
  require_distinct(identity_.axes, {});
  std::string axes;
  for (const Column& c : identity_.axes)
    axes += fmt::format(", {} {}", identifier(c.name), c.is_text ? "TEXT" : "REAL");
  execute("BEGIN IMMEDIATE");
  execute(
      "CREATE TABLE study (key TEXT PRIMARY KEY, value TEXT);"
      "CREATE TABLE columns (name TEXT, unit TEXT, of TEXT, is_text INTEGER);"
      "CREATE TABLE series (\"case\" INTEGER PRIMARY KEY, file TEXT, digest TEXT);"
      "CREATE TABLE work (\"case\" INTEGER PRIMARY KEY, seconds REAL, seal TEXT);"
      "CREATE TABLE cases (\"case\" INTEGER PRIMARY KEY, state TEXT NOT NULL, reason TEXT, warnings TEXT" +
      axes + ")");
  Statement column(folder_, database_.get(), "INSERT INTO columns VALUES (?, ?, 'axis', ?)");
  for (const Column& c : identity_.axes)
    column.add(Cell(c.name)).add(Cell(c.unit)).add(static_cast<std::size_t>(c.is_text)).run();
  set("definition", identity_.definition);
  set("name", identity_.name);
  set("study", identity_.study);
  set("scene", identity_.scene);
  set("cases", std::to_string(identity_.cases));
  set("version", FROUDE_VERSION);
  set("state", "partial");
  set("seal", seal_of(identity_, {}));
  execute("COMMIT");
}

void Store::read() {
  // Rows out of their order would be found by one question and not by another.
  Statement check(folder_, database_.get(), "PRAGMA quick_check(1)");
  if (!check.step() || check.text(0) != "ok") refuse(folder_, nullptr, SQLITE_CORRUPT);
  Statement entries(folder_, database_.get(), "SELECT key, value FROM study");
  std::map<std::string, std::string> all;
  while (entries.step()) all[entries.text(0)] = entries.text(1);
  identity_ = {all["definition"],
               all["name"],
               all["study"],
               all["scene"],
               static_cast<std::size_t>(std::strtoull(all["cases"].c_str(), nullptr, 10)),
               {}};
  Statement columns(folder_, database_.get(), "SELECT name, unit, of, is_text FROM columns ORDER BY rowid");
  while (columns.step())
    (columns.text(2) == "axis" ? identity_.axes : columns_)
        .push_back({columns.text(0), columns.text(1), columns.number(3) != 0});
  if (all["seal"] != seal_of(identity_, columns_)) refuse(folder_, nullptr, SQLITE_CORRUPT);
}

void Store::require_same(const Identity& asked) const {
  if (asked.definition == identity_.definition) return;
  const auto [there, here] = difference(identity_.definition, asked.definition);
  throw InputError(fmt::format("\"{}\" holds a sweep of {}, which is another study than {}: \"{}\" there, \"{}\" here",
                               folder_.string(), identity_.name, asked.name, there, here),
                   {}, "name another folder with -o, or take the change back");
}

void Store::set_columns(const std::vector<Column>& columns) {
  require_distinct(identity_.axes, columns);
  execute("BEGIN IMMEDIATE");
  Statement column(folder_, database_.get(), "INSERT INTO columns VALUES (?, ?, 'output', 0)");
  for (const Column& c : columns) {
    execute(fmt::format("ALTER TABLE cases ADD COLUMN {} REAL", identifier(c.name)));
    column.add(Cell(c.name)).add(Cell(c.unit)).run();
  }
  set("seal", seal_of(identity_, columns));
  execute("COMMIT");
  columns_ = columns;
}

void Store::put(std::span<const Row> rows) {
  if (rows.empty()) return;
  std::string places = "?, ?, ?, ?";
  for (std::size_t i = 0; i < identity_.axes.size() + columns_.size(); ++i) places += ", ?";
  Statement cases(folder_, database_.get(), "INSERT OR REPLACE INTO cases VALUES (" + places + ")");
  Statement series(folder_, database_.get(), "INSERT OR REPLACE INTO series VALUES (?, ?, ?)");
  Statement work(folder_, database_.get(), "INSERT OR REPLACE INTO work VALUES (?, ?, ?)");
  const auto or_null = [](const std::string& text) { return text.empty() ? Cell() : Cell(text); };
  execute("BEGIN IMMEDIATE");
  for (const Row& row : rows) {
    cases.add(row.number).add(Cell(name_of(row.state))).add(or_null(row.reason)).add(or_null(row.warnings));
    for (const Cell& cell : row.axes) cases.add(cell);
    for (std::size_t i = 0; i < columns_.size(); ++i) cases.add(row.numbers.empty() ? Cell() : row.numbers[i]);
    cases.run();
    if (!row.series.empty()) series.add(row.number).add(Cell(row.series)).add(Cell(row.digest)).run();
    work.add(row.number).add(row.state == State::skipped ? Cell() : Cell(row.seconds)).add(Cell(seal_of(row))).run();
  }
  execute("COMMIT");
}

std::vector<Row> Store::rows() const {
  std::vector<std::string> names;
  for (const auto* all : {&identity_.axes, &columns_})
    for (const Column& c : *all) names.push_back("cases." + identifier(c.name));
  Statement all(
      folder_, database_.get(),
      fmt::format("SELECT cases.\"case\", cases.state, cases.reason, cases.warnings, series.file, series.digest, "
                  "work.seconds, work.seal, {} FROM cases "
                  "LEFT JOIN series ON series.\"case\" = cases.\"case\" "
                  "LEFT JOIN work ON work.\"case\" = cases.\"case\" ORDER BY cases.\"case\"",
                  fmt::join(names, ", ")));
  std::vector<Row> out;
  while (all.step()) {
    const auto state = std::find(state_names.begin(), state_names.end(), all.text(1)) - state_names.begin();
    if (state == std::ssize(state_names)) refuse(folder_, nullptr, SQLITE_CORRUPT);
    Row row{.number = all.number(0),
            .state = static_cast<State>(state),
            .reason = all.text(2),
            .warnings = all.text(3),
            .axes = {},
            .numbers = {},
            .series = all.text(4),
            .digest = all.text(5),
            .seconds = all.real(6)};
    int at = 8;
    for (std::size_t i = 0; i < identity_.axes.size(); ++i) row.axes.push_back(all.cell(at++));
    if (row.state == State::done)
      for (std::size_t i = 0; i < columns_.size(); ++i) row.numbers.push_back(all.cell(at++));
    if (all.text(7) == seal_of(row)) out.push_back(std::move(row));
  }
  return out;
}

void Store::close(bool whole) {
  set("state", whole ? "complete" : "partial");
  // One file, which opens from a folder that is read-only as well; as long as somebody else reads, it stays as it is.
  sqlite3_busy_timeout(database_.get(), 0);
  const int code = sqlite3_exec(database_.get(), "PRAGMA journal_mode = DELETE", nullptr, nullptr, nullptr);
  if (code != SQLITE_OK && code != SQLITE_BUSY && code != SQLITE_LOCKED) refuse(folder_, database_.get(), code);
}

}  // namespace froude::sweep
