#include "ir/Print.h"

#include "ir/Names.h"

#include <algorithm>
#include <string_view>

namespace dotek::ir {
namespace {

constexpr std::size_t kCommentColumn = 56;

std::string_view keyword(const Statement& statement) {
  static constexpr std::string_view kTexts[] = {
#define DOTEK_STATEMENT(Type, text) text,
#include "ir/Nodes.def"
#undef DOTEK_STATEMENT
      "nothing"};
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

class Printer {
public:
  Printer(const Cycle& cycle, const SourceMap* sources) : cycle_(cycle), names_(cycle), sources_(sources) {}

  std::string run() {
    line(0, "cycle " + nameText(cycle_.name) + (cycle_.title.empty() ? "" : " " + quoted(cycle_.title)),
         cycle_.range, "");
    if (!cycle_.measurementStated) line(2, "measurement not stated", {}, "");
    for (VariableId id = 0; id < cycle_.variables.size(); ++id)
      declare(id);
    declareLabels();
    list("checks", cycle_.checks);
    list("body", cycle_.body);
    return std::move(out_);
  }

private:
  void line(std::size_t indent, std::string text, SourceRange range, const std::string& reason) {
    text.insert(0, indent, ' ');
    std::string comment;
    if (sources_ && range.hasPlace())
      comment = sources_->file(range.file).name() + ":" + std::to_string(sources_->line(range));
    if (!reason.empty()) comment += (comment.empty() ? "" : ", ") + reason;
    // A comment ends with its line.
    std::replace_if(
        comment.begin(), comment.end(), [](char c) { return static_cast<unsigned char>(c) < ' '; }, ' ');
    if (!comment.empty()) {
      text.resize(std::max(text.size() + 1, kCommentColumn), ' ');
      text += "; " + comment;
    }
    out_ += text + "\n";
  }

  void declare(VariableId id) {
    static constexpr std::string_view kRoles[] = {"parameter", "host", "local"};
    const Variable& variable = cycle_.variables[id];
    const std::string name = nameText(variable.name);
    std::string text(kRoles[static_cast<std::size_t>(variable.role)]);
    text += " " + name;
    if (names_.variable(id) != name) text += " as " + names_.variable(id);
    text += " ";
    text += kindName(variable.kind);
    if (!variable.unit.empty()) text += " in " + nameText(variable.unit);
    if (variable.optional) text += " optional";
    if (variable.defaultValue)
      text += " = " + constantText(*variable.defaultValue, variable.defaultDigits);
    else if (!variable.defaultDigits.empty())
      text += " = written " + quoted(variable.defaultDigits);
    if (!variable.meaning.empty()) text += " " + quoted(variable.meaning);
    line(2, std::move(text), variable.range, "");
  }

  // Labels are numbered in the order in which they are placed; what differs is declared.
  void declareLabels() {
    LabelId next = 0;
    for (const auto* list : {&cycle_.checks, &cycle_.body})
      for (const Statement& statement : *list)
        if (const auto* label = std::get_if<Label>(&statement.node))
          next = label->label == next ? next + 1 : static_cast<LabelId>(cycle_.labels.size() + 1);
    if (next == cycle_.labels.size()) return;
    std::string text = "labels";
    for (LabelId id = 0; id < cycle_.labels.size(); ++id)
      text += " " + names_.label(id);
    line(2, std::move(text), {}, "");
  }

  void list(const char* title, const std::vector<Statement>& statements) {
    line(2, title, {}, "");
    for (const Statement& statement : statements) {
      text_ = keyword(statement);
      std::visit([&](const auto& node) { write(node); }, statement.node);
      const bool label = std::holds_alternative<Label>(statement.node);
      line(label ? 2 : 4, std::move(text_), statement.origin.range(), statement.origin.reason);
    }
  }

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

  void write(const Assign& node) {
    word(names_.variable(node.variable));
    word("=");
    put(node.value);
  }
  void write(const Store& node) {
    text_ += " #";
    writePrimary(*node.number, names_, text_);
    word("=");
    put(node.value);
  }
  void write(const Label& node) { word(names_.label(node.label)); }
  void write(const Jump& node) { word(names_.label(node.target)); }
  void write(const Branch& node) {
    text_ += ' ';
    ir::write(*node.condition, names_, text_);
    word("goto");
    word(names_.label(node.target));
  }
  void write(const Return&) {}
  void write(const Move& node) {
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
  void write(const Measure& node) {
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
  void write(const ProbePower& node) { word(node.on ? "on" : "off"); }
  void write(const Spindle& node) {
    word(spindleText(node.state));
    put("speed", node.speed);
  }
  void write(const Coolant& node) { word(coolantText(node.state)); }
  void write(const SetMode& node) {
    word(modeText(node.mode));
    if (node.system) put(node.system);
  }
  void write(const Dwell& node) { put(node.seconds); }
  void write(const Stop& node) {
    if (node.optional) word("optional");
    if (!node.message.empty()) word(quoted(node.message));
  }
  void write(const Alarm& node) {
    if (!node.message.empty()) word(quoted(node.message));
  }
  void write(const Comment& node) { word(quoted(node.text)); }
  void write(const OpaqueBlock& node) {
    for (const Word& it : node.words) {
      text_ += ' ';
      text_ += it.address;
      if (!it.value) continue;
      const auto* number = std::get_if<Constant>(&it.value->node);
      const std::string text = number ? names_.number(*number) : "";
      if (number && text.find(' ') == std::string::npos) { // X-5. is one word
        text_ += text;
      } else {
        text_ += '(';
        ir::write(*it.value, names_, text_);
        text_ += ')';
      }
    }
  }
  void write(std::monostate) {}

  const Cycle& cycle_;
  Names names_;
  const SourceMap* sources_;
  std::string out_;
  std::string text_; // of the statement at work
};

} // namespace

std::string print(const Module& module, const SourceMap* sources) {
  std::string out = module.sourceUnit == LengthUnit::Inch ? "units inch\n" : "units mm\n";
  for (const Cycle& cycle : module.cycles)
    out += "\n" + Printer(cycle, sources).run();
  return out;
}

} // namespace dotek::ir
