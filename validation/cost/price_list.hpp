#pragma once
/// \file  What every program that writes a price list does with its arguments.
#include <exception>
#include <filesystem>
#include <iostream>

namespace froude::cost {

/// Of so many `arguments` the last is the folder that is written to. \returns the exit status: 2 where they are not
/// that, 3 where `write` has thrown
template <class Write>
int write_price_list(int argc, char** argv, int arguments, const char* usage, Write write) {
  if (argc != arguments + 1 || !std::filesystem::is_directory(argv[arguments])) {
    std::cerr << "usage: " << usage << '\n';
    return 2;
  }
  try {
    write();
  } catch (const std::exception& e) {
    std::cerr << e.what() << '\n';
    return 3;
  }
  return 0;
}

}  // namespace froude::cost
