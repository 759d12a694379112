// Commands and functions: their names and their arguments.
#include "frontend/gibbs/Check.h"
#include "frontend/gibbs/Explain.h"
#include "frontend/gibbs/Unverified.h"
#include "support/NearestName.h"
#include "support/WriteInstead.h"

#include <algorithm>

namespace dotek::frontend::gibbs {

using stdlib::ArgumentSpec;
using stdlib::CommandSignature;

namespace {

template <class Visit> void eachCommand(const CheckedFile& input, const Visit& visit) {
  for (const Statement* statement : input.statements)
    if (const auto* command = std::get_if<Command>(&statement->node))
      visit(*command, foldCase(command->name.text));
}

// Functions that the tables know, with what they take.
template <class Visit> void eachFunction(const CheckedFile& input, const Visit& visit) {
  for (const Expression* expression : input.expressions) {
    const auto* call = std::get_if<FunctionCall>(&expression->node);
    const stdlib::FunctionSpec* spec = call == nullptr ? nullptr : input.keywords.function(call->name.text);
    if (spec != nullptr && !spec->open) visit(*call, *spec, expression->range);
  }
}

std::string formOf(const stdlib::FunctionSpec& spec) {
  std::string form = spec.name + "(";
  for (std::size_t i = 0; i < spec.types.size(); ++i)
    form += (i == 0 ? "" : ", ") + std::string(spec.types[i] == 't' ? "text$" : "number");
  return form + ")";
}

bool hasKind(const Match& match, Misfit::Kind kind) {
  return std::any_of(match.misfits.begin(), match.misfits.end(),
                     [&](const Misfit& misfit) { return misfit.kind == kind; });
}

// A kind of value is wrong, not a word or the number of arguments.
bool isKind(const Misfit& misfit) {
  return misfit.kind != Misfit::Kind::Count && misfit.kind != Misfit::Kind::Choice &&
         misfit.kind != Misfit::Kind::Parameter;
}

// Words that the signatures take as this argument.
std::vector<std::string> choicesOf(const CheckedFile::Call& call, std::size_t argument) {
  std::vector<std::string> known;
  for (const CommandSignature* signature : call.signatures) {
    if (argument >= signature->arguments.size()) continue;
    for (const std::string& word : signature->arguments[argument].keywords)
      if (std::find(known.begin(), known.end(), word) == known.end()) known.push_back(word);
  }
  return known;
}

std::string listed(const std::vector<std::string>& words) {
  std::string list;
  for (const std::string& word : words)
    list += (list.empty() ? "" : ", ") + word;
  return list;
}

// The arguments that are one of a list of words and are not in it, by the kind of the list.
template <class Visit> void eachUnlisted(const CheckedFile& input, Misfit::Kind kind, const Visit& visit) {
  for (const CheckedFile::Call& call : input.calls) {
    if (!call.judged()) continue;
    for (const Misfit& misfit : call.match.misfits)
      if (misfit.kind == kind) visit(call, misfit.argument, *(*call.arguments)[misfit.argument]);
  }
}

} // namespace

// ---- names

void unknownCommand(const CheckedFile& input, Report& report) {
  eachCommand(input, [&](const Command& command, const std::string& key) {
    const stdlib::GibbsKeywords& keywords = input.keywords;
    if (keywords.isCore(key) || keywords.renamedTo(key) || !keywords.commands(key).empty()) return;
    if (keywords.isCommand(key) || keywords.hasCommandPrefix(key) || report.full(input.file)) return;
    std::string remedy, meant;
    if (const std::string foreign = explainForeignWord(key); !foreign.empty())
      remedy = "; " + foreign;
    else if (input.variables.contains(key))
      remedy = "; it is a variable of this macro: is `=` missing?";
    else if (keywords.function(key) != nullptr)
      remedy = "; it is a function, which is inside an expression";
    else if (!keywords.dialogControls(key).empty())
      remedy = "; it is a control, which is in a dialog file (.dlg)";
    else
      remedy = didYouMean(meant = keywords.nearestCommand(key));
    report.at(command.name.range, "no source knows a command `{}`{}", command.name.text, remedy).fix =
        writeInstead(command.name.range, meant);
  });
}

void renamedCommand(const CheckedFile& input, Report& report) {
  eachCommand(input, [&](const Command& command, const std::string& key) {
    if (input.keywords.isCore(key)) return;
    if (const auto renamed = input.keywords.renamedTo(key))
      report.at(command.name.range, "`{}` is an old or misprinted spelling; write `{}`", command.name.text,
                *renamed);
  });
}

bool belongs(const Command& element, const GeometryBlock& block) {
  const std::string key = foldCase(element.name.text);
  if (foldCase(block.kind.text) == "POINTS") return key == "POINT";
  return key == "START" || key == "RAPID" || key == "LINE" || key == "ARC";
}

void misplacedWord(const CheckedFile& input, Report& report) {
  eachCommand(input, [&](const Command& command, const std::string& key) {
    if (input.keywords.isCore(key))
      report.at(command.name.range, "`{}` is only between the `[` and `]` of CONTOUR, CONTOUR_3D or POINTS",
                command.name.text);
  });
  for (const Statement* statement : input.statements) {
    const auto* block = std::get_if<std::unique_ptr<GeometryBlock>>(&statement->node);
    if (block == nullptr) continue;
    const std::string kind = foldCase((*block)->kind.text);
    for (const Command& element : (*block)->elements)
      if (!belongs(element, **block))
        report.at(element.name.range, "`{}` is in a block of {}, which holds {}", element.name.text, kind,
                  kind == "POINTS" ? "POINT only" : "START, RAPID, LINE and ARC only");
  }
}

bool CheckedFile::isUnknownFunction(const Expression& expression) const {
  if (const auto* call = std::get_if<FunctionCall>(&expression.node))
    return keywords.function(call->name.text) == nullptr;
  const auto* element = std::get_if<VariableRef>(&expression.node);
  return element != nullptr && element->index != nullptr && element->bracket == '(' &&
         !arrays.contains(foldCase(element->name.text));
}

void unknownFunction(const CheckedFile& input, Report& report) {
  for (const Expression* expression : input.expressions) {
    if (!input.isUnknownFunction(*expression) || report.full(input.file)) continue;
    const auto* call = std::get_if<FunctionCall>(&expression->node);
    const Name& name = call != nullptr ? call->name : std::get<VariableRef>(expression->node).name;
    const std::string nearest = input.keywords.nearestFunction(name.text);
    report
        .at(name.range, "no source knows a function `{}`{}", name.text,
            nearest.empty() && call == nullptr ? "; an array of this name is not declared here either"
                                               : didYouMean(nearest))
        .fix = writeInstead(name.range, nearest);
  }
}

// ---- arguments

void argumentCount(const CheckedFile& input, Report& report) {
  const auto tell = [&](SourceRange range, const std::string& name, std::size_t given,
                        const std::string& takes, const std::string& form) {
    report.at(range,
              "`{}` has {} {} here and takes {}; GibbsCAM stops at the line or ignores what is too much; the "
              "form is `{}`",
              name, given, given == 1 ? "argument" : "arguments", takes, form);
  };
  for (const CheckedFile::Call& call : input.calls) {
    if (!call.judged() || !hasKind(call.match, Misfit::Kind::Count)) continue;
    // A word that is no keyword, or one argument too many: one of them is the cause.
    if (call.match.misfits.size() > 1 && hasKind(call.match, Misfit::Kind::Choice)) continue;
    const ArgumentCount count = countOf(*call.match.signature);
    std::string takes = std::to_string(count.least);
    if (count.most == stdlib::kNoBound)
      takes = "at least " + takes;
    else if (count.most != count.least)
      takes += " to " + std::to_string(count.most);
    const auto& arguments = *call.arguments;
    tell(arguments.size() > count.most ? spanning(arguments[count.most]->range, arguments.back()->range)
                                       : call.range,
         call.name->text, arguments.size(), takes, signatureText(*call.match.signature));
  }
  eachFunction(input, [&](const FunctionCall& call, const stdlib::FunctionSpec& spec, SourceRange range) {
    if (call.arguments.size() != spec.types.size())
      tell(range, spec.name, call.arguments.size(), std::to_string(spec.types.size()), formOf(spec));
  });
}

void argumentKind(const CheckedFile& input, Report& report) {
  const auto tell = [&](SourceRange range, std::string_view fact, const std::string& form) {
    report.at(range, "`{}` {}; the form is `{}`", input.text(range), fact, form);
  };
  for (const CheckedFile::Call& call : input.calls) {
    if (!call.judged()) continue;
    const auto& misfits = call.match.misfits;
    // Swapped arguments are one slip.
    const auto first = std::find_if(misfits.begin(), misfits.end(), isKind);
    if (first == misfits.end()) continue;
    std::string_view fact = "is a text, but a number comes there";
    if (first->kind == Misfit::Kind::Variable) fact = "is no variable, but GibbsCAM writes a result there";
    if (first->kind == Misfit::Kind::Array) fact = "is no name, but an array comes there";
    if (first->kind == Misfit::Kind::Text) fact = "is a number, but a text comes there";
    tell((*call.arguments)[first->argument]->range, fact, signatureText(*call.match.signature));
  }
  eachFunction(input, [&](const FunctionCall& call, const stdlib::FunctionSpec& spec, SourceRange) {
    if (call.arguments.size() != spec.types.size()) return;
    for (std::size_t i = 0; i < call.arguments.size(); ++i) {
      const bool text = typeOf(*call.arguments[i], input.keywords) == ValueType::Text;
      if (text != (spec.types[i] == 't'))
        tell(call.arguments[i]->range,
             text ? "is a text, but a number comes there" : "is a number, but a text comes there",
             formOf(spec));
    }
  });
}

void unknownParameter(const CheckedFile& input, Report& report) {
  const auto tell = [&](const CheckedFile::Call& call, SourceRange range,
                        const std::string& tail) -> Diagnostic& {
    return report.at(range, "`{}` has no parameter `{}`; GibbsCAM stops at the line{}", call.name->text,
                     input.text(range), tail);
  };
  eachUnlisted(input, Misfit::Kind::Choice,
               [&](const CheckedFile::Call& call, std::size_t argument, const Expression& given) {
                 if (call.match.signature->openKeywords) return;
                 const std::vector<std::string> known = choicesOf(call, argument);
                 const std::string word = keywordText(given, input.sources);
                 NearestName nearest(word);
                 for (const std::string& each : known)
                   nearest.offer(each);
                 tell(call, given.range,
                      nearest.result().empty() ? "; here is one of " + listed(known)
                                               : didYouMean(nearest.result()))
                     .fix = writeInstead(given.range, nearest.result());
               });
  eachUnlisted(input, Misfit::Kind::Parameter,
               [&](const CheckedFile::Call& call, std::size_t argument, const Expression& given) {
                 const std::string& family = call.match.specs[argument]->family;
                 if (!input.keywords.hasFamily(family) || input.keywords.isOpenFamily(family)) return;
                 if (report.full(input.file)) return;
                 const std::string meant =
                     input.keywords.nearestParameter(family, keywordText(given, input.sources));
                 tell(call, given.range, didYouMean(meant)).fix = writeInstead(given.range, meant);
               });
}

void unverifiedName(const CheckedFile& input, Report& report) {
  const auto tell = [&](const CheckedFile::Call& call, SourceRange range, const std::string& known) {
    report.at(range,
              "`{}` is not among the names that sources show for `{}` ({}), but its list is known to be "
              "incomplete; "
              "whether GibbsCAM takes it is unverified",
              input.text(range), call.name->text, known);
  };
  eachUnlisted(input, Misfit::Kind::Choice,
               [&](const CheckedFile::Call& call, std::size_t argument, const Expression& given) {
                 if (call.match.signature->openKeywords)
                   tell(call, given.range, listed(choicesOf(call, argument)));
               });
  eachUnlisted(input, Misfit::Kind::Parameter,
               [&](const CheckedFile::Call& call, std::size_t argument, const Expression& given) {
                 const std::string& family = call.match.specs[argument]->family;
                 if (!input.keywords.hasFamily(family) || !input.keywords.isOpenFamily(family)) return;
                 if (report.full(input.file)) return;
                 const std::string nearest =
                     input.keywords.nearestParameter(family, keywordText(given, input.sources));
                 tell(call, given.range, nearest.empty() ? "none of them is near" : "nearest: " + nearest);
               });
}

void fileUnit(const CheckedFile& input, Report& report) {
  for (const CheckedFile::Call& call : input.calls) {
    if (call.match.signature == nullptr || !call.match.signature->name.starts_with("FILE_")) continue;
    for (std::size_t i = 0; i < call.arguments->size(); ++i) {
      const Expression& argument = *(*call.arguments)[i];
      const auto* number = std::get_if<NumberLiteral>(&argument.node);
      if (number == nullptr || call.match.specs[i] == nullptr || call.match.specs[i]->name != "unit")
        continue;
      if (number->value < 1 || number->value > 10)
        report.at(argument.range, "the unit `{}` is outside 1 to 10; GibbsCAM opens no file there",
                  number->text);
    }
  }
}

void tooManyNames(const CheckedFile& input, Report& report) {
  for (const Statement* statement : input.statements) {
    const auto most = [&](const char* word, std::size_t bound, const char* what, std::size_t given) {
      if (given > bound)
        report.at(statement->range, "{} takes at most {} {}; here are {}", word, bound, what, given);
    };
    if (const auto* call = std::get_if<CallMacro>(&statement->node))
      most("CALL", 10, "values", call->arguments.size());
    if (const auto* args = std::get_if<Args>(&statement->node)) most("ARGS", 50, "names", args->names.size());
    if (const auto* declared = std::get_if<Declaration>(&statement->node)) {
      static constexpr const char* kWords[] = {"GLOBAL", "LOCAL", "PERMANENT"};
      most(kWords[static_cast<std::size_t>(declared->scope)], 50, "names", declared->names.size());
    }
  }
}

} // namespace dotek::frontend::gibbs
