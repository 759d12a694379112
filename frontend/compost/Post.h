// Runs the routines of a Prog for the operations of one program and prints the NC blocks.
#pragma once

#include "frontend/compost/Ast.h"
#include "stdlib/Form.h"
#include "support/Diagnostics.h"
#include "support/Limits.h"
#include "support/Picture.h"

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace dotek::frontend::compost {

// What holds while one operation is posted.
struct Operation {
  std::string cycle; // what CycleType?('..') compares with; "" where no operation runs
  // Value of the post's field `name`; nullopt where there is none: the callee has reported why.
  std::function<std::optional<double>(const std::string& name, SourceRange where)> field;
  std::map<std::string, double> hosts; // host inputs that are known
};

// One NC block (or comment line) as it is in the program.
struct PostedLine {
  std::string text;
  SourceRange range; // of the statements that printed it
};

struct PostSettings {
  const SourceMap& sources;
  const stdlib::Form& form;
  const Limits& limits;
  std::set<std::string> assumptions; // `--assume`
  std::uint64_t sequenceStart = 10;
  std::uint64_t sequenceStep = 10;
  // Values with more than six decimals, as a cosine has, are printed in full where the picture would round
  // them: two sides of a comparison get the same.
  bool printsRests = false;
};

// Flags, sequence number and the open line live from the first routine to the last.
class PostRun {
public:
  // `program` has no errors, or only repaired ones.
  PostRun(const Program& program, const PostSettings& settings, Diagnostics& diagnostics);
  ~PostRun();
  PostRun(const PostRun&) = delete;
  PostRun& operator=(const PostRun&) = delete;

  // Runs `routine` of the program. Goes on after a refusal so that all of them are reported; the caller
  // drops the lines where `diagnostics` has errors.
  void run(const Routine& routine, const Operation& operation);
  // Lines so far, an open one included.
  std::size_t lineCount() const;
  // The lines; an open line is closed with a warning.
  std::vector<PostedLine> finish();

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

} // namespace dotek::frontend::compost
