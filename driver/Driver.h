// The public library of Dotek: one function per command. Nothing here prints, exits or throws.
#pragma once

#include "lint/Options.h"
#include "project/Options.h"
#include "sim/run/Options.h"
#include "support/Diagnostics.h"
#include "support/LineMap.h"
#include "support/Source.h"
#include "targets/Options.h"

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace dotek::driver {

// Of UTF-8, which a file that is rewritten keeps; SourceFile drops it.
inline constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

using dotek::OutputFile;
using lint::FailOn;
using lint::LintOptions;
using project::CommonOptions;
using project::NamedTexts;
using project::SourceOptions;
using sim::SimOptions;
using targets::ConvertedInput;
using targets::ConvertOptions;
using targets::OutputArgument;
using targets::VerifyOptions;

struct PostOptions {
  std::vector<std::string> folders;
  CommonOptions common;
  SourceOptions source;
  std::optional<std::pair<std::uint64_t, std::uint64_t>> sequence; // start, step
};

enum class Stage : std::uint8_t { Tokens, Ast, Path, Ir };

struct DumpOptions {
  std::vector<std::string> inputs;
  Stage stage = Stage::Ast;
  CommonOptions common;
  SourceOptions source;
  std::string control; // Ir: as of convert
};

// Of `check` and `fmt`: files of the cycle language.
struct CycleOptions {
  std::vector<std::string> inputs;
  CommonOptions common;
};

struct NewFormOptions {
  std::string name; // of the form: letters, digits, `-` and `_`
  std::optional<std::string> prog;
  CommonOptions common;
};

struct NewControlOptions {
  std::string name;
  std::string base; // the control that it extends
  CommonOptions common;
};

struct InitOptions {
  std::string folder = "."; // whose dotek.toml it is
  std::string control;      // "": none is chosen
  bool force = false;       // a dotek.toml that is there is replaced
  CommonOptions common;
};

// What a command gives. `status` is 0, 1 or 2 as docs/cli.md says; with a status other than 0 of post,
// `output` is empty.
struct Outcome {
  int status = 0;
  std::string output;
  std::vector<OutputFile> files;   // of convert, and pictures of sim
  std::vector<OutputFile> reports; // of convert --verify --report: named like the inputs; of any status
  std::string helpers;             // of convert: what --helpers writes
  std::vector<MappedResult> maps;  // of convert: what --map writes, file by file; places are of `sources`
  std::string macros;              // of convert: the set that the last result calls; "": none
  std::vector<std::vector<OutputArgument>> arguments; // of convert to fanuc, cycle by cycle
  std::vector<std::string> macrosByCycle;             // the sets that these call
  std::vector<std::set<std::uint32_t>> handedBack;    // as of targets::ConvertedInput
  // Of convert: those whose results are given, in their order; with --keep-going not all. Of layOut: those
  // whose layout is another than that of `files`.
  std::vector<std::string> inputs;
  // Of convert: what was found in each input by itself, `inputs` first, then the refused; else it is of all.
  std::vector<std::vector<Diagnostic>> foundIn;
  std::string
      summary; // of lint of folders: what was read and what was not; of --keep-going: what is refused; a line
  SourceMap sources;
  Diagnostics diagnostics; // sorted
};

Outcome post(const PostOptions& options);
// Each folder becomes a program, each file of programs another file; with a status other than 0 there is
// none, or with --keep-going those of the inputs that are not refused.
Outcome convert(const ConvertOptions& options);
// The diagnostics are the result; status is 2 where a file could not be read, 1 with a finding at or above
// the severity of --fail-on.
Outcome lint(const LintOptions& options);
// The findings of lint as SARIF 2.1.0; paths as they were given.
std::string sarif(const Outcome& outcome);
Outcome dump(const DumpOptions& options);
// Runs a program on a machine. The status is 0 where it came to its end; the trace and the summary are given
// up to the place where it did not.
Outcome sim(const SimOptions& options);
// Runs source and translation on many drawn cases and compares what they do. The output is the report; its
// last line is the verdict: `AGREES: 990 of 1000 drawn cases, 10 undecided; edge cases: 100 of 100`, or with
// DIFFERS or UNDECIDED the cases that do.
Outcome verify(const VerifyOptions& options);
// The beginning of a project's settings, as the one file; an error where there is one.
Outcome init(const InitOptions& options);
// The beginning of a form's data file: what the Prog's keywords print, as far as it is known.
Outcome newForm(const NewFormOptions& options);
// The same for a control that differs from one that Dotek knows.
Outcome newControl(const NewControlOptions& options);
// What is wrong with cycles, whatever their values; as of lint the diagnostics are the result.
Outcome check(const CycleOptions& options);
// Cycles in the one layout of the language: `files`, by the name of the input. A file that cannot be read
// whole is an error and has none.
Outcome layOut(const CycleOptions& options);
// Pages of cycles: an HTML and a Markdown page for each, and an index of both, as `files`; `output` is the
// Markdown of all. Inputs are files and folders of cycles; none: the library.
Outcome catalogue(const CycleOptions& options);
// The beginning of a cycle: what a new one is made from.
Outcome newCycle(const std::string& name, const CommonOptions& common);
// The text of one message or rule; status 2 for an unknown code.
Outcome explain(const std::string& code);
// `what`: cycles, controls, macros, forms, rules, targets, hosts, limits, assumptions.
Outcome list(const std::string& what, const CommonOptions& options);

} // namespace dotek::driver
