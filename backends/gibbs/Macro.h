// Statements of the IR as lines of a macro. Private to the back end.
#pragma once

#include "backends/gibbs/Emit.h"

#include <functional>
#include <map>

namespace dotek::backends::gibbs {

class MacroText {
public:
  MacroText(const ir::Cycle& cycle, Names& names, Diagnostics& diagnostics)
      : cycle_(cycle), names_(names), diagnostics_(diagnostics) {}

  std::vector<EmittedLine> take() { return std::move(lines_); }
  bool failed() const { return failed_; }
  void fail() { failed_ = true; }
  Names& names() { return names_; }
  Diagnostics& diagnostics() { return diagnostics_; }

  void add(std::string text, const ir::Origin& origin = {});
  // Reports what the language cannot compute.
  std::string expression(const ir::ExpressionPtr& value, const ir::Origin& origin);
  void assign(const std::string& name, const ir::ExpressionPtr& value, const ir::Origin& origin);
  // "if X > 0 then goto fine", in as many lines as the condition has comparisons.
  void jumpIf(const ir::ConditionPtr& condition, ir::LabelId target, const ir::Origin& origin);
  void jump(ir::LabelId target, const ir::Origin& origin);
  void label(ir::LabelId label, const ir::Origin& origin);
  // A name for a label of ours.
  std::string freshLabel(std::string_view wanted);
  bool turns() const { return turns_; } // an angle was used

private:
  std::string name(ir::LabelId label);
  void jumpIf(const ir::ConditionPtr& condition, const std::string& target, const ir::Origin& origin);

  const ir::Cycle& cycle_;
  Names& names_;
  Diagnostics& diagnostics_;
  std::vector<EmittedLine> lines_;
  std::map<ir::LabelId, std::string> labels_;
  TakenNames taken_;
  bool failed_ = false;
  bool turns_ = false;
};

// ---- Checks.cpp ----
std::vector<EmittedLine> checkLines(const ir::Cycle& cycle, const Folder& folder, MacroText& text);

// ---- ToolPath.cpp ----
std::vector<EmittedLine> pathLines(const ir::Cycle& cycle, const Folder& folder, MacroText& text);

// ---- PathLines.cpp ----
// A line reads the variable.
bool readAnywhere(const std::vector<EmittedLine>& lines, std::string_view name);
// Assignments to what no line reads are gone.
void dropUnreadLines(std::vector<EmittedLine>& lines);
// Heights that count from the plane by themselves, beside others that take it off, get a comment: a reader,
// and lint, ask why.
void explainHeights(std::vector<EmittedLine>& lines);

// The host input in the cycle; nullopt: it does not use it.
std::optional<ir::VariableId> findHost(const ir::Cycle& cycle, std::string_view name);
// Reads the radius of the tool, of the process or of the operation, into `variable`.
void readRadius(MacroText& text, std::string_view family, std::string_view callback,
                const std::string& variable);

} // namespace dotek::backends::gibbs
