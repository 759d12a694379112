// How a target writes the inputs of one `convert`.
#pragma once

#include "project/Compilation.h"
#include "project/CycleFolder.h"
#include "project/Lowering.h"
#include "project/Session.h"
#include "support/LineMap.h"
#include "targets/Options.h"

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace dotek::targets {

// What is written, in the order of the inputs.
struct ConversionResult {
  std::vector<OutputFile> files;
  std::vector<MappedResult> maps;
  // Of programs that are called, cycle by cycle; empty where a target writes no such program.
  std::vector<std::vector<OutputArgument>> arguments;
  std::vector<std::string> macrosByCycle;
  std::vector<std::set<std::uint32_t>> handedBack;            // as of ConvertedInput
  std::string helpers;                                        // what the files share, with --helpers
  std::string macros;                                         // the set that the last result calls; "": none
  std::vector<std::pair<std::uint64_t, std::string>> numbers; // of programs, with their inputs

  // A file with its map. `ranges` of a line that is made up are empty.
  template <class Line>
  void add(const std::string& name, const std::vector<Line>& lines, std::string_view lineEnd = "\n") {
    OutputFile& file = files.emplace_back(OutputFile{name, ""});
    MappedResult& map = maps.emplace_back(MappedResult{name, {}});
    for (const Line& line : lines) {
      file.text.append(line.text).append(lineEnd);
      map.lines.push_back({static_cast<std::uint32_t>(map.lines.size() + 1), line.ranges, line.reason});
    }
  }
};

// What one command works on; a conversion adds to `used...` and `result`.
struct ConversionContext {
  const ConvertOptions& options;
  Compilation& compilation;
  Session& session;                                          // of the compilation
  std::deque<CycleFolder>& folders;                          // of the compilation
  std::set<std::string>& usedSets;                           // of the compilation
  LoweringInputs* inputs = nullptr;                          // nullptr: no input is a cycle
  std::map<std::string, char> letters = {};                  // of --arg
  std::set<std::string> usedDefaults = {}, usedLetters = {}; // names that a cycle knows
  ConversionResult result = {};
};

class Conversion {
public:
  explicit Conversion(ConversionContext& context)
      : context_(context), options_(context.options), session_(context.session) {}
  virtual ~Conversion() = default;
  Conversion(const Conversion&) = delete;
  Conversion& operator=(const Conversion&) = delete;
  // Before the first input, where some are cycles: the context is complete. false: reported.
  virtual bool beginCycles() { return true; }
  // The same, where some are programs; their targets say so.
  virtual bool beginPrograms() { return true; }
  // false: the cycle could not be lowered, reported; which names it knows is not certain.
  virtual bool cycle(const CycleFolder& folder, std::size_t index) = 0;
  virtual void program(const std::string& /*path*/) {}
  // After the last input.
  virtual void finish() {}

protected:
  ConversionContext& context_;
  const ConvertOptions& options_;
  Session& session_;
};

// `Target::convert` of a target that is written by this class.
template <class Written> std::unique_ptr<Conversion> conversionBy(ConversionContext& context) {
  return std::make_unique<Written>(context);
}

// The letters of --arg into the context; what is none is reported.
void readLetters(ConversionContext& context);

// Reports options of the command line that none of the inputs takes.
void refuseOptions(const ConvertOptions& options, bool programs, bool cycles, Diagnostics& diagnostics);

struct LoweredSource {
  LoweredCycle lowered;
  // As --default and the source give them, those that the cycle's own checks reject included.
  std::map<ir::VariableId, double> defaults;
};

// Lowers a cycle for a program that takes its values when it runs. nullopt: reported. Defaults that its
// checks reject are taken away or reported.
std::optional<LoweredSource> lowerSource(const CycleFolder& folder, ConversionContext& context);

} // namespace dotek::targets
