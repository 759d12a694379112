// The programs of the corpus, line by line: docs/macrob.md, "The corpus".
#include "tests/GoldenRunner.h"
#include "tests/unit/MacroBHelper.h"

#include <doctest/doctest.h>
#include <filesystem>
#include <fmt/format.h>

namespace fs = std::filesystem;
using namespace dotek;
using namespace dotek::tests;
using dotek::frontend::macrob::Text;

namespace {

void expect(const fs::path& path, const std::string& control, const std::vector<std::string>& findings,
            Text kind = Text::Program) {
  CAPTURE(path.string());
  MacroFile file(readAll(path), kind);
  file.check(control);
  const auto text = [](const std::vector<std::string>& list) {
    return fmt::format("{}", fmt::join(list, "; "));
  };
  CHECK(text(file.findings()) == text(findings));
}

void expectListing(const fs::path& path, const std::string& control,
                   const std::vector<std::string>& findings) {
  expect(path, control, findings, Text::Listing);
}

std::vector<std::string> zeros(std::initializer_list<const char*> places) {
  std::vector<std::string> out;
  for (const char* place : places)
    out.push_back(std::string(place) + " letter-o-for-zero");
  return out;
}

// Findings in the order of the file.
std::vector<std::string> merged(std::vector<std::vector<std::string>> lists) {
  std::vector<std::string> out;
  for (const auto& list : lists)
    out.insert(out.end(), list.begin(), list.end());
  const auto key = [](const std::string& one) {
    const std::size_t colon = one.find(':');
    return std::pair(std::stoi(one.substr(2, colon - 2)), std::stoi(one.substr(colon + 1)));
  };
  std::sort(out.begin(), out.end(), [&](const auto& a, const auto& b) { return key(a) < key(b); });
  return out;
}

std::vector<std::string> legends(std::initializer_list<const char*> places) {
  std::vector<std::string> out;
  for (const char* place : places)
    out.push_back("N " + std::string(place) + " legend-line");
  return out;
}

} // namespace

TEST_CASE("macrob corpus: programs of a 31i-B, their real errors and nothing else") {
  fs::path corpus;
  if (!haveCorpus(corpus)) return;
  const std::string control = "fanuc-31i-b";
  expect(corpus / "ram/HLAVNI_PROGRAM_MERENI.nc", control,
         {"W 11:1 block-never-runs", "E 14:1 condition-bracket-missing", "E 15:1 condition-bracket-missing",
          "W 15:3 constant-condition", "E 26:14 do-without-number"});
  expect(corpus / "ram/O9050-excerpt.nc", control, {});
  expect(corpus / "ram/O9052-excerpt.nc", control, {"W 10:9 subscript-as-value"});
  expect(corpus / "ram/O9062-excerpt.nc", control, {});
}

