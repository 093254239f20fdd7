#include "sweep/sweep.hpp"

#include <charconv>

#include "froude/commands.hpp"
#include "froude/progress.hpp"
#include "froude/report.hpp"
#include "froude/signals.hpp"
#include "froude/sweep_task.hpp"
#include "hydro/base/error.hpp"
#include "hydro/base/parallel.hpp"
#include "hydro/io/atomic_file.hpp"
#include "scene/placed.hpp"
#include "sweep/ranks.hpp"
#include "sweep/table.hpp"

namespace froude {
namespace {

namespace fs = std::filesystem;
using sweep::Study, sweep::Tally;
using Task = SweepTask;

// What is asked

/// "2/8". \throws hydro::InputError for what is no share
std::pair<std::size_t, std::size_t> part_of(const std::string& text) {
  std::size_t part = 0, parts = 0;
  const char* end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, part);
  const bool read = first.ptr != end && *first.ptr == '/' && std::from_chars(first.ptr + 1, end, parts).ptr == end;
  if (!read || part == 0 || part > parts)
    throw hydro::InputError(fmt::format("\"{}\" is no part of the cases", text), {.file = "--part"},
                            "write 1/4, 2/4, 3/4 and 4/4");
  return {part, parts};
}

int threads_of(const SweepArguments& arguments, int if_left_out) {
  if (!arguments.threads) return if_left_out;
  constexpr int most = 1024;
  if (*arguments.threads < 1 || *arguments.threads > most)
    throw hydro::InputError(fmt::format("{} threads cannot work", *arguments.threads), {.file = "--threads"},
                            fmt::format("take 1 to {}, or leave it out", most));
  return *arguments.threads;
}

// What is told

std::string duration(double seconds) {
  if (seconds < 100) return fmt::format("{:.2g} s", seconds);
  return seconds < 6000 ? fmt::format("{:.0f} min", seconds / 60) : fmt::format("{:.1f} h", seconds / 3600);
}

/// From a case that may have paid for what all share.
Report expected(std::size_t cases, double seconds_a_case, int threads) {
  const double whole = seconds_a_case * static_cast<double>(cases) / threads;
  return Report().say("a case takes up to {}; {} cases on {} thread{} up to {}",
                      fact("seconds_a_case", seconds_a_case, duration(seconds_a_case)), fact("cases_to_do", cases),
                      fact("threads", threads), threads == 1 ? "" : "s", fact("expected_s", whole, duration(whole)));
}

Report report_of(const Tally& tally, std::size_t cases) {
  Report out;
  out.say("{} of {} cases: {} done, {} failed, {} skipped{}", fact("over", tally.over()), fact("cases", cases),
          fact("done", tally.done), fact("failed", tally.failed), fact("skipped", tally.skipped),
          fact("warned", tally.warned, tally.warned == 0 ? "" : fmt::format("; {} with warnings", tally.warned)));
  for (const auto& [number, reason] : tally.failures)
    out.row("failures", "case {} failed: {}", fact("case", number), fact("reason", reason));
  if (tally.failed > tally.failures.size())
    out.say("and {} more, which the table names", tally.failed - tally.failures.size());
  if (tally.unfinished_ranks > 0)
    out.say("{} ranks of an earlier start had ended before their cases were taken over, which is done now",
            fact("unfinished_ranks", tally.unfinished_ranks));
  out.keep("partial", tally.over() < cases).keep("interrupted", tally.interrupted);
  if (tally.over() < cases)
    out.say("the result is partial: the same command goes on where this one stopped{}",
            tally.interrupted ? " (it was interrupted)" : "");
  return out;
}

/// Table and pictures of all that the folder holds.
Report written(const Study& study, const sweep::Store& store) {
  Report out;
  out.wrote(sweep::database_of(store.folder())).wrote(sweep::write_table(store));
  const sweep::Pictures pictures = sweep::write_pictures(study, store);
  for (const Path& picture : pictures.written) out.wrote(picture);
  for (const std::string& name : pictures.waiting)
    out.row("not_drawn", "{} is not drawn yet: cases of two values and more on each of its axes have to be done first",
            fact("picture", name));
  return out;
}

int status_of(const Tally& tally) {
  constexpr int numerics = 3;
  return tally.interrupted ? ended_by_signal + SIGINT : tally.failed > 0 ? numerics : 0;
}

// What is done

/// One case, answered twice and not kept: the second time is that of a case among many.
void plan_sweep(const Task& task, int threads, const Console& console) {
  std::size_t skipped = 0, first = 0;
  for (std::size_t n = task.cases.count(); n > 0; --n) task.cases.skipped(n) ? ++skipped : first = n;
  Report out;
  out.say("{} cases, {} of them skipped", fact("cases", task.cases.count()), fact("skipped", skipped));
  if (first > 0) {
    const auto kept = std::make_shared<compile::Kept>();
    answer_case(task.study, task.cases, first, kept);  // makes what all cases share
    const sweep::Row row = answer_case(task.study, task.cases, first, kept);
    if (!row.reason.empty()) out.say("case {} failed: {}", first, fact("reason", row.reason));
    out.part("", expected(task.cases.count() - skipped, row.seconds, threads));
  }
  tell(out, console);
}

void tell_scene(const Task& task, std::size_t number, const Console& console) {
  if (number == 0 || number > task.cases.count())
    throw hydro::InputError(fmt::format("there is no case {}, of {}", number, task.cases.count()), {.file = "--case"},
                            "count from 1");
  console.out << task.cases.scene(number);
}

Path folder_of(const SweepArguments& arguments, const Task& task) {
  return arguments.output.value_or(task.study.file.stem().string() + ".sweep");
}

bool interrupted() { return asks_to_end(&Signals::asked()); }

/// `master`: of ranks that help, if there are.
int sweep_study(const SweepArguments& arguments, const Task& task, int threads, sweep::Master* master,
                const Console& console) {
  const auto [part, parts] = part_of(arguments.part);
  const int ranks = master == nullptr ? 1 : master->count();
  const Path folder = folder_of(arguments, task);
  task.require_folder(folder);
  sweep::Store store(folder, task.identity());
  const Signals signals;
  Progress progress(console.err, "sweep", console.show_progress);
  const sweep::Watch watch{
      [&](std::size_t cases, double seconds) { tell_people(expected(cases, seconds, threads * ranks), console); },
      [&](double done) { progress.update(done); }, interrupted};
  const Tally tally =
      carry_out(task.study, task.cases, store,
                {.threads = threads, .part = part, .parts = parts, .retry = arguments.retry, .ranks = master}, watch);
  Report out = report_of(tally, task.cases.count());
  out.keep("answered", tally.answered).keep("wall_time_s", tally.seconds).keep("threads", threads).keep("ranks", ranks);
  tell(out.part("", written(task.study, store)), console);
  return status_of(tally);
}

const Path& study_of(const SweepArguments& arguments) {
  if (arguments.study) return *arguments.study;
  throw hydro::InputError("which study is not said", {.file = "froude sweep"}, "name its file, or sweeps to --merge");
}

int merge_sweeps(const SweepArguments& arguments, const Console& console) {
  if (!arguments.output)
    throw hydro::InputError("where the sweeps are merged is not said", {.file = "--merge"}, "name a folder with -o");
  sweep::Identity identity;
  {
    const sweep::Store first(arguments.merge.front());
    identity = first.identity();
  }
  for (const Path& folder : arguments.merge)
    if (std::error_code unknown; fs::equivalent(folder, *arguments.output, unknown))
      throw hydro::InputError(fmt::format("\"{}\" is merged, and is where to", folder.string()), {.file = "-o"},
                              "name another folder");
  sweep::Store store(*arguments.output, identity);
  sweep::merge(arguments.merge, store);
  const Tally tally = sweep::tally_of(store);
  Report out = report_of(tally, identity.cases);
  tell(out.part("", written(sweep::parse_study(identity.study, identity.name), store)), console);
  return status_of(tally);
}

}  // namespace

int sweep_scenes(const SweepArguments& arguments, const Console& console) {
  if (!arguments.merge.empty()) return merge_sweeps(arguments, console);
  const Task task(study_of(arguments));
  const int threads = threads_of(arguments, hydro::all_processors());
  if (arguments.scene_of) return tell_scene(task, *arguments.scene_of, console), 0;
  if (arguments.plan) return plan_sweep(task, threads, console), 0;
  return sweep_study(arguments, task, threads, nullptr, console);
}

int sweep_scenes_together(const SweepArguments& arguments, sweep::Ranks& ranks, const Console& console) {
  // Launchers bind a rank to one core or to many, and do not say so in one way.
  const auto threads = [&] { return threads_of(arguments, 1); };
  if (ranks.rank() > 0) {
    const Signals signals;
    sweep::Helper helper(ranks);
    helper.run([&] {
      const Task task(study_of(arguments));
      help_out(task.study, task.cases, folder_of(arguments, task), task.identity(), threads(), helper, interrupted);
    });
    return 0;
  }
  sweep::Master master(ranks);
  try {
    const Task task(study_of(arguments));
    return sweep_study(arguments, task, threads(), &master, console);
  } catch (...) {
    master.dismiss();
    throw;
  }
}

}  // namespace froude
