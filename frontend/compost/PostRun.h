// Private to Post*.cpp: the state of a run.
#pragma once

#include "frontend/compost/Conditions.h"
#include "frontend/compost/Post.h"
#include "frontend/compost/ProgTables.h"

namespace dotek::frontend::compost {

struct PostRun::Impl {
  const PostSettings& settings;
  Diagnostics& diagnostics;
  ProgTables tables;
  Conditions conditions;
  const Operation* operation = nullptr;
  std::uint64_t sequence = 0;
  std::uint64_t steps = 0;
  std::uint64_t bytes = 0;
  std::uint32_t depth = 0;
  bool stopped = false;                    // a limit was hit
  std::set<std::string, std::less<>> told; // causes: one word that many lines use is one finding
  std::string line;
  bool numberOnly = false; // nothing but a block number is in `line`
  SourceRange lineRange;
  std::vector<PostedLine> lines;

  Impl(const Program& program, const PostSettings& settingsIn, Diagnostics& diagnosticsIn);

  void call(const Routine& routine, SourceRange where);
  void body(const std::vector<Statement>& statements);
  void word(const Word& word);
  void command(const Word& word);
  void numeric(const Word& word);
  void print(std::string_view text, SourceRange where);
  void printValue(double value, const Picture& picture, std::string_view what, SourceRange where);
  void endLine(SourceRange where);
  bool step(SourceRange where);
  std::optional<double> host(const std::string& name, SourceRange where);
  // true the first time: the cause, such as a word that the form lacks, is to be reported.
  bool tell(std::string_view code, std::string_view cause);
};

} // namespace dotek::frontend::compost
