// The program `irk`.
#include <iostream>
#include <string>
#include <vector>

#include "experiments/commands/cli.h"

int main(int argc, char** argv) { return irk::runProgram({argv + 1, argv + argc}, {std::cout, std::cerr}); }
