// The report of `verify` as a document to hand over: what was compared, with which files, and what came out.
// It holds no date but one that is given, and the same document gives the same bytes.
#pragma once

#include "sim/picture/Picture.h"
#include "support/Diagnostics.h"
#include "support/Source.h"
#include "targets/Options.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace dotek::targets {

struct VerifyDocument {
  // All texts are UTF-8 and not escaped.
  struct File {
    std::string name;
    std::string sha256; // of its bytes
    std::uint64_t bytes = 0;
  };
  // Lines of a file around one.
  struct Excerpt {
    std::string file;
    std::uint32_t line = 0;  // that is meant, from 1; 0: there is none
    std::uint32_t first = 0; // of `lines`
    std::vector<std::string> lines;
  };
  struct Difference {
    std::string pair, aspect, text; // "source against translation", "path", what differs
    std::uint64_t cases = 0, of = 0;
    bool edge = false;
    Excerpt source, post, translation;
    std::string replay; // the command that shows it
  };
  struct Reason { // of undecided cases
    bool edge = false;
    std::uint64_t cases = 0;
    std::string why;
    Excerpt at;
    std::uint64_t rejected = 0; // proposals, by the check there
    std::string remedy, replay;
  };
  struct Counts {
    std::uint64_t all = 0, agree = 0, differ = 0, undecided = 0, refused = 0;
  };
  struct Finding {
    std::string about; // "form", "translation" or "cases"
    std::string severity, code, message, file;
    std::uint32_t line = 0;
    bool operator==(const Finding&) const = default;
  };

  std::string title; // of the source
  std::string version, date;
  std::string remark;           // as the user gives it; "": none
  std::string command;          // that makes this document
  std::string verdict, summary; // "AGREES", and the whole line
  Counts cases, edges;
  std::string pair;                               // that was compared
  std::vector<std::string> aspects;               // of it
  std::string sourceControl, targetControl, form; // "": none
  std::string sourceMacros, targetMacros;         // "": none
  std::string target;                             // "": no translation
  std::vector<File> inputs;                       // that were read
  std::optional<File> translation;                // the text that ran
  bool edited = false;                            // it was given by --translation, and is another text
  std::uint64_t seed = 0;
  // Besides, of a cycle of the cycle language: a word that the program rounds counts as equal within so many
  // steps of its last digit; 0: none.
  double wordSteps = 0;
  double tolerance = 0, minAgreed = 0;                    // mm, percent
  std::vector<std::pair<std::string, std::string>> fixed; // by flags and the job; the others are drawn
  std::vector<std::string> assumed;
  std::vector<Difference> differences;
  std::vector<Reason> undecided;
  std::vector<Finding> findings; // besides these, in the order of `about` above
  struct Shown {
    sim::Picture picture;
    std::string caption;
  };
  std::vector<Shown> pictures; // of one case: the source's run, and the translation's where they differ
};

// What was said of the form, or else of the translation, before the cases ran, each once, as findings of the
// document. Errors are none of it.
void addFindings(const Diagnostics& said, const SourceMap& sources,
                 std::vector<VerifyDocument::Finding>& findings);

// What a reader has to know of the findings of `about`; "": nothing.
std::string_view leadOf(std::string_view about);

// "0.000001 mm", and what holds for words.
std::string toleranceText(const VerifyDocument& document);

// The line that is meant; "": none.
std::string lineOf(const VerifyDocument::Excerpt& excerpt);

std::string markdownOf(const VerifyDocument& document);
std::string jsonOf(const VerifyDocument& document); // docs/verify.md says its shape
std::string htmlOf(const VerifyDocument& document); // one page that needs no network

} // namespace dotek::targets
