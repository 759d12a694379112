// Checks the folders and files given, as `dotek lint` does, and prints what it found.
#include "driver/Driver.h"

#include <iostream>

int main(int count, char** arguments) {
  dotek::driver::LintOptions options;
  options.paths.assign(arguments + 1, arguments + count);
  const dotek::driver::Outcome outcome = dotek::driver::lint(options);
  std::cout << dotek::renderText(outcome.diagnostics, outcome.sources, 0);
  return outcome.status;
}
