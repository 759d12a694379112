#include "frontend/gibbs/BuildTree.h"
#include "support/messages/Common.h"
#include "support/messages/Gibbs.h"

#include <algorithm>

namespace dotek::frontend::gibbs {

using Lexer = grammar::GibbsMacroLexer;

namespace {

bool opensGeometry(const Command& command) {
  const std::string key = foldCase(command.name.text);
  return key == "CONTOUR" || key == "CONTOUR_3D" || key == "POINTS";
}

If* asIf(const StatementPtr& statement) {
  return statement == nullptr ? nullptr : std::get_if<If>(&statement->node);
}

// The IF nearest to the end of the line that may still take an ELSE.
If* openForElse(const StatementPtr& statement) {
  If* found = nullptr;
  for (If* branch = asIf(statement); branch != nullptr;) {
    if (branch->elseRange) {
      branch = asIf(branch->elseStatement);
    } else {
      if (branch->then != nullptr || !branch->thenBlock.empty()) found = branch;
      branch = asIf(branch->then);
    }
  }
  return found;
}

// The IF at the end of the line that has nothing after THEN.
If* withoutThen(const StatementPtr& statement) {
  If* branch = asIf(statement);
  while (branch != nullptr && branch->then != nullptr)
    branch = asIf(branch->elseRange ? branch->elseStatement : branch->then);
  return branch != nullptr && !branch->elseRange ? branch : nullptr;
}

// Puts the lines of a macro together into blocks.
class MacroBuilder {
public:
  MacroBuilder(Lines& lines, Macro& macro) : lines_(lines), build_(lines), macro_(macro) {}

  void run() {
    while (lines_.next())
      addLine();
    endWaiting();
    const auto open =
        std::find_if(blocks_.rbegin(), blocks_.rend(), [](const Block& b) { return !b.transparent; });
    if (open != blocks_.rend() && !lines_.hasError()) lines_.report<diag::UnclosedBlock>(open->open);
  }

private:
  struct Block {
    std::vector<Line>* into = nullptr; // null: a geometry block
    GeometryBlock* geometry = nullptr;
    If* branch = nullptr;
    bool isElse = false;
    bool transparent = false; // opened after a broken line: its lines belong to the outer list
    SourceRange open;
  };
  // A line that needs `[` on the next one.
  struct Waiting {
    Statement* statement = nullptr; // the whole line, which becomes an error node
    If* branch = nullptr;
    bool isElse = false;
    GeometryBlock* geometry = nullptr;
    SourceRange place;
  };

  std::vector<Line>& list() {
    for (auto block = blocks_.rbegin(); block != blocks_.rend(); ++block)
      if (block->into != nullptr) return *block->into;
    return macro_.lines;
  }
  GeometryBlock* geometry() { return blocks_.empty() ? nullptr : blocks_.back().geometry; }

  void addError() {
    endWaiting();
    if (geometry() == nullptr) list().push_back({std::nullopt, build_.errorStatement(lines_.range())});
    afterError_ = true;
  }

  void addLine() {
    auto* tree = dynamic_cast<MacroParser::LineContext*>(lines_.parse());
    if (tree == nullptr || tree->lineContent() == nullptr) return addError();
    MacroParser::LineContentContext& content = *tree->lineContent();
    if (dynamic_cast<MacroParser::BlockOpenContext*>(&content) != nullptr) return openBlock();
    if (auto* close = dynamic_cast<MacroParser::BlockCloseContext*>(&content)) return closeBlock(*close);
    endWaiting();
    if (auto* plain = dynamic_cast<MacroParser::PlainContext*>(&content)) addStatement(*plain->oneLine());
    if (auto* labelled = dynamic_cast<MacroParser::LabelledContext*>(&content)) addLabel(*labelled);
    if (auto* other = dynamic_cast<MacroParser::ElseLineContext*>(&content)) {
      If* branch = list().empty() || afterError_ ? nullptr : openForElse(list().back().statement);
      addElse(branch, *other->KW_ELSE()->getSymbol(), other->elsePart());
    }
  }

