// What verify says where it finds no values: how many tries each reason rejected.
#include "driver/Driver.h"
#include "tests/GoldenRunner.h"
#include "tests/TestFolder.h"

#include <cstdlib>
#include <doctest/doctest.h>
#include <string>

using namespace dotek;
using namespace dotek::tests;

namespace {

// The tries that the notes name, and that the error names.
void checkSum(const std::string& said) {
  const std::size_t in = said.find(", in ");
  REQUIRE_MESSAGE(in != std::string::npos, said);
  const long tries = std::strtol(said.c_str() + in + 5, nullptr, 10);
  long sum = 0;
  for (std::size_t at = 0; (at = said.find("note: ", at)) != std::string::npos; ++at) {
    char* end = nullptr;
    const long count = std::strtol(said.c_str() + at + 6, &end, 10);
    if (std::string_view(end).starts_with(" of them: ")) sum += count;
  }
  CHECK_MESSAGE(sum == tries, said);
}

std::string verified(const driver::VerifyOptions& options) {
  const driver::Outcome outcome = driver::verify(options);
  return renderText(outcome.diagnostics, outcome.sources, 0) + outcome.output;
}

} // namespace

TEST_CASE("verify without values: a folder whose check nothing meets") {
  const TestFolder folder("dotek-no-values");
  const auto copy = [&](const char* name, const std::string& more) {
    std::string text = readAll(root() / "examples/surface-x" / name);
    const std::size_t at = text.find("if wrong = 1 ");
    if (at != std::string::npos) text.insert(at, more);
    folder.write(std::string("surface-x/") + name, text);
  };
  copy("CycleData.mac", "if X < 5000 then message \"The travel is 5 m\"\n"
                        "if X < 5000 then goto ask\n");
  copy("CycleData.dlg", "");
  copy("DefineData.txt", "");
  copy("ToolPath.mac", "");
  driver::VerifyOptions options;
  options.inputs = {(folder.path() / "surface-x").string()};
  options.source.prog = (root() / "examples/post.txt").string();
  options.source.form = "thesis-a";
  options.to = "fanuc";
  options.jobs = 1;
  options.cases = 5;
  const std::string said = verified(options);
  CHECK_MESSAGE(said.find("no-values-found") != std::string::npos, said);
  checkSum(said);
}

TEST_CASE("verify without values: a cycle whose requirement nothing meets") {
  const TestFolder folder("dotek-no-values");
  driver::VerifyOptions options;
  options.inputs = {folder.write("odd.cycle", "cycle odd \"Odd\"\n\n"
                                              "parameter one : length = 12 mm\n"
                                              "require one > 5000 mm \"One is above 5 m\"\n\n"
                                              "spindle off\nprobe on\ntouch x by one -> wall\nprobe off\n")};
  options.to = "fanuc";
  options.control = "fanuc-0i-md";
  options.probeMacros = "dotek";
  options.jobs = 1;
  options.cases = 5;
  const std::string said = verified(options);
  CHECK_MESSAGE(said.find("no-values-found") != std::string::npos, said);
  checkSum(said);
}
