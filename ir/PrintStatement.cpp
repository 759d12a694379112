#include "ir/PrintStatement.h"

#include "support/Decimal.h"
#include "support/Printable.h"

#include <algorithm>
#include <fmt/format.h>
#include <string_view>

namespace dotek::ir {
namespace {

constexpr std::size_t kCommentColumn = 56;

std::string_view keyword(const CycleStatement& statement) {
  static constexpr std::string_view kTexts[] = {
#define DOTEK_COMMON_STATEMENT(Type, text) text,
#define DOTEK_CYCLE_STATEMENT(Type, text) text,
#include "ir/Nodes.def"
#undef DOTEK_CYCLE_STATEMENT
#undef DOTEK_COMMON_STATEMENT
  };
  return kTexts[statement.node.index()];
}

std::string_view keyword(const ProgramStatement& statement) {
  static constexpr std::string_view kTexts[] = {
#define DOTEK_COMMON_STATEMENT(Type, text) text,
#define DOTEK_PROGRAM_STATEMENT(Type, text) text,
#include "ir/Nodes.def"
#undef DOTEK_PROGRAM_STATEMENT
#undef DOTEK_COMMON_STATEMENT
  };
  return kTexts[statement.node.index()];
}

std::string_view motionText(Motion motion) {
  switch (motion) {
  case Motion::Rapid: return "rapid";
  case Motion::Feed: return "feed";
  case Motion::Protected: return "protected";
  }
  return "";
}

std::string_view spindleText(Spindle::State state) {
  switch (state) {
  case Spindle::State::Off: return "off";
  case Spindle::State::Clockwise: return "clockwise";
  case Spindle::State::CounterClockwise: return "counterclockwise";
  }
  return "";
}

std::string_view coolantText(Coolant::State state) {
  switch (state) {
  case Coolant::State::Off: return "off";
  case Coolant::State::Flood: return "flood";
  case Coolant::State::Mist: return "mist";
  }
  return "";
}

std::string_view modeText(Mode mode) {
  switch (mode) {
  case Mode::Absolute: return "absolute";
  case Mode::Incremental: return "incremental";
  case Mode::FeedPerMinute: return "feed-per-minute";
  case Mode::FeedPerRevolution: return "feed-per-revolution";
  case Mode::PlaneXY: return "plane-xy";
  case Mode::PlaneZX: return "plane-zx";
  case Mode::PlaneYZ: return "plane-yz";
  case Mode::CutterCompOff: return "cutter-comp-off";
  case Mode::CannedCycleOff: return "canned-cycle-off";
  case Mode::WorkSystem: return "work-system";
  case Mode::RapidMotion: return "rapid-motion";
  case Mode::FeedMotion: return "feed-motion";
  }
  return "";
}

char axisText(Axis axis) {
  return "xyz"[indexOf(axis)];
}

class StatementPrinter {
public:
  explicit StatementPrinter(const Names& names) : names_(names) {}

  std::string run(const CycleStatement& statement) {
    text_ = keyword(statement);
    match(statement, *this);
    return std::move(text_);
  }
  std::string run(const ProgramStatement& statement) {
    text_ = keyword(statement);
    if (statement.blockDelete != 0) word(fmt::format("unless-skipped {}", statement.blockDelete));
    match(statement, *this);
    return std::move(text_);
  }

