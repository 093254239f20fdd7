// froude validate: hands over to froude-validate. The cases and their plain reference solutions are in that program, so
// that froude holds what it is judged by nowhere.
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "froude/commands.hpp"

namespace froude {

void validate(std::vector<std::string> arguments) {
  std::error_code unknown;
  const std::string program =
      (std::filesystem::read_symlink("/proc/self/exe", unknown).parent_path() / "froude-validate").string();
  arguments.insert(arguments.begin(), program);
  std::vector<char*> words;
  for (std::string& argument : arguments) words.push_back(argument.data());
  words.push_back(nullptr);
  execv(program.c_str(), words.data());
  throw hydro::InputError(
      fmt::format("the validation cases are in a program of their own, which cannot be run: {}", std::strerror(errno)),
      {.file = program}, "install froude-validate beside froude; in a build tree, build the target froude-validate");
}

}  // namespace froude
