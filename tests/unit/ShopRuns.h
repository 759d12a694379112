// Conversions of cycles of tests/shops, and what verify says of them.
#pragma once

#include "driver/Driver.h"
#include "support/Worker.h"
#include "tests/GoldenRunner.h"
#include "tests/TestFolder.h"

#include <doctest/doctest.h>
#include <filesystem>
#include <string>
#include <vector>

namespace dotek::tests {

struct Shop {
  const char* shop;
  const char* cycle;
  const char* routine;
  const char* to;
  const char* macros; // "": none
  const char* control;
  std::vector<std::string> assume = {};
  std::string datum = {};
  project::NamedTexts host = {}, set = {};
  std::uint64_t cases = 20;
};

inline void take(const Shop& of, targets::TranslationOptions& out) {
  const std::string shops = (root() / "tests/shops").string() + "/";
  out.inputs = {shops + of.shop + "/" + of.cycle};
  out.source.prog = shops + of.shop + "/post.txt";
  out.source.routine = of.routine;
  out.common.data = {shops + "data"};
  out.to = of.to;
  if (*of.control != 0) out.control = of.control;
  if (*of.macros != 0) out.probeMacros = of.macros;
  out.common.probeCodes = {"M31", "M32"};
  if (out.control.starts_with("haas")) out.common.probeCodes = {"M61", "M62"}; // M31 is the chip conveyor
  out.common.scriptProgram = runningProgram();
  for (const std::string& one : of.assume)
    out.common.assume.insert(one);
  if (!of.datum.empty()) out.datum = of.datum;
  out.common.host = of.host;
  out.common.set = of.set;
}

inline std::string converted(const Shop& of) {
  driver::ConvertOptions options;
  take(of, options);
  const driver::Outcome outcome = driver::convert(options);
  REQUIRE_MESSAGE(outcome.status == 0, renderText(outcome.diagnostics, outcome.sources, 0));
  return outcome.files.front().text;
}

// Messages and verdict.
inline std::string verified(const Shop& of, const std::string& text = "") {
  const TestFolder scratch("dotek-verify-shops");
  driver::VerifyOptions options;
  take(of, options);
  options.cases = of.cases;
  options.jobs = 1;
  options.allowEdits = true; // the cases alone are to show it
  if (!text.empty()) options.translation = scratch.write("edited", text);
  const driver::Outcome outcome = driver::verify(options);
  return renderText(outcome.diagnostics, outcome.sources, 0) + outcome.output;
}

inline bool agrees(const std::string& said) {
  return ("\n" + said).find("\nAGREES: 20 of 20 drawn cases") != std::string::npos;
}

inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  REQUIRE_MESSAGE(at != std::string::npos, from << " is not in\n" << text);
  return text.replace(at, from.size(), to);
}

} // namespace dotek::tests
