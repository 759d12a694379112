// What every command that reads inputs learns about them.
#pragma once

#include "stdlib/ProbeCodes.h"
#include "support/Files.h"
#include "support/Limits.h"
#include "support/Source.h"

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace dotek::project {

// NAME=VALUE of a repeated flag, in the order given.
using NamedTexts = std::vector<std::pair<std::string, std::string>>;

// Flags of every command that reads an input.
struct CommonOptions {
  std::optional<std::string> job;
  NamedTexts set;   // a field's value, mm and degrees
  NamedTexts field; // the post's field = the macro's variable
  NamedTexts
      projectField; // the same of dotek.toml: for cycles that have both, and where `field` says nothing
  NamedTexts host;  // host inputs, mm and mm/min
  std::set<std::string> assume;
  bool recover = false;
  std::optional<Encoding> encoding;
  Limits limits;
  stdlib::ProbeCodes probeCodes;          // that switch the probe, where the control's profile has none
  std::vector<std::string> data;          // folders of data files
  std::optional<std::string> from;        // kind of the inputs
  std::vector<std::string> include;       // folders of files that inputs name, beside that of the input
  std::optional<std::string> includeRoot; // inputs name files below it, instead of those of their own folder
  // Path of the program that runs scripts in a process of its own: `dotek`. "": scripts are refused.
  std::string scriptProgram;
  // Texts that an editor holds instead of what is in the file, UTF-8, by absolute path without dots; nullptr:
  // none. Inputs are read from here first.
  std::shared_ptr<const std::map<std::string, std::string>> buffers;
  // What the editor takes such a text for, by the same paths: a kind as --from names it, or `cps`. It counts
  // where the text itself does not say, as a text of a few letters; nullptr: nothing is said.
  std::shared_ptr<const std::map<std::string, std::string>> bufferKinds;
  // What was read from pipes; copies of the options share it.
  std::shared_ptr<StreamInputs> streams = std::make_shared<StreamInputs>();
};

// The form of a Prog where nobody names one.
inline constexpr std::string_view kDefaultForm = "thesis-a";

// Flags that say where the post is.
struct SourceOptions {
  std::optional<std::string> prog;
  std::optional<std::string> form; // nothing: what dotek.toml says, else kDefaultForm
  std::optional<std::string> routine;
  std::optional<std::string> cycle;
};

} // namespace dotek::project
