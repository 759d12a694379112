// Private to Post*.cpp: the state of a run.
#pragma once

#include "frontend/compost/Post.h"

namespace dotek::frontend::compost {

inline constexpr std::string_view kFieldKeyword = "OpFieldData";
inline constexpr std::string_view kCycleKeyword = "CycleType";
inline constexpr std::string_view kFlagKeyword = "Flag";
inline constexpr std::string_view kSetFlagKeyword = "SetFlag";
inline constexpr std::string_view kClearFlagKeyword = "SetFlagF";

// Truth of a condition; nothing: a keyword whose truth is not known decides it.
using Truth = std::optional<bool>;

struct PostRun::Impl {
  const Program& program;
  const PostSettings& settings;
  Diagnostics& diagnostics;
  std::map<std::string, const Routine*, std::less<>> routines;
  std::map<std::string, Picture, std::less<>> pictures; // by keyword: FORMAT, else the form
  std::map<std::string, bool, std::less<>> flags;
  std::map<std::string, const Routine*, std::less<>> flagSetters; // first routine that sets the flag
  std::map<std::string, SourceRange, std::less<>> commandFormats; // FORMAT of a command
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

  Impl(const Program& programIn, const PostSettings& settingsIn, Diagnostics& diagnosticsIn);

  void call(const Routine& routine, SourceRange where);
  void body(const std::vector<Statement>& statements);
  void word(const Word& word);
  void command(const Word& word);
  void numeric(const Word& word);
  void print(std::string_view text, SourceRange where);
  void printValue(double value, const Picture& picture, std::string_view what, SourceRange where);
  void endLine(SourceRange where);
  bool step(SourceRange where);
  const Picture* picture(const std::string& keyword, SourceRange where);
  std::optional<double> host(const std::string& name, SourceRange where);
  // true the first time: the cause, such as a word that the form lacks, is to be reported.
  bool tell(std::string_view code, std::string_view cause);

  bool holds(const Condition& condition);
  Truth truth(const Condition& condition);
  Truth truth(const ConditionTerm& term);
  Truth truth(const Word& boolean);
};

} // namespace dotek::frontend::compost
