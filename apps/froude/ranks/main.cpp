// froude-ranks: `froude sweep` as one of several processes that mpirun or srun has started, which pass messages by MPI.
#include <mpi.h>

#include <malloc.h>

#include <string>

#include "froude/kept_fits.hpp"
#include "froude/sweep_options.hpp"
#include "hydro/base/error.hpp"
#include "sweep/ranks.hpp"

namespace froude {
namespace {

/// MPI from its start to its end. An error within it ends all ranks, as MPI does unless told otherwise.
class MpiRanks : public sweep::Ranks {
 public:
  MpiRanks(int& argc, char**& argv) {
    int given = 0;
    MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &given);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &count_);
  }
  ~MpiRanks() override { MPI_Finalize(); }
  MpiRanks(const MpiRanks&) = delete;
  MpiRanks& operator=(const MpiRanks&) = delete;

  int rank() const override { return rank_; }
  int count() const override { return count_; }
  void send(int to, const std::string& text) override {
    MPI_Send(text.data(), static_cast<int>(text.size()), MPI_CHAR, to, 0, MPI_COMM_WORLD);
  }
  std::optional<Message> received() override {
    int is_there = 0, size = 0;
    MPI_Status status;
    MPI_Iprobe(MPI_ANY_SOURCE, 0, MPI_COMM_WORLD, &is_there, &status);
    if (is_there == 0) return std::nullopt;
    MPI_Get_count(&status, MPI_CHAR, &size);
    Message out{status.MPI_SOURCE, std::string(static_cast<std::size_t>(size), '\0')};
    MPI_Recv(out.text.data(), size, MPI_CHAR, out.from, 0, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    return out;
  }

 private:
  int rank_ = 0, count_ = 1;
};

/// A launcher of another MPI than this program has starts processes that each think they are alone.
void require_all_together(const sweep::Ranks& ranks) {
  const int started = processes_started_together();
  if (ranks.count() < started)
    throw hydro::InputError(
        fmt::format("{} processes were started together, of which MPI sees {}", started, ranks.count()), {},
        "start them with mpirun of the MPI that froude-ranks was built with, or with `srun --mpi=pmix`");
}

int main_program(int argc, char** argv) {
  MpiRanks ranks(argc, argv);
  Request request;
  CLI::App app;
  app.name("froude");
  app.fallthrough();
  app.require_subcommand(1);
  add_common_flags(app, request);
  add_sweep(app, request, [&](const SweepArguments& arguments, const Console& console) {
    require_all_together(ranks);
    keep_fits_in(users_folder_of_fits());
    return sweep_scenes_together(arguments, ranks, console);
  });
  return carry_out(app, request, argc, argv);
}

}  // namespace
}  // namespace froude

int main(int argc, char** argv) {
  // As froude's own main().
  mallopt(M_MMAP_MAX, 0);
  mallopt(M_TRIM_THRESHOLD, -1);
  return froude::main_program(argc, argv);
}