  void addLabel(MacroParser::LabelledContext& tree) {
    MacroParser::LabelContext& label = *tree.label();
    Line line;
    line.label = Label{build_.name(*label.LABEL_NAME()), label.getStart()->getType() == Lexer::COLON};
    if (geometry() != nullptr) {
      lines_.report<diag::SyntaxError>(lines_.range(), notAnElement());
      return;
    }
    if (tree.oneLine() != nullptr) {
      const SourceRange range = lines_.rangeOf(*tree.oneLine());
      lines_.report<diag::LabelNotAlone>(range, line.label->name.text);
      line.statement = build_.errorStatement(range);
    }
    list().push_back(std::move(line));
    afterError_ = lines_.hasError();
  }

  // One statement and the ELSEs on its line.
  StatementPtr buildLine(MacroParser::OneLineContext& tree) {
    const std::vector<MacroParser::StatementContext*> parts = tree.statement();
    StatementPtr whole = build_.statement(*parts[0]);
    for (std::size_t i = 1; i < parts.size(); ++i) {
      const SourceRange range = lines_.rangeOf(*tree.KW_ELSE(i - 1)->getSymbol());
      If* branch = openForElse(whole);
      if (branch == nullptr) {
        lines_.report<diag::SyntaxError>(range, "this ELSE has no IF with a statement before it");
        return build_.errorStatement(lines_.rangeOf(tree));
      }
      branch->elseRange = range;
      branch->elseStatement = build_.statement(*parts[i]);
    }
    whole->range = lines_.rangeOf(tree);
    return whole;
  }

  void addStatement(MacroParser::OneLineContext& tree) {
    StatementPtr statement = buildLine(tree);
    if (lines_.hasError()) statement = build_.errorStatement(statement->range);
    afterError_ = lines_.hasError();
    if (geometry() != nullptr) return addElement(std::move(statement));
    if (!afterError_) await(*statement, statement, tree);
    list().push_back({std::nullopt, std::move(statement)});
    openOnSameLine(tree);
  }

  // Remembers what an IF or a CONTOUR at the end of the line still needs.
  void await(Statement& whole, const StatementPtr& statement, MacroParser::OneLineContext& tree) {
    if (If* branch = withoutThen(statement)) {
      waiting_ = {&whole, branch, false, nullptr, branch->thenRange};
      return;
    }
    auto* command = std::get_if<Command>(&statement->node);
    if (command == nullptr || !opensGeometry(*command)) return;
    if (!command->arguments.empty() || command->commaAfterName) {
      lines_.report<diag::SyntaxError>(lines_.rangeOf(tree),
                                       "nothing follows " + foldCase(command->name.text) +
                                           "; its elements are between `[` and `]` on the next lines");
      whole.node = ErrorStatement{};
      afterError_ = true;
      return;
    }
    auto block = std::make_unique<GeometryBlock>();
    block->kind = command->name;
    waiting_ = {&whole, nullptr, false, block.get(), block->kind.range};
    whole.node = std::move(block);
  }

  void openOnSameLine(antlr4::ParserRuleContext& tree) {
    if (waiting_.statement != nullptr && tree.getStop()->getType() == Lexer::LEFT_SQUARE) openBlock();
  }

  std::string notAnElement() const {
    return "only START, RAPID, LINE, ARC and POINT are in a block of CONTOUR or POINTS";
  }

  void addElement(StatementPtr statement) {
    if (auto* command = std::get_if<Command>(&statement->node)) {
      geometry()->elementRanges.push_back(statement->range);
      geometry()->elements.push_back(std::move(*command));
    } else if (!std::holds_alternative<ErrorStatement>(statement->node)) {
      lines_.report<diag::SyntaxError>(statement->range, notAnElement());
    }
  }

