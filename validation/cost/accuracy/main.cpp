/// \file  Writes the table of the promise that runs keep the accuracy asked: docs/cost/accuracy.md. See README.md.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <iostream>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "hydro/base/error.hpp"
#include "hydro/io/atomic_file.hpp"
#include "support/drawn_scenes.hpp"
#include "support/promise.hpp"
#include "support/source_dir.hpp"

namespace froude::cost {
namespace {

namespace fs = std::filesystem;
using support::Judgement, support::Reference, support::Runs, support::Subject;

constexpr std::array accuracies{1e-1, 1e-2, 1e-3};

/// Seconds of processor time.
double now() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

/// Scenes of examples and of validation, as long as a reference takes a minute at most, and some that are drawn, which
/// are written to `drawn`.
std::vector<Subject> subjects(const fs::path& data, const fs::path& drawn) {
  struct Written {
    const char* path;
    double longest;  // s
  };
  constexpr Written written[] = {{"examples/buoy.toml", 60},
                                 {"examples/chained.toml", 6},
                                 {"examples/cylinders.toml", 40},
                                 {"examples/dropper.toml", 9},
                                 {"examples/fenders.toml", 25},
                                 {"examples/forced.toml", 40},
                                 {"examples/hinged.toml", 40},
                                 {"examples/latched.toml", 40},
                                 {"examples/longline.toml", 8},
                                 {"examples/moored.toml", 40},
                                 {"examples/mussels.toml", 18},
                                 {"examples/pontoon5.toml", 40},
                                 {"examples/reed.toml", 20},
                                 {"examples/roll.toml", 15},
                                 {"examples/switching.toml", 40},
                                 {"examples/takeoff.toml", 40},
                                 {"examples/wild.toml", 60},
                                 {"validation/huijgen-damping/dropper.toml", 12},
                                 {"validation/rm3-decay/scene.toml", 40},
                                 {"validation/rm3-regular/scene.toml", 60},
                                 {"validation/sphere-decay/scene.toml", 40}};
  const fs::path root = froude_test::source_dir();
  std::vector<Subject> out;
  for (const Written& w : written) {
    const fs::path file = root / w.path;
    const bool example = file.parent_path().filename() == "examples";
    out.push_back({(example ? file.stem() : file.parent_path().filename()).string(),
                   replaced(hydro::io::read_text(file), "../../../shared/data/", data.string() + "/"), file,
                   w.longest});
  }
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    out.push_back({fmt::format("drawn {}", seed), support::drawn_scene(seed), root / "examples/drawn.toml", 60});
    hydro::io::write_atomically(drawn / fmt::format("drawn_{}.toml", seed), out.back().text);
  }
  return out;
}

/// One subject at one accuracy.
struct Row {
  double accuracy;
  std::optional<Run> run;  // empty: refused,
  std::string why;         // and why
  double seconds;
};

Row row_of(const Runs& runs, double accuracy) {
  const double begin = now();
  Row out{accuracy, {}, {}, 0};
  try {
    out.run = runs.of(runs.read(accuracy));
  } catch (const std::runtime_error& e) {
    out.why = e.what();
  }
  out.seconds = now() - begin;
  return out;
}

/// What the bench counts.
struct Tally {
  int rows = 0, kept = 0, told = 0, missed = 0, rightly = 0, needlessly = 0, by_memory = 0;
  double worst = 0;  // error over what was asked, of what was neither refused nor told
};

std::string text_of(const Row& row, const Runs& runs, const Reference& reference, Tally& tally) {
  ++tally.rows;
  const std::string begin = fmt::format("| {} | {:.0e} |", runs.subject().name, row.accuracy);
  const auto refused = [&](const char* how) {
    return fmt::format("{} | | | | | | {} | {:.2g} |\n", begin, how, row.seconds);
  };
  if (!row.run && row.why.find("memory of radiated waves") != std::string::npos) {
    ++tally.by_memory;
    return refused("refused: memory");
  }
  if (!row.run) {
    const bool rightly = support::is_out_of_reach(runs, reference, row.accuracy);
    ++(rightly ? tally.rightly : tally.needlessly);
    return refused(rightly ? "refused" : "refused needlessly");
  }
  const Judgement j = support::judge(*row.run, reference, row.accuracy);
  const bool kept = j.error <= row.accuracy, estimated = row.run->error.missing.empty();
  const double estimate = estimated ? row.run->error.total(j.signal) : 0;
  const bool told = estimate > row.accuracy;  // with a warning: of what the scene gives, such as segments
  ++(kept ? tally.kept : told ? tally.told : tally.missed);
  if (!told) tally.worst = std::max(tally.worst, j.error / row.accuracy);
  return fmt::format(
      "{} {:.4g} | {} | {:.1e} | {} | {:.4g} | {} | {} | {:.2g} |\n", begin, row.run->step,
      estimated ? fmt::format("{:.1e}", estimate) : "none", j.error, row.run->signals[j.signal].name, j.until,
      estimate > 0 && j.error > 0 ? fmt::format("{:.2g}", estimate / j.error) : "",
      kept ? "kept" : fmt::format("{} {:.1f} times", told ? "told, missed" : "missed", j.error / row.accuracy),
      row.seconds);
}

/// By how much a run differs from one that is finer in one thing alone.
std::string sources(const Runs& runs, double accuracy) {
  const scene::Scene scene = runs.read(accuracy);
  try {
    const Run run = runs.accepted(accuracy, {});
    const auto of = [&](const support::Finer& finer) {
      const Run fine = runs.accepted(accuracy, finer);
      const Judgement j =
          support::judge(run, {fine, fine, "", finer.links ? support::cut_in_three(scene) : std::nullopt}, accuracy);
      return j.error > 0 ? fmt::format("{:.1e}, {}", j.error, run.signals[j.signal].name) : std::string();
    };
    const bool with_memory = runs.subject().text.find("radiation = {") != std::string::npos;
    return fmt::format("| {} | {} | {} | {} |\n", runs.subject().name, of({.step = run.step / 10}),
                       with_memory ? of({.step = run.step, .memory = true}) : "",
                       scene::approximates_lines(scene) ? of({.step = run.step, .links = true}) : "");
  } catch (const std::runtime_error& e) {
    return fmt::format("| {} | not run | | |\n", runs.subject().name);
  }
}

struct Tables {
  std::string promise, references, dominant;
  Tally tally;
};

void add(const Subject& subject, Tables& tables) {
  const Runs runs(subject);
  std::vector<Row> rows;
  double finest = std::numeric_limits<double>::infinity();
  for (const double accuracy : accuracies) {
    rows.push_back(row_of(runs, accuracy));
    if (rows.back().run) finest = std::min(finest, rows.back().run->step);
  }
  if (!std::isfinite(finest)) finest = runs.accepted(accuracies.front(), {}).step;
  const double begin = now();
  const Reference r = support::reference(runs, finest);
  tables.references += fmt::format("| {} | {} | {:.3g} | {:.1e} | {:.2g} |\n", subject.name, r.method, r.run.step,
                                   support::judge(r.second, {r.run, r.run, "", {}}, 1).error, now() - begin);
  for (const Row& row : rows) tables.promise += text_of(row, runs, r, tables.tally);
  tables.dominant += sources(runs, 1e-2);
}

std::string page(const Tables& tables) {
  const Tally& t = tables.tally;
  std::string text =
      "# Is the accuracy asked kept?\n\nWritten by `price_accuracy` (validation/cost/accuracy), which says how.\n\n"
      "| runs | kept | refused, and out of reach | refused for the memory | told of what is given | missed | refused "
      "needlessly | largest error of what was neither refused nor told, over what was asked |\n| --- | --- | --- | --- "
      "| --- | --- | --- | --- |\n";
  text += fmt::format("| {} | {} | {} | {} | {} | {} | {} | {:.2g} |\n\n", t.rows, t.kept, t.rightly, t.by_memory,
                      t.told, t.missed, t.needlessly, t.worst);
  text +=
      "Refused for the memory: no method comes nearer to the coefficients than the one taken, and what it leaves out "
      "is "
      "estimated to make more of the motion than was asked; references have the same memory and cannot judge that. "
      "Motions of known solution do: tests/apps/compile/defect_test.cpp.\n\n"
      "The error of a signal is the largest of three: rms over its rms, that of its standard deviation over itself, "
      "and that of its lowest or highest value over the one farther from 0; over no less than a thousandth of the "
      "largest rms of its unit, nor than what rounding leaves. Shown is the signal whose error is largest. It is "
      "judged up to the time until which two references agree within a fifth of the accuracy, and the run says that it "
      "can be predicted.\n\n"
      "| scene | asked | step [s] | estimated | true | signal | until [s] | estimated over true | promise | time [s] "
      "|\n"
      "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n" +
      tables.promise;
  text +=
      "\n## References\n\nThe last but one column is by how much the second reference, with twice the step, differs "
      "from "
      "the first over the whole run.\n\n"
      "| scene | method | step [s] | unsure by | time of both [s] |\n| --- | --- | --- | --- | --- |\n" +
      tables.references;
  text +=
      "\n## Where errors come from at 1e-2\n\nBy how much the run at the step first chosen differs from one that is "
      "finer "
      "in one thing alone: a tenth of the step, memory nearer to the data, each segment of lines in three.\n\n"
      "| scene | step | memory | segments |\n| --- | --- | --- | --- |\n" +
      tables.dominant;
  return text;
}

void write(const fs::path& data, const fs::path& folder, const fs::path& drawn,
           const std::vector<std::string>& wanted) {
  Tables tables;
  for (const Subject& subject : subjects(data, drawn))
    if (wanted.empty() || std::find(wanted.begin(), wanted.end(), subject.name) != wanted.end()) {
      std::cerr << subject.name << "\n";
      add(subject, tables);
      // As far as it is, so that a run of many minutes can be looked at.
      hydro::io::write_atomically(folder / "accuracy.md", page(tables));
    }
}

}  // namespace
}  // namespace froude::cost

int main(int count, char** argument) {
  if (count < 4) {
    std::cerr << "usage: price_accuracy REFERENCE_DATA FOLDER FOLDER_OF_DRAWN_SCENES [SCENE...]\n";
    return 2;
  }
  try {
    froude::cost::write(argument[1], argument[2], argument[3], {argument + 4, argument + count});
  } catch (const std::exception& e) {
    std::cerr << "price_accuracy: " << e.what() << "\n";
    return 1;
  }
  return 0;
}
