// GibbsCAM macros, dialogs and DefineData.txt: variables, labels, macros that are called. Names of one folder
// are one scope, compared without case.
#include "frontend/gibbs/Match.h"
#include "frontend/gibbs/Parse.h"
#include "frontend/gibbs/Walk.h"
#include "lsp/Index.h"
#include "project/Session.h"
#include "stdlib/KeywordLists.h"
#include "support/Ascii.h"

#include <filesystem>

#include <fmt/format.h>

namespace dotek::lsp {

namespace gibbs = frontend::gibbs;
using Role = Occurrence::Role;

namespace {

class Indexer {
public:
  Indexer(Index& index, const stdlib::GibbsKeywords& keywords, const SourceMap& sources,
          const std::string& path)
      : index_(index), keywords_(keywords), sources_(sources),
        folder_(std::filesystem::path(path).parent_path().generic_string()) {}

  void macro(const gibbs::Macro& macro) {
    for (const gibbs::Line& line : macro.lines) {
      if (line.label) {
        const gibbs::Name& name = line.label->name;
        label(name, Role::Definition);
        index_.symbols.push_back({index_.utf8(name.text), "", SymbolKind::Key, name.range, name.range, {}});
      }
    }
    gibbs::walkLines(macro.lines, [&](const gibbs::Statement& statement) { this->statement(statement); });
  }

  void dialog(const gibbs::Dialog& dialog) {
    for (const gibbs::Control& control : dialog.controls) {
      for (const stdlib::CommandSignature* one : keywords_.dialogControls(control.kind.text))
        index_.facts.push_back({control.kind.range, "`" + stdlib::textOf(*one) + "`"});
      const std::string title = control.text ? index_.utf8(*control.text) : "";
      if (control.variable) {
        add(*control.variable, Role::Write);
        index_.facts.push_back(
            {control.variable->range,
             fmt::format("**{}** {} of the dialog{}", index_.utf8(control.variable->text),
                         lowerCase(index_.utf8(control.kind.text)), captionsOf(dialog, control))});
        index_.symbols.push_back({index_.utf8(control.variable->text),
                                  index_.utf8(control.kind.text),
                                  SymbolKind::Field,
                                  control.range,
                                  control.variable->range,
                                  {}});
      } else if (!title.empty()) {
        index_.symbols.push_back({title,
                                  index_.utf8(control.kind.text),
                                  SymbolKind::Variable,
                                  control.range,
                                  control.kind.range,
                                  {}});
      }
      for (const gibbs::ExpressionPtr& argument : control.arguments)
        if (argument != nullptr)
          expression(*argument, control.variable ? control.variable->range : SourceRange{});
    }
  }

  void definitions(const gibbs::DefineData& data) {
    for (const gibbs::Definition& one : data.definitions) {
      add(one.name, Role::Definition);
      index_.facts.push_back(
          {one.name.range, fmt::format("**{}** field of the cycle{}{}", index_.utf8(one.name.text),
                                       one.number ? fmt::format(", {} at first", *one.number) : "",
                                       keywords_.isReservedField(one.name.text)
                                           ? "; the name switches a field of the standard drill dialog"
                                           : "")});
      index_.symbols.push_back({index_.utf8(one.name.text),
                                one.number ? fmt::format("= {}", *one.number) : "",
                                SymbolKind::Field,
                                one.range,
                                one.name.range,
                                {}});
      if (one.value != nullptr) expression(*one.value, {});
    }
  }

private:
  // Texts of the labels in the row of a control: ": \"X [mm]\", \"Travel to the face\"".
  std::string captionsOf(const gibbs::Dialog& dialog, const gibbs::Control& control) const {
    std::string out;
    if (!control.box) return out;
    for (const gibbs::Control& label : dialog.controls) {
      if (&label == &control || !label.text || !label.box || label.variable) continue;
      const int middle = control.box->top + control.box->height / 2;
      if (gibbs::foldCase(label.kind.text) != "LABEL" || label.box->top > middle ||
          label.box->top + label.box->height < middle)
        continue;
      out += (out.empty() ? ": \"" : ", \"") + index_.utf8(*label.text) + "\"";
    }
    return out;
  }

  // The file of the folder that a CALL or a DIALOG names.
  void file(const std::string& name, SourceRange range, const char* suffix) {
    std::error_code error;
    const std::string wanted = gibbs::foldCase(name);
    for (const auto& entry : std::filesystem::directory_iterator(folder_, error)) {
      const std::string found = gibbs::foldCase(entry.path().filename().string());
      if (found != wanted && found != wanted + suffix) continue;
      const std::string key = "file " + index_.utf8(wanted);
      index_.occurrences.push_back({key, Role::Read, range, ""});
      index_.files[key] = entry.path().generic_string();
      return;
    }
  }

