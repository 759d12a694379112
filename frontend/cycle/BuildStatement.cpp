#include "frontend/cycle/BuildAst.h"
#include "frontend/cycle/Words.h"
#include "support/NearestName.h"
#include "support/WriteInstead.h"
#include "support/messages/Cycle.h"

#include <fmt/format.h>

namespace dotek::frontend::cycle {

// ---- pieces ----------------------------------------------------------------------------------------------

Name Builder::name(Parser::NameContext& context) {
  Name out;
  out.range = rangeOf(context);
  out.text = sources_.text(out.range);
  if (context.NAME() != nullptr) return out;
  const std::string shown = sources_.textUtf8(out.range);
  if (isReserved(out.text)) {
    error<diag::WordAsName>(out.range, shown, proposeName(out.text));
    return out;
  }
  // Under the name that is to be written other lines know it.
  const std::string right = proposeName(out.text);
  error<diag::NameSpelling>(out.range, shown, right);
  out.text = right;
  return out;
}

std::vector<Name> Builder::names(Parser::NamesContext& context) {
  std::vector<Name> out;
  for (Parser::NameContext* one : context.name())
    out.push_back(name(*one));
  return out;
}

Text Builder::text(Parser::TextContext& context) {
  Text out;
  out.range = rangeOf(context);
  const bool closed = context.TEXT() != nullptr;
  if (!closed) error<diag::TextNotClosed>(out.range);
  out.text = sources_.textUtf8({file_.file, out.range.begin + 1, out.range.end - (closed ? 1U : 0U)});
  return out;
}

std::optional<Text> Builder::optionalText(Parser::TextContext* context) {
  return context == nullptr ? std::nullopt : std::optional(text(*context));
}

Axis Builder::axis(const antlr4::Token& token) const {
  return static_cast<Axis>(std::string_view("xyzabc").find(sources_.text(rangeOf(token))));
}

Type Builder::type(Parser::TypeContext& context) {
  Type out;
  out.range = rangeOf(context);
  if (context.KW_CHOICE() != nullptr) {
    out.name = TypeName::Choice;
    for (Parser::ChoiceNameContext* choice : context.choiceName()) {
      const SourceRange range = rangeOf(*choice);
      out.choices.push_back({range, std::string(sources_.text(range))});
      const std::string& word = out.choices.back().text;
      if (!isName(word)) error<diag::NameSpelling>(range, sources_.textUtf8(range), proposeName(word));
      if (isReserved(word)) error<diag::WordAsName>(range, word, proposeName(word));
    }
    return out;
  }
  const std::string word(sources_.text(out.range));
  if (const std::optional<TypeName> known = typeOf(word)) {
    out.name = *known;
    return out;
  }
  const std::optional<Unit> unit = unitOf(word);
  const bool isLength = unit == Unit::Millimetre || unit == Unit::Inch;
  const std::string near = isLength               ? "length"
                           : unit == Unit::Degree ? "angle"
                           : unit == Unit::Second ? "time"
                           : unit                 ? "feed"
                           : word == "number"     ? "count"
                           : word == "distance"   ? "length"
                           : word == "bool"       ? "flag"
                           : word == "string"     ? "text"
                                                  : nearestName(word, typeWords());
  error<diag::UnknownType>(out.range, word, near.empty() ? "" : " (did you mean `" + near + "`?)").fix =
      writeInstead(out.range, near);
  // What is meant, so that the value beside it is not judged by another type.
  if (const std::optional<TypeName> meant = typeOf(near)) out.name = *meant;
  return out;
}

Clause Builder::clause(Parser::ClauseContext& context) {
  Clause out;
  out.range = rangeOf(context);
  if (auto* require = dynamic_cast<Parser::RequireClauseContext*>(&context)) {
    out.first = expression(require->expression());
    out.text = optionalText(require->text());
  } else if (auto* bounds = dynamic_cast<Parser::RangeClauseContext*>(&context)) {
    out.kind = Clause::Kind::Range;
    out.first = expression(bounds->expression(0));
    out.second = expression(bounds->expression(1));
  } else if (auto* group = dynamic_cast<Parser::GroupClauseContext*>(&context)) {
    out.kind = Clause::Kind::Group;
    out.text = text(*group->text());
  } else if (auto* picture = dynamic_cast<Parser::PictureClauseContext*>(&context)) {
    out.kind = Clause::Kind::Picture;
    out.text = text(*picture->text());
  } else {
    out.kind = Clause::Kind::Letter;
    const SourceRange where = rangeOf(*context.getStop());
    out.letter = {where, std::string(sources_.text(where))};
    const std::string& letter = out.letter->text;
    if (letter.size() != 1 || letter[0] < 'A' || letter[0] > 'Z')
      error<diag::LetterWish>(where, sources_.textUtf8(where),
                              "is no letter of a macro call; write one capital, `letter D`");
    else if (std::string_view("GLNOP").find(letter[0]) != std::string_view::npos)
      error<diag::LetterWish>(
          where, letter,
          "hands nothing over, as a call takes G, L, N, O and P for itself; write another "
          "capital, `letter D`");
  }
  return out;
}

Parameter Builder::parameter(Parser::ParameterContext& context) {
  Parameter out;
  out.names = names(*context.names());
  out.type = type(*context.type());
  out.optional = context.KW_OPTIONAL() != nullptr;
  if (context.initial() != nullptr) out.value = expression(context.initial()->expression());
  out.title = optionalText(context.text());
  for (Parser::ClauseContext* one : context.clause())
    out.clauses.push_back(clause(*one));
  return out;
}

Coordinate Builder::coordinate(Parser::CoordinateContext& context) {
  Coordinate out;
  out.range = rangeOf(context);
  if (context.KW_MACHINE() != nullptr) out.frame = Coordinate::Frame::Machine;
  if (context.KW_WORK() != nullptr) {
    out.frame = Coordinate::Frame::Work;
    out.system = primary(*context.primary());
  }
  out.axis = axis(*context.AXIS()->getSymbol());
  out.value = expression(context.expression());
  return out;
}

std::vector<Coordinate> Builder::coordinates(Parser::CoordinatesContext& context) {
  std::vector<Coordinate> out;
  for (Parser::CoordinateContext* one : context.coordinate())
    out.push_back(coordinate(*one));
  return out;
}

Move Builder::move(Parser::MoveContext& context) {
  Move out;
  if (context.moveKind() != nullptr) {
    out.kindSaid = true;
    out.kind = context.moveKind()->KW_FEED() != nullptr        ? Move::Kind::Feed
               : context.moveKind()->KW_PROTECTED() != nullptr ? Move::Kind::Protected
                                                               : Move::Kind::Rapid;
  }
  out.toStart = context.KW_START() != nullptr;
  if (context.reach() != nullptr) {
    out.reach = context.reach()->KW_BY() != nullptr ? Reach::By : Reach::To;
    out.axes = coordinates(*context.coordinates());
  }
  if (context.expression() != nullptr) out.feed = expression(context.expression());
  return out;
}

// The comparison that the expression is; nullptr: another one.
Builder::Parser::ComparisonContext* Builder::comparisonIn(Parser::ExpressionContext& context) {
  if (context.conjunction().size() != 1 || context.conjunction(0)->negation().size() != 1) return nullptr;
  Parser::ComparisonContext* const found = context.conjunction(0)->negation(0)->comparison();
  return found != nullptr && found->comparator() != nullptr ? found : nullptr;
}

// `touch x by 5 mm = left`, `touch x by 5 mm <- left`: the name that was to be given; reported.
std::optional<Name> Builder::nameCompared(Parser::ExpressionContext& last, Parser::TouchContext& touch) {
  Parser::ComparisonContext* const found = comparisonIn(last);
  if (found == nullptr) return std::nullopt;
  const SourceRange right = rangeOf(*found->sum(1));
  std::string_view text = sources_.text(right);
  const bool arrow = found->comparator()->LESS() != nullptr && text.starts_with('-'); // `<-`
  if (arrow) text = text.substr(std::min(text.find_first_not_of("- "), text.size()));
  if (!isName(text)) return std::nullopt;
  Name out{{right.file, right.end - static_cast<std::uint32_t>(text.size()), right.end}, std::string(text)};
  const SourceRange sign = rangeOf(*found->comparator());
  const std::string before =
      sources_.textUtf8({right.file, rangeOf(touch).begin, rangeOf(*found->sum(0)).end});
  Diagnostic& said =
      error<diag::TouchNameSign>(sign, before, isReserved(text) ? proposeName(text) : std::string(text));
  said.fix =
      Fix{Fix::Applicability::Display, "write `->`", {{{right.file, sign.begin, out.range.begin}, "-> "}}};
  return out;
}

Touch Builder::touch(Parser::TouchContext& context) {
  Touch out;
  out.once = context.KW_ONCE() != nullptr;
  if (context.touchAxis()->AXIS() != nullptr)
    out.axis = axis(*context.touchAxis()->AXIS()->getSymbol());
  else
    out.along = coordinates(*context.touchAxis()->coordinates());
  out.reach = context.reach()->KW_BY() != nullptr ? Reach::By : Reach::To;
  const bool named = context.name() != nullptr;
  Parser::ExpressionContext* const last = context.expression().back();
  const std::optional<Name> compared = named ? std::nullopt : nameCompared(*last, context);
  const auto part = [&](Parser::ExpressionContext* given) {
    return compared && given == last ? sum(*comparisonIn(*given)->sum(0)) : expression(given);
  };
  out.value = part(context.expression(0));
  if (context.KW_OVERTRAVEL() != nullptr) out.overtravel = part(context.expression(1));
  out.name = compared;
  if (named) out.name = name(*context.name());
  if (context.KW_ELSE() != nullptr) out.otherwise = std::make_unique<Block>();
  return out;
}

Call Builder::call(Parser::CallContext& context) {
  Call out;
  out.cycle = name(*context.name(0));
  for (Parser::ArgumentContext* one : context.argument()) {
    if (one->KW_USE() != nullptr) {
      out.uses.push_back(name(*one->name()));
      continue;
    }
    const SourceRange range = rangeOf(*one->NAME()->getSymbol());
    out.arguments.push_back({{range, std::string(sources_.text(range))}, expression(one->expression())});
  }
  if (context.ARROW() != nullptr) out.result = name(*context.name(1));
  return out;
}

// ---- statements ------------------------------------------------------------------------------------------

void Builder::elsePart(SourceRange range, Parser::ExpressionContext* condition) {
  If* choice = open_.empty() ? nullptr : std::get_if<If>(&open_.back().statement.node);
  // After the `end` of an `if`, which then is one too many.
  if (std::vector<Statement>& before = statements(); !before.empty() && choice == nullptr) {
    If* const closed = std::get_if<If>(&before.back().node);
    if (closed != nullptr && closed->otherwise == nullptr) {
      error<diag::ElseOutOfPlace>(
          range,
          fmt::format("the `end` of line {} has closed it; take that `end` out, as one `end` after the "
                      "last part closes them all",
                      lineOf(before.back().range.end)));
      Open again{std::move(before.back()), range, "if"};
      before.pop_back();
      open_.push_back(std::move(again));
      choice = std::get_if<If>(&open_.back().statement.node);
    }
  }
  if (choice == nullptr || choice->otherwise != nullptr) {
    error<diag::ElseOutOfPlace>(range, choice == nullptr ? "no `if` is open here"
                                                         : "the `if` has an `else` already, and nothing "
                                                           "follows that");
    return;
  }
  std::vector<Comment> before = commentsBefore(range.begin);
  if (condition != nullptr) {
    If::Part part;
    part.condition = expression(condition);
    part.comments = std::move(before);
    choice->parts.push_back(std::move(part));
  } else {
    choice->otherwise = std::make_unique<Block>();
    choice->elseComments = std::move(before);
  }
}

void Builder::statement(Parser::StatementContext& context) {
  Statement out;
  out.range = rangeOf(context);
  const SourceRange word = rangeOf(*context.getStart());
  const auto simple = [&](auto node) {
    out.node = std::move(node);
    add(std::move(out));
  };
  if (auto* header = dynamic_cast<Parser::HeaderContext*>(&context))
    return simple(
        Header{header->KW_OPTIONS() != nullptr, name(*header->name()), optionalText(header->text())});
  if (auto* use = dynamic_cast<Parser::UseContext*>(&context))
    return simple(Use{name(*use->name()), nullptr});
  if (dynamic_cast<Parser::NeedsContext*>(&context) != nullptr) return simple(Needs{});
  if (auto* one = dynamic_cast<Parser::ParameterContext*>(&context)) return simple(parameter(*one));
  if (auto* one = dynamic_cast<Parser::ResultContext*>(&context))
    return simple(Result{names(*one->names()), type(*one->type()), optionalText(one->text())});
  if (auto* one = dynamic_cast<Parser::RequireContext*>(&context))
    return simple(Require{expression(one->expression()), optionalText(one->text())});
  if (auto* one = dynamic_cast<Parser::ProbeContext*>(&context))
    return simple(ProbeSwitch{one->KW_ON() != nullptr});
  if (dynamic_cast<Parser::SpindleContext*>(&context) != nullptr) return simple(SpindleOff{});
  if (auto* one = dynamic_cast<Parser::CoolantContext*>(&context))
    return simple(Coolant{one->KW_FLOOD() != nullptr  ? Coolant::State::Flood
                          : one->KW_MIST() != nullptr ? Coolant::State::Mist
                                                      : Coolant::State::Off});
  if (auto* one = dynamic_cast<Parser::DwellContext*>(&context))
    return simple(Dwell{expression(one->expression())});
  if (auto* one = dynamic_cast<Parser::StopContext*>(&context)) return simple(Stop{text(*one->text())});
  if (auto* one = dynamic_cast<Parser::AlarmContext*>(&context)) return simple(Alarm{text(*one->text())});
  if (auto* one = dynamic_cast<Parser::ReportContext*>(&context)) {
    Report report;
    report.name = text(*one->text());
    std::size_t next = 0;
    if (one->KW_NOMINAL() != nullptr) report.nominal = expression(one->expression(next++));
    report.measured = expression(one->expression(next++));
    if (one->KW_TOLERANCE() != nullptr) report.tolerance = expression(one->expression(next));
    return simple(std::move(report));
  }
  if (auto* one = dynamic_cast<Parser::MoveContext*>(&context)) return simple(move(*one));
  if (auto* one = dynamic_cast<Parser::TouchContext*>(&context)) {
    Touch node = touch(*one);
    const bool opens = node.otherwise != nullptr;
    out.node = std::move(node);
    return opens ? open(std::move(out), word, "touch .. else") : add(std::move(out));
  }
  if (auto* one = dynamic_cast<Parser::SetOffsetContext*>(&context)) {
    SetOffset set;
    set.system = expression(one->expression());
    for (Parser::BecomesContext* item : one->becomes())
      set.items.push_back({expression(item->expression(0)), axis(*item->AXIS()->getSymbol()),
                           expression(item->expression(1))});
    return simple(std::move(set));
  }
  if (auto* one = dynamic_cast<Parser::SetToolContext*>(&context))
    return simple(SetTool{expression(one->expression(0)),
                          toolPartOf(one->toolPart()->getText()).value_or(ToolPart::Length),
                          expression(one->expression(1))});
  if (auto* one = dynamic_cast<Parser::SetStoredContext*>(&context))
    return simple(SetStored{name(*one->name()), expression(one->expression())});
  if (auto* one = dynamic_cast<Parser::CallContext*>(&context)) return simple(call(*one));
  if (auto* one = dynamic_cast<Parser::AssignContext*>(&context))
    return simple(Assign{{word, std::string(sources_.text(word))}, expression(one->expression())});
  if (auto* one = dynamic_cast<Parser::IfLineContext*>(&context)) {
    If choice;
    choice.parts.push_back({expression(one->expression()), {}, {}});
    out.node = std::move(choice);
    return open(std::move(out), word, "if");
  }
  if (auto* one = dynamic_cast<Parser::RepeatLineContext*>(&context)) {
    out.node = Repeat{expression(one->expression()), {}};
    return open(std::move(out), word, "repeat");
  }
  if (auto* one = dynamic_cast<Parser::ForLineContext*>(&context)) {
    For loop;
    loop.name = name(*one->name());
    loop.first = expression(one->expression(0));
    loop.last = expression(one->expression(1));
    if (one->KW_STEP() != nullptr) loop.step = expression(one->expression(2));
    out.node = std::move(loop);
    return open(std::move(out), word, "for");
  }
  if (auto* one = dynamic_cast<Parser::WhileLineContext*>(&context)) {
    out.node = While{expression(one->expression(0)), expression(one->expression(1)), {}};
    return open(std::move(out), word, "while");
  }
  if (auto* one = dynamic_cast<Parser::ElseIfLineContext*>(&context))
    return elsePart(out.range, one->expression());
  if (dynamic_cast<Parser::ElseLineContext*>(&context) != nullptr) return elsePart(out.range, nullptr);
  close(out.range, true);
}

} // namespace dotek::frontend::cycle