  void operator()(const Assign& node) {
    word(names_.variable(node.variable));
    word("=");
    put(node.value);
  }
  void operator()(const Store& node) {
    text_ += " #";
    writePrimary(*node.number, names_, text_);
    word("=");
    put(node.value);
  }
  void operator()(const Label& node) { word(names_.label(node.label)); }
  void operator()(const Jump& node) { word(names_.label(node.target)); }
  void operator()(const Branch& node) {
    text_ += ' ';
    ir::write(*node.condition, names_, text_);
    word("goto");
    word(names_.label(node.target));
  }
  void operator()(const Return&) {}
  void operator()(const Move& node) {
    word(motionText(node.motion));
    bool first = true;
    for (const Axis axis : kAxes) {
      const auto& target = node.axes[indexOf(axis)];
      if (!target) continue;
      if (!first) text_ += ',';
      first = false;
      text_ += ' ';
      text_ += axisText(axis);
      word("=");
      put(*target);
    }
    put("feed", node.feed);
    if (node.point == ProbePoint::Centre) return;
    word("point");
    word(pointName(node.point));
  }
  void operator()(const Measure& node) {
    if (node.feature == Feature::Surface) {
      word("surface");
      text_ += ' ';
      text_ += axisText(node.axis);
    } else {
      word("bore");
    }
    if (node.target) {
      word("to");
      put(*node.target);
    }
    put("diameter", node.diameter);
    if (!node.setting) return;
    text_ += ", set system";
    put(node.setting->system);
    char before = ':';
    for (const Axis axis : kAxes) {
      const ExpressionPtr& nominal = node.setting->nominal[indexOf(axis)];
      if (!nominal) continue;
      text_ += before;
      before = ',';
      text_ += ' ';
      text_ += axisText(axis);
      put("=", nominal);
    }
  }
  void operator()(const CallCycle& node) {
    word(quoted(node.cycle));
    if (node.axis) {
      text_ += ' ';
      text_ += axisText(*node.axis);
    }
    if (!node.set.empty()) word("of " + quoted(node.set));
    char before = ':';
    for (const CycleArgument& argument : node.arguments) {
      text_ += before;
      before = ',';
      word(argument.parameter);
      word("=");
      if (argument.frame) word(frameName(*argument.frame));
      put(argument.value);
    }
    if (!node.setting) return;
    text_ += ", set system";
    put(node.setting->system);
    before = ':';
    for (const Axis axis : kAxes) {
      if (!node.setting->axes[indexOf(axis)]) continue;
      text_ += before;
      before = ',';
      text_ += ' ';
      text_ += axisText(axis);
      put("=", node.setting->nominal[indexOf(axis)]);
    }
  }
  void operator()(const ProbePower& node) { word(node.on ? "on" : "off"); }
  void operator()(const Spindle& node) {
    word(spindleText(node.state));
    put("speed", node.speed);
  }
  void operator()(const Coolant& node) { word(coolantText(node.state)); }
  void operator()(const SetMode& node) {
    word(modeText(node.mode));
    if (node.system) put(node.system);
  }
  void operator()(const Dwell& node) { put(node.seconds); }
  void operator()(const Stop& node) {
    if (node.optional) word("optional");
    if (node.number != 1) word(numberText(node.number));
    if (!node.message.empty()) word(quoted(node.message));
  }
  void operator()(const Alarm& node) {
    if (!node.message.empty()) word(quoted(node.message));
  }
  void operator()(const Comment& node) { word(quoted(node.text)); }
  void operator()(const OpaqueBlock& node) { words(node.words); }
  void operator()(const NcBlock& node) { words(node.words); }
  void operator()(const JumpTo& node) { put(node.number); }
  void operator()(const Loop& node) {
    word(std::to_string(node.number));
    if (node.condition) {
      text_ += ' ';
      ir::write(*node.condition, names_, text_);
    }
    word("else");
    word(names_.label(node.end));
  }
  void operator()(const LoopEnd& node) {
    word(std::to_string(node.number));
    word("goto");
    word(names_.label(node.begin));
  }
  void operator()(const Call& node) {
    static constexpr std::string_view kKinds[] = {"macro", "after-moves", "each-block", "off", "subprogram"};
    word(kKinds[static_cast<std::size_t>(node.kind)]);
    if (node.program) put(node.program);
    put("times", node.repeats);
    for (const CallArgument& argument : node.arguments) {
      text_ += std::string(", ") + argument.letter + " #" + std::to_string(argument.local) + " =";
      put(argument.value);
    }
  }
  void operator()(const Exit& node) { put("to", node.block); }
  void operator()(const Raise& node) {
    put(node.number);
    word(quoted(node.text));
  }
  void operator()(const Notice& node) {
    put(node.number);
    word(quoted(node.text));
  }
  void operator()(const Port& node) { word(node.open ? "open" : "close"); }
  void operator()(const Print& node) {
    if (node.binary) word("binary");
    for (const PrintPiece& piece : node.pieces) {
      if (piece.number)
        word(fmt::format("#{}[{}{}]", *piece.number, piece.integerDigits, piece.decimals));
      else
        word(quoted(piece.text));
    }
  }
  void operator()(const NameVariables& node) {
    word(std::to_string(node.first));
    for (const std::string& name : node.names)
      word(quoted(name));
  }

private:
  void word(std::string_view text) {
    text_ += ' ';
    text_ += text;
  }
  void put(const ExpressionPtr& expression) {
    text_ += ' ';
    ir::write(*expression, names_, text_);
  }
  // ` title expression` where there is one.
  void put(const char* title, const ExpressionPtr& expression) {
    if (!expression) return;
    word(title);
    put(expression);
  }
  void put(const Coordinate& place) {
    word(frameName(place.frame));
    if (place.system) {
      put("of", place.system);
      text_ += ':';
    }
    put(place.value);
  }
  void words(const std::vector<Word>& list) {
    for (const Word& it : list) {
      text_ += ' ';
      text_ += it.address;
      if (!it.value) continue;
      const auto* number = std::get_if<Constant>(&it.value->node);
      const bool isFile = it.address == '@' && number != nullptr; // its digits are the name
      const std::string text = isFile ? number->digits : number ? names_.number(*number) : "";
      if (number && text.find(' ') == std::string::npos) { // X-5. is one word
        text_ += text;
      } else {
        text_ += '(';
        ir::write(*it.value, names_, text_);
        text_ += ')';
      }
    }
  }

  const Names& names_;
  std::string text_;
};

} // namespace

std::string statementText(const CycleStatement& statement, const Names& names) {
  return StatementPrinter(names).run(statement);
}

std::string statementText(const ProgramStatement& statement, const Names& names) {
  return StatementPrinter(names).run(statement);
}

std::string withOrigin(std::string text, SourceRange range, const std::string& reason,
                       const SourceMap* sources) {
  std::string comment;
  if (sources && range.hasPlace())
    comment = printable(sources->file(range.file).name()) + ":" + std::to_string(sources->line(range));
  if (!reason.empty()) comment += (comment.empty() ? "" : ", ") + reason;
  // A comment ends with its line.
  std::replace_if(
      comment.begin(), comment.end(), [](char c) { return static_cast<unsigned char>(c) < ' '; }, ' ');
  if (!comment.empty()) {
    text.resize(std::max(text.size() + 1, kCommentColumn), ' ');
    text += "; " + comment;
  }
  return text;
}

} // namespace dotek::ir