  void statement(const gibbs::Statement& statement) {
    if (const auto* assign = std::get_if<gibbs::Assignment>(&statement.node))
      add(assign->target.name, Role::Write);
    else if (const auto* loop = std::get_if<gibbs::For>(&statement.node))
      add(loop->variable, Role::Write);
    else if (const auto* next = std::get_if<gibbs::Next>(&statement.node)) {
      if (next->variable) add(*next->variable, Role::Read);
    } else if (const auto* jump = std::get_if<gibbs::Goto>(&statement.node))
      label(jump->label, Role::Read);
    else if (const auto* error = std::get_if<gibbs::OnError>(&statement.node))
      label(error->label, Role::Read);
    else if (const auto* args = std::get_if<gibbs::Args>(&statement.node))
      for (const gibbs::VariableRef& name : args->names)
        add(name.name, Role::Write);
    else if (const auto* declared = std::get_if<gibbs::Declaration>(&statement.node))
      for (const gibbs::VariableRef& name : declared->names)
        add(name.name, Role::Definition);
    else if (const auto* command = std::get_if<gibbs::Command>(&statement.node)) {
      this->command(*command);
      if (gibbs::foldCase(command->name.text) == "DIALOG" && command->arguments.size() == 1)
        if (const auto* text = std::get_if<gibbs::TextLiteral>(&command->arguments.front()->node))
          file(text->text, command->arguments.front()->range, ".DLG");
    } else if (const auto* call = std::get_if<gibbs::CallMacro>(&statement.node)) {
      if (call->macro == nullptr)
        file(call->bareName, call->macroRange, ".MAC");
      else if (const auto* text = std::get_if<gibbs::TextLiteral>(&call->macro->node))
        file(text->text, call->macroRange, ".MAC");
    } else if (const auto* include = std::get_if<gibbs::Include>(&statement.node))
      file(include->file, include->fileRange, ".MAC");
    if (!std::holds_alternative<gibbs::Command>(statement.node))
      gibbs::ownExpressions(statement, [&](const gibbs::Expression& one) { expression(one, {}); });
  }

  // A command fills some variables; a word at the place of a parameter is none.
  void command(const gibbs::Command& command) {
    signatures(command);
    using Kind = stdlib::ArgumentSpec::Kind;
    const gibbs::Match match =
        gibbs::matchArguments(keywords_.commands(command.name.text), command.arguments, keywords_, sources_);
    for (std::size_t i = 0; i < command.arguments.size(); ++i) {
      if (command.arguments[i] == nullptr) continue;
      const gibbs::Expression& argument = *command.arguments[i];
      const stdlib::ArgumentSpec* const spec = i < match.specs.size() ? match.specs[i] : nullptr;
      const auto* const reference = std::get_if<gibbs::VariableRef>(&argument.node);
      if (spec != nullptr && reference != nullptr && !match.signature->unsure) {
        if (spec->kind == Kind::Choice) continue;
        if (spec->kind == Kind::Parameter) {
          parameter(*reference, spec->family);
          continue;
        }
        if (spec->kind == Kind::Result || spec->kind == Kind::ReadWrite) {
          add(reference->name, Role::Write);
          expression(argument, reference->name.range);
          continue;
        }
      }
      expression(argument, {});
    }
  }

  void parameter(const gibbs::VariableRef& word, const std::string& family) {
    const auto kind = keywords_.parameterKind(family, word.name.text);
    if (!kind) return;
    const auto host = keywords_.hostInput(family, word.name.text);
    index_.facts.push_back(
        {word.name.range, fmt::format("**{}** parameter of `{}`: {}{}", index_.utf8(word.name.text), family,
                                      stdlib::textOf(*kind),
                                      host ? fmt::format("; `--host {}=VALUE` stands for it", *host) : "")});
  }

  void signatures(const gibbs::Command& command) {
    std::string text;
    for (const stdlib::CommandSignature* one : keywords_.commands(command.name.text))
      text += "`" + stdlib::textOf(*one) + "`\n\n";
    for (const std::string_view note : keywords_.commandNotes(command.name.text))
      text += std::string(note) + "\n\n";
    if (!text.empty()) index_.facts.push_back({command.name.range, std::move(text)});
  }

  // `but`: a name that is counted already.
  void expression(const gibbs::Expression& expression, SourceRange but) {
    gibbs::walkExpression(expression, [&](const gibbs::Expression& one) {
      if (const auto* reference = std::get_if<gibbs::VariableRef>(&one.node))
        if (!(reference->name.range == but)) add(reference->name, Role::Read);
      if (const auto* function = std::get_if<gibbs::FunctionCall>(&one.node))
        if (const stdlib::FunctionSpec* known = keywords_.function(function->name.text))
          index_.facts.push_back(
              {function->name.range, fmt::format("**{}** function{}{}", known->name,
                                                 known->note.empty() ? "" : ": ", known->note)});
    });
  }

  void add(const gibbs::Name& name, Role role) {
    if (const stdlib::CallbackVariable* known = keywords_.callback(name.text))
      index_.facts.push_back({name.range, fmt::format("**{}** set by the CAM{}{}", known->name,
                                                      known->note.empty() ? "" : ": ", known->note)});
    else if (keywords_.isConstant(name.text))
      index_.facts.push_back(
          {name.range, fmt::format("**{}** constant of GibbsCAM", index_.utf8(name.text))});
    else if (keywords_.isSystemVariable(name.text))
      index_.facts.push_back(
          {name.range, fmt::format("**{}** set by GibbsCAM or by its commands", index_.utf8(name.text))});
    index_.occurrences.push_back({"field " + index_.utf8(gibbs::foldCase(name.text)), role, name.range});
  }
  void label(const gibbs::Name& name, Role role) {
    const std::string key = "label " + index_.utf8(gibbs::foldCase(name.text));
    if (role == Role::Definition) index_.renamable.push_back(key);
    index_.occurrences.push_back({key, role, name.range});
  }

  Index& index_;
  const stdlib::GibbsKeywords& keywords_;
  const SourceMap& sources_;
  std::string folder_;
};

} // namespace

void indexGibbs(Index& index, project::Session& session, const std::string& path) {
  Diagnostics unheard;
  const gibbs::ParseContext context{session.sources(), session.gibbsKeywords(), session.limits(), unheard};
  Indexer indexer(index, session.gibbsKeywords(), session.sources(), path);
  switch (*index.kind) {
  case project::InputKind::Dialog: indexer.dialog(gibbs::parseDialog(index.file, context)); break;
  case project::InputKind::DefineData:
    indexer.definitions(gibbs::parseDefineData(index.file, context));
    break;
  default: indexer.macro(gibbs::parseMacro(index.file, context)); break;
  }
}

} // namespace dotek::lsp
