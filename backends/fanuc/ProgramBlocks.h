// Lines of one program, its header aside. Private to Program*.cpp.
#pragma once

#include "backends/fanuc/ProgramChecks.h"
#include "backends/fanuc/ProgramNumbers.h"
#include "backends/fanuc/ProgramText.h"

#include <string>
#include <vector>

namespace dotek::backends::fanuc {

// A comment as the control takes it, without brackets: the bytes of the source where they are ASCII, else
// without accents and with a note.
std::string commentText(const std::string& text, SourceRange range, const ProgramContext& context);

class ProgramBlocks {
public:
  ProgramBlocks(const ir::Program& program, ProgramNumbers& numbers, const ProgramContext& context,
                std::vector<EmittedLine>& out);

  void run();

private:
  struct PlacedComment {
    std::uint32_t place = 0;
    std::string text;
  };

  void nameLabels();
  std::size_t endOfThen(std::size_t branch) const;
  void statements(std::size_t begin, std::size_t end);
  std::size_t branch(std::size_t at);
  void jumpWhere(const ir::ConditionPtr& condition, const std::string& target);
  void skipUnless(const ir::ConditionPtr& condition, ir::LabelId behind, const std::string& statement);
  void split(const ir::ConditionPtr& condition, const std::string& target);
  bool isSplit(const ir::ConditionPtr& condition) const;
  void demandSimple(const ir::ConditionPtr& condition);
  void loop(const ir::Loop& loop);

  void label(ir::LabelId label);
  void words(const std::vector<ir::Word>& words);
  void word(char address, const ir::ExpressionPtr& value);
  void call(const ir::Call& call);
  void exit(const ir::Exit& exit);
  // The text of a macro statement that may follow THEN; "": none.
  std::string macro(const ir::ProgramStatement& statement);
  std::string message(const std::string& text);

  std::string condition(const ir::ConditionPtr& condition);
  std::string bounded(std::string text, std::uint32_t most);
  // Ends the line that is being made, and adds one.
  void flush();
  void line(std::string statement);
  void refuse(const char* what);

  const ir::Program& program_;
  ProgramNumbers& numbers_;
  const ProgramContext& context_;
  const ProgramText text_;
  std::vector<EmittedLine>& out_;
  ir::LabelId made_; // next label that is made up
  // The block that is being written.
  const ir::ProgramStatement* statement_ = nullptr;
  std::string blockDelete_;
  std::string number_;
  std::vector<std::string> words_;
  std::vector<PlacedComment> comments_;
  SourceRange range_;
};

} // namespace dotek::backends::fanuc
