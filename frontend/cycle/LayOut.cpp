// The one layout of the language: two blanks a level, one statement a line, declarations that follow each
// other in columns, at most one empty line between two statements.
#include "frontend/cycle/Parse.h"
#include "ir/Match.h"

#include <algorithm>
#include <fmt/format.h>
#include <string_view>

namespace dotek::frontend::cycle {
namespace {

constexpr std::size_t kWidth = 100; // where calls and lists of places are broken after a comma

std::string quoted(const Text& text) {
  return "\"" + text.text + "\"";
}

std::string joined(const std::vector<Name>& names) {
  std::string out;
  for (const Name& name : names)
    out += (out.empty() ? "" : ", ") + name.text;
  return out;
}

std::string print(const Expression& expression);

std::string print(const ExpressionPtr& expression) {
  return print(*expression);
}

// Brackets are nodes of their own, so none has to be put.
std::string print(const Expression& expression) {
  return std::visit(
      ir::Overloaded{
          [](const Missing&) { return std::string("?"); },
          [](const Number& n) {
            return n.unit == Unit::None ? n.digits : fmt::format("{} {}", n.digits, unitText(n.unit));
          },
          [](const NameUse& use) { return use.name; },
          [](const Member& member) { return member.object.text + "." + member.member.text; },
          [](const WorkOffset& offset) {
            return offset.extended == 0 ? fmt::format("G{}", offset.number)
                                        : fmt::format("G54.1 P{}", offset.extended);
          },
          [](const Text& text) { return quoted(text); },
          [](const Unary& unary) { return (unary.op == UnaryOp::Not ? "not " : "-") + print(unary.operand); },
          [](const Binary& binary) {
            return print(binary.left) + std::string(operatorText(binary.op)) + print(binary.right);
          },
          [](const Function& function) {
            std::string arguments;
            for (const ExpressionPtr& argument : function.arguments)
              arguments += (arguments.empty() ? "" : ", ") + print(argument);
            return function.name.text + "(" + arguments + ")";
          },
          [](const Given& given) { return "given " + given.name.text; },
          [](const Bracketed& bracketed) { return "(" + print(bracketed.inner) + ")"; }},
      expression.node);
}

std::string print(const Coordinate& coordinate) {
  std::string out;
  if (coordinate.frame == Coordinate::Frame::Machine) out = "machine ";
  if (coordinate.frame == Coordinate::Frame::Work) out = "work " + print(coordinate.system) + " ";
  return out + axisLetter(coordinate.axis) + " " + print(coordinate.value);
}

std::string print(const std::vector<Coordinate>& coordinates) {
  std::string out;
  for (const Coordinate& coordinate : coordinates)
    out += (out.empty() ? "" : ", ") + print(coordinate);
  return out;
}

std::string print(const Clause& clause) {
  switch (clause.kind) {
  case Clause::Kind::Require:
    return "require " + print(clause.first) + (clause.text ? " " + quoted(*clause.text) : "");
  case Clause::Kind::Range: return "range " + print(clause.first) + " to " + print(clause.second);
  case Clause::Kind::Group: return "group " + quoted(*clause.text);
  case Clause::Kind::Letter: return "letter " + clause.letter->text;
  case Clause::Kind::Picture: break;
  }
  return "picture " + quoted(*clause.text);
}

// A declaration's columns: names, type and default, title, clauses.
using Columns = std::vector<std::string>;

std::optional<Columns> columnsOf(const Statement& statement) {
  const auto typed = [](const Type& type) {
    return std::string(typeText(type.name)) + (type.choices.empty() ? "" : " of " + joined(type.choices));
  };
  if (const auto* parameter = std::get_if<Parameter>(&statement.node)) {
    std::string clauses;
    for (const Clause& clause : parameter->clauses)
      clauses += (clauses.empty() ? "" : " ") + print(clause);
    return Columns{"parameter " + joined(parameter->names),
                   ": " + typed(parameter->type) + (parameter->optional ? " optional" : "") +
                       (parameter->value == nullptr ? "" : " = " + print(parameter->value)),
                   parameter->title ? quoted(*parameter->title) : "", clauses};
  }
  if (const auto* result = std::get_if<Result>(&statement.node))
    return Columns{"result    " + joined(result->names), ": " + typed(result->type),
                   result->title ? quoted(*result->title) : "", ""};
  return std::nullopt;
}

// Characters, not bytes: the columns of a text with accents.
std::size_t width(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(
      text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

class Layout {
public:
  std::string run(const File& file) {
    block(file.body, true);
    return std::move(out_);
  }

private:
  void line(const std::string& text, const std::optional<Comment>& after = std::nullopt) {
    out_.append(depth_ * 2, ' ');
    out_ += text;
    if (after) out_ += "  //" + after->text;
    out_ += '\n';
  }
  // Broken after commas where it is too long; a comma within brackets or a text breaks nothing.
  void longLine(const std::string& text, const std::optional<Comment>& after) {
    if (depth_ * 2 + width(text) <= kWidth) return line(text, after);
    std::size_t brackets = 0;
    bool quote = false, first = true;
    std::string piece;
    const auto flush = [&](bool last) {
      out_.append(depth_ * 2 + (first ? 0 : 4), ' ');
      out_ += piece;
      if (last && after) out_ += "  //" + after->text;
      out_ += '\n';
      piece.clear();
      first = false;
    };
    std::size_t begin = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
      const char c = text[i];
      if (c == '"') quote = !quote;
      if (quote) continue;
      if (c == '(') ++brackets;
      if (c == ')') --brackets;
      if (c != ',' || brackets > 0) continue;
      const std::string item = text.substr(begin, i + 1 - begin);
      if (!piece.empty() && depth_ * 2 + 4 + width(piece) + width(item) > kWidth) flush(false);
      piece += piece.empty() ? item.substr(item.find_first_not_of(' ')) : item;
      begin = i + 1;
    }
    const std::string item = text.substr(begin);
    if (!piece.empty() && depth_ * 2 + 4 + width(piece) + width(item) > kWidth) flush(false);
    piece += piece.empty() ? item.substr(item.find_first_not_of(' ')) : item;
    flush(true);
  }
  void comments(const std::vector<Comment>& all, bool& fresh) {
    for (const Comment& comment : all) {
      if (comment.blankBefore && !fresh) out_ += '\n';
      line("//" + comment.text);
      fresh = false;
    }
  }

  // `fresh`: nothing of the block is printed yet.
  void block(const Block& block, bool fresh) {
    const std::vector<Statement>& all = block.statements;
    for (std::size_t i = 0; i < all.size();) {
      std::size_t end = i;
      std::vector<Columns> table;
      while (end < all.size()) {
        const bool apart = all[end].blankBefore || !all[end].before.empty();
        if (end > i && apart) break;
        auto columns = columnsOf(all[end]);
        if (!columns) break;
        table.push_back(std::move(*columns));
        ++end;
      }
      if (table.empty()) {
        lead(all[i], fresh);
        statement(all[i]);
        ++i;
        continue;
      }
      const std::vector<std::size_t> starts = startsOf(table);
      for (std::size_t row = 0; row < table.size(); ++row) {
        lead(all[i + row], fresh);
        line(aligned(table[row], starts), all[i + row].after);
      }
      i = end;
    }
    comments(block.comments, fresh);
  }
  void lead(const Statement& statement, bool& fresh) {
    comments(statement.before, fresh);
    if (statement.blankBefore && !fresh) out_ += '\n';
    fresh = false;
  }
  // Where each column begins, so that the widest of its texts fits.
  static std::vector<std::size_t> startsOf(const std::vector<Columns>& table) {
    std::vector<std::size_t> out;
    std::size_t at = 0;
    for (std::size_t column = 0; column < table.front().size(); ++column) {
      out.push_back(at);
      std::size_t most = 0;
      for (const Columns& row : table)
        most = std::max(most, width(row[column]));
      at += most == 0 ? 0 : most + 1;
    }
    return out;
  }
  static std::string aligned(const Columns& row, const std::vector<std::size_t>& starts) {
    std::string out;
    for (std::size_t column = 0; column < row.size(); ++column) {
      if (row[column].empty()) continue;
      if (column > 0) out.append(std::max(starts[column], width(out) + 1) - width(out), ' ');
      out += row[column];
    }
    return out;
  }

  void inner(const Block& inner) {
    ++depth_;
    block(inner, true);
    --depth_;
  }
  void loop(const std::string& head, const Block& body, const Statement& statement) {
    line(head, statement.after);
    inner(body);
    line("end");
  }
  void between(const std::vector<Comment>& all) {
    ++depth_;
    bool fresh = false;
    comments(all, fresh);
    --depth_;
  }

  void statement(const Statement& s) {
    const auto simple = [&](const std::string& text) { longLine(text, s.after); };
    std::visit(
        ir::Overloaded{
            [](const ErrorStatement&) {},
            [&](const Header& header) {
              simple((header.options ? "options " : "cycle ") + header.name.text +
                     (header.title ? " " + quoted(*header.title) : ""));
            },
            [&](const Use& use) { simple("use " + use.name.text); },
            [&](const Needs&) { simple("needs probe"); },
            [](const Parameter&) {},
            [](const Result&) {},
            [&](const Require& require) {
              simple("require " + print(require.condition) +
                     (require.message ? " " + quoted(*require.message) : ""));
            },
            [&](const ProbeSwitch& probe) { simple(probe.on ? "probe on" : "probe off"); },
            [&](const SpindleOff&) { simple("spindle off"); },
            [&](const Coolant& coolant) {
              simple(coolant.state == Coolant::State::Off     ? "coolant off"
                     : coolant.state == Coolant::State::Flood ? "coolant flood"
                                                              : "coolant mist");
            },
            [&](const Dwell& dwell) { simple("dwell " + print(dwell.time)); },
            [&](const Stop& stop) { simple("stop " + quoted(stop.text)); },
            [&](const Alarm& alarm) { simple("alarm " + quoted(alarm.text)); },
            [&](const Report& report) {
              simple("report " + quoted(report.name) +
                     (report.nominal == nullptr ? "" : " nominal " + print(report.nominal)) + " measured " +
                     print(report.measured) +
                     (report.tolerance == nullptr ? "" : " tolerance " + print(report.tolerance)));
            },
            [&](const Move& move) { simple(text(move)); },
            [&](const Touch& touch) {
              const std::string head =
                  "touch " + std::string(touch.once ? "once " : "") +
                  (touch.along.empty() ? std::string(1, axisLetter(touch.axis))
                                       : "along " + print(touch.along)) +
                  (touch.reach == Reach::By ? " by " : " to ") + print(touch.value) +
                  (touch.overtravel == nullptr ? "" : " overtravel " + print(touch.overtravel)) +
                  (touch.name ? " -> " + touch.name->text : "");
              if (touch.otherwise == nullptr) return simple(head);
              loop(head + " else", *touch.otherwise, s);
            },
            [&](const SetOffset& set) {
              std::string items;
              for (const Becomes& item : set.items)
                items += fmt::format("{}{} becomes {} {}", items.empty() ? "" : ", ", print(item.value),
                                     axisLetter(item.axis), print(item.coordinate));
              simple("set " + print(set.system) + ": " + items);
            },
            [&](const SetTool& set) {
              simple(fmt::format("set tool {} {} {}", print(set.tool), toolPartText(set.part),
                                 print(set.value)));
            },
            [&](const SetStored& set) { simple("set stored " + set.name.text + " " + print(set.value)); },
            [&](const Assign& assign) { simple(assign.name.text + " = " + print(assign.value)); },
            [&](const If& choice) {
              for (std::size_t i = 0; i < choice.parts.size(); ++i) {
                const If::Part& part = choice.parts[i];
                between(part.comments);
                const std::string head = (i == 0 ? "if " : "else if ") + print(part.condition) + " then";
                if (i == 0)
                  line(head, s.after);
                else
                  line(head);
                inner(part.body);
              }
              if (choice.otherwise != nullptr) {
                between(choice.elseComments);
                line("else");
                inner(*choice.otherwise);
              }
              line("end");
            },
            [&](const Repeat& repeat) { loop("repeat " + print(repeat.count) + " times", repeat.body, s); },
            [&](const For& one) {
              loop("for " + one.name.text + " = " + print(one.first) + " to " + print(one.last) +
                       (one.step == nullptr ? "" : " step " + print(one.step)),
                   one.body, s);
            },
            [&](const While& one) {
              loop("while " + print(one.condition) + " at most " + print(one.most) + " times", one.body, s);
            },
            [&](const Call& call) {
              std::string arguments;
              for (const Argument& argument : call.arguments)
                arguments +=
                    (arguments.empty() ? " " : ", ") + argument.name.text + " = " + print(argument.value);
              for (const Name& options : call.uses)
                arguments += (arguments.empty() ? " use " : ", use ") + options.text;
              simple("call " + call.cycle.text + arguments + (call.result ? " -> " + call.result->text : ""));
            }},
        s.node);
  }
  static std::string text(const Move& move) {
    std::string out = move.kind == Move::Kind::Feed        ? "feed "
                      : move.kind == Move::Kind::Protected ? "protected "
                      : move.kindSaid                      ? "rapid "
                                                           : "";
    out += "move ";
    out += move.toStart ? "to start" : (move.reach == Reach::By ? "by " : "to ") + print(move.axes);
    return out + (move.feed == nullptr ? "" : " feed " + print(move.feed));
  }

  std::string out_;
  std::size_t depth_ = 0;
};

} // namespace

std::string layOut(const File& file) {
  return Layout().run(file);
}

std::string layOut(const Expression& expression) {
  return print(expression);
}

} // namespace dotek::frontend::cycle
