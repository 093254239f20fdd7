// froude validate: hands over to froude-validate. The cases and their plain reference solutions are in that program, so
// that froude holds what it is judged by nowhere. The commands about films are in froude-film, so that no other loads
// OpenCV, and what shares a sweep among processes in froude-ranks, so that no other loads MPI.
#include "froude/commands.hpp"
#include "froude/other_program.hpp"

namespace froude {

void validate(std::vector<std::string> arguments) {
  become("froude-validate", std::move(arguments), [](const std::string& path, const std::string& why) {
    return hydro::InputError(
        fmt::format("the validation cases are in a program of their own, which cannot be run: {}", why), {.file = path},
        "install froude-validate beside froude; in a build tree, build the target froude-validate");
  });
}

void about_films(std::vector<std::string> arguments) {
  const std::string command = arguments.front();
  become("froude-film", std::move(arguments), [&](const std::string&, const std::string& why) {
    return hydro::InputError(fmt::format(
        "`froude {}` needs OpenCV, and froude-film, which is built where OpenCV is: {}; `scripts/setup camera` "
        "installs it, `scripts/build release froude-film` then builds that",
        command, why));
  });
}

void sweep_among_ranks(std::vector<std::string> arguments) {
  become("froude-ranks", std::move(arguments), [](const std::string&, const std::string& why) {
    return hydro::InputError(fmt::format(
        "mpirun or srun has started several processes, which share a sweep by froude-ranks, which is built where Open "
        "MPI is: {}; `scripts/setup mpi` installs it, `scripts/build release froude-ranks` then builds that; or give "
        "each process a --part of its own and a folder of its own",
        why));
  });
}

}  // namespace froude