TEST_CASE("macrob corpus: programs of a 6M from a book, one finding a misprint") {
  fs::path corpus;
  if (!haveCorpus(corpus)) return;
  const std::string control = "fanuc-6m";
  const fs::path folder = corpus / "pocket";
  for (const char* good : {"O10.ocr.nc", "O30.ocr.nc", "O50.ocr.nc", "O500.ocr.nc"})
    expectListing(folder / good, control, {});
  expectListing(folder / "O20.ocr.nc", control,
                merged({zeros({"E 7:2", "E 8:2", "W 8:5", "E 19:2", "E 28:6", "E 55:5"}),
                        legends({"20:1", "21:1", "22:1", "23:1", "24:1", "25:1"}),
                        {"E 3:20 decimal-comma", "E 17:13 decimal-comma", "E 27:1 do-as-offset",
                         "E 30:4 bracket-restored", "W 32:13 mode-after-axis", "W 39:8 hash-missing",
                         "E 41:14 second-equals", "E 44:1 do-as-offset", "E 57:34 brackets-do-not-match",
                         "W 59:6 mode-after-axis"}}));
  expectListing(
      folder / "O40.ocr.nc", control,
      merged({zeros({"E 11:2", "E 12:2", "W 12:5", "E 24:5", "E 25:5"}),
              legends({"4:1", "6:1", "8:1", "10:1"}),
              {"E 3:20 decimal-comma", "E 31:18 word-needs-brackets", "E 38:22 word-needs-brackets",
               "W 38:31 stray-if", "E 41:3 assignment-target", "W 44:6 arc-without-centre",
               "E 44:22 word-needs-brackets", "W 58:4 arc-without-centre", "W 76:4 arc-without-centre",
               "E 76:4 bracket-restored", "W 77:19 hash-missing", "E 90:41 brackets-do-not-match",
               "W 95:4 arc-without-centre", "W 100:1 block-never-runs"}}));
  expectListing(folder / "O60.ocr.nc", control,
                merged({zeros({"E 7:2", "E 8:2", "W 8:5", "E 19:5"}),
                        legends({"3:42", "4:42"}),
                        {"W 12:15 table-base-read", "E 15:8 brackets-do-not-match", "W 15:12 decimal-comma",
                         "E 30:31 variable-number-form", "W 47:8 codes-exclude", "E 47:45 block-over-lines",
                         "W 62:8 codes-exclude", "E 62:23 star-for-hash", "E 63:29 star-for-hash",
                         "E 65:32 decimal-comma"}}));
  expectListing(folder / "O70.ocr.nc", control,
                merged({zeros({"E 11:2", "E 12:2", "E 26:2", "E 27:2"}),
                        legends({"4:1", "6:1", "8:1", "10:1"}),
                        {"W 16:14 table-base-read", "E 41:4 bracketed-assignment",
                         "E 47:22 goto-target-missing", "E 51:20 word-needs-brackets",
                         "W 55:10 decimal-comma", "E 55:13 missing-operator", "E 56:24 decimal-comma"}}));
  expectListing(folder / "O80.ocr.nc", control,
                merged({zeros({"E 10:2", "E 11:2", "E 20:2", "E 21:2"}),
                        legends({"4:1", "6:1", "8:1"}),
                        {"E 3:20 decimal-comma", "W 5:1 offset-overwritten", "W 20:4 small-letter",
                         "E 23:21 word-needs-brackets", "E 24:1 do-as-offset", "E 30:26 decimal-comma",
                         "W 33:7 small-letter", "W 40:8 small-letter", "E 41:64 block-over-lines",
                         "E 44:8 variable-number-form"}}));
  expectListing(folder / "O90.ocr.nc", control, zeros({"E 3:2", "W 3:13", "E 4:2", "W 4:9", "W 4:13"}));
  expectListing(folder / "O100.ocr.nc", control,
                merged({zeros({"E 9:2", "E 10:2", "E 14:2", "E 15:2", "E 20:2"}),
                        legends({"4:1", "6:1"}),
                        {"E 16:7 decimal-comma"}}));
  expectListing(folder / "O110.ocr.nc", control,
                merged({zeros({"E 10:2", "E 11:2", "E 15:2", "E 16:2", "E 24:2"}),
                        legends({"4:1", "6:1", "7:1"}),
                        {"W 10:4 six-for-letter-g", "W 16:4 word-without-point", "W 18:19 hash-missing"}}));
}

TEST_CASE("macrob corpus: programs of a 0i-MD") {
  fs::path corpus;
  if (!haveCorpus(corpus)) return;
  for (const auto& entry : fs::directory_iterator(corpus / "fanuc")) {
    // Its thesis prints G56 for G65 once, on a line of its own.
    if (entry.path().filename() == "easyprobe-example.nc")
      expect(entry.path(), "fanuc-0i-md", {"W 3:1 call-words-alone"});
    else
      expect(entry.path(), "fanuc-0i-md", {});
  }
}

TEST_CASE("macrob corpus: a repair where it is certain") {
  fs::path corpus;
  if (!haveCorpus(corpus)) return;
  int fixes = 0;
  for (const auto& entry : fs::directory_iterator(corpus / "pocket")) {
    if (entry.path().extension() != ".nc") continue;
    MacroFile file(readAll(entry.path()), Text::Listing);
    for (const Diagnostic& one : file.diagnostics.all()) {
      const bool certain =
          one.code == "letter-o-for-zero" || one.code == "decimal-comma" || one.code == "do-as-offset";
      if (!certain) continue;
      ++fixes;
      REQUIRE(one.fix);
      // Who reads a text as a listing says that it is not the one that ran; of a program nothing that moves
      // is changed.
      CHECK(one.fix->applicability == Fix::Applicability::Safe);
    }
  }
  CHECK(fixes == 51);
}
