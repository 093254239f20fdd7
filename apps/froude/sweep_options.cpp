#include "froude/sweep_options.hpp"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <memory>
#include <string_view>

namespace froude {

void add_sweep(CLI::App& app, Request& request, const std::function<int(const SweepArguments&, const Console&)>& call) {
  auto* command = app.add_subcommand("sweep", "a study: a scene answered with many values of its keys, on all cores");
  command->footer(
      "Examples:\n  froude sweep examples/sweep/study.toml --plan\n  froude sweep examples/sweep/study.toml -o sweep\n"
      "  mpirun -n 8 froude sweep examples/sweep/study.toml -o sweep\n"
      "  froude sweep --merge part1 part2 -o whole\n"
      "Exit status beside the others: 3 cases have failed, 130 interrupted; the same command goes on.");
  auto arguments = std::make_shared<SweepArguments>();
  auto* study = command->add_option("study", arguments->study, "study (.toml)");
  command->add_option("-o,--output", arguments->output, "folder of the results; STUDY.sweep if left out");
  command->add_option("--threads", arguments->threads,
                      "cases at a time; if left out one a core, of several ranks one a rank");
  auto* part =
      command->add_option("--part", arguments->part, "a share of the cases: 1/4, 2/4, …")->capture_default_str();
  auto* plan = command->add_flag("--plan", arguments->plan, "tells how many cases there are and how long they take");
  auto* retry = command->add_flag("--retry", arguments->retry, "answers cases again that have failed");
  auto* one = command->add_option("--case", arguments->scene_of, "prints the scene of this case, by its number");
  auto* merge = command->add_option("--merge", arguments->merge, "folders of sweeps of one study, to become one in -o");
  for (auto* of_study : {study, part, plan, retry, one}) merge->excludes(of_study);
  command->callback(
      [=, &request] { request.call = [=](const Console& console) { return call(*arguments, console); }; });
}

int processes_started_together() {
  int most = 1;
  // Open MPI; MPICH, Intel MPI and whoever else has Hydra; steps of Slurm (srun), not the script that starts them.
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "SLURM_STEP_NUM_TASKS"}) {
    const char* value = std::getenv(name);
    const std::string_view text = value == nullptr ? "" : value;
    int count = 0;
    std::from_chars(text.data(), text.data() + text.size(), count);
    most = std::max(most, count);
  }
  return most;
}

bool is_shared_among_ranks(const std::vector<std::string>& arguments) {
  const auto alone = [](const std::string& argument) {
    const std::string option = argument.substr(0, argument.find('='));
    for (const char* one : {"--part", "--plan", "--case", "--merge", "--help", "-h", "--help-all"})
      if (option == one) return true;
    return false;
  };
  return processes_started_together() > 1 && std::none_of(arguments.begin(), arguments.end(), alone);
}

}  // namespace froude