  void endWaiting() {
    if (waiting_.statement == nullptr) return;
    std::string text;
    if (waiting_.geometry != nullptr)
      text = "`[` is missing on the line after " + foldCase(waiting_.geometry->kind.text);
    else
      text = std::string("nothing follows ") + (waiting_.isElse ? "ELSE" : "THEN") +
             "; the statement belongs on the same line";
    lines_.report<diag::SyntaxError>(waiting_.place, text);
    waiting_.statement->node = ErrorStatement{};
    waiting_ = {};
    afterError_ = true;
  }

  void openBlock() {
    Block block;
    block.open = waiting_.statement != nullptr ? waiting_.place : lines_.range();
    if (blocks_.size() >= lines_.context().limits.nesting) {
      lines_.report<diag::NestingTooDeep>(lines_.range(), lines_.context().limits.nesting);
      block.transparent = true;
      if (waiting_.statement != nullptr) waiting_.statement->node = ErrorStatement{};
      waiting_ = {};
    } else if (waiting_.geometry != nullptr) {
      block.geometry = waiting_.geometry;
    } else if (waiting_.branch != nullptr) {
      block.branch = waiting_.branch;
      block.isElse = waiting_.isElse;
      block.into = waiting_.isElse ? &waiting_.branch->elseBlock : &waiting_.branch->thenBlock;
    } else {
      if (!afterError_)
        lines_.report<diag::SyntaxError>(
            lines_.range(), "this `[` opens no block; it is on the line after CONTOUR, CONTOUR_3D or POINTS");
      block.transparent = true;
    }
    waiting_ = {};
    afterError_ = false;
    blocks_.push_back(block);
  }

  void closeBlock(MacroParser::BlockCloseContext& tree) {
    endWaiting();
    if (blocks_.empty()) {
      if (!afterError_) lines_.report<diag::SyntaxError>(lines_.range(), "this `]` closes no block");
      list().push_back({std::nullopt, build_.errorStatement(lines_.range())});
      return;
    }
    const Block closed = blocks_.back();
    blocks_.pop_back();
    afterError_ = closed.transparent;
    if (closed.geometry != nullptr)
      closed.geometry->closeRange = lines_.rangeOf(*tree.RIGHT_SQUARE()->getSymbol());
    if (tree.KW_ELSE() != nullptr)
      addElse(closed.isElse ? nullptr : closed.branch, *tree.KW_ELSE()->getSymbol(), tree.elsePart());
  }

  void addElse(If* branch, const antlr4::Token& token, MacroParser::ElsePartContext* part) {
    const SourceRange range = lines_.rangeOf(token);
    if (branch == nullptr || branch->elseRange || geometry() != nullptr) {
      if (!afterError_)
        lines_.report<diag::SyntaxError>(range, "this ELSE belongs to no IF; GibbsCAM macros have no ELSE "
                                                "that a source proves; write a second IF");
      if (geometry() == nullptr) list().push_back({std::nullopt, build_.errorStatement(lines_.range())});
      afterError_ = true;
      return;
    }
    branch->elseRange = range;
    Statement& whole = *list().back().statement;
    if (part != nullptr && part->oneLine() != nullptr) {
      branch->elseStatement = buildLine(*part->oneLine());
      if (lines_.hasError()) whole.node = ErrorStatement{};
      afterError_ = lines_.hasError();
      if (!afterError_) await(whole, branch->elseStatement, *part->oneLine());
      openOnSameLine(*part);
      return;
    }
    waiting_ = {&whole, branch, true, nullptr, range};
    if (part != nullptr) openBlock();
  }

  Lines& lines_;
  TreeBuilder build_;
  Macro& macro_;
  std::vector<Block> blocks_;
  Waiting waiting_;
  bool afterError_ = false;
};

} // namespace

Macro parseMacro(FileId file, const ParseContext& context) {
  Macro macro;
  macro.file = file;
  Lines lines(file, FileKind::Macro, context);
  MacroBuilder(lines, macro).run();
  macro.comments = lines.comments();
  macro.hasErrorNodes = lines.finish();
  return macro;
}

} // namespace dotek::frontend::gibbs
