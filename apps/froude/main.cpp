#include "froude/program.hpp"

int main(int argc, char** argv) { return froude::run_program(argc, argv); }
