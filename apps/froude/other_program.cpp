#include "froude/other_program.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

namespace froude {

void become(const std::string& name, std::vector<std::string> arguments,
            const std::function<hydro::InputError(const std::string& path, const std::string& why)>& refusal) {
  std::error_code unknown;
  const std::string program = (std::filesystem::read_symlink("/proc/self/exe", unknown).parent_path() / name).string();
  arguments.insert(arguments.begin(), program);
  std::vector<char*> words;
  for (std::string& argument : arguments) words.push_back(argument.data());
  words.push_back(nullptr);
  execv(program.c_str(), words.data());
  throw refusal(program, std::strerror(errno));
}

}  // namespace froude
