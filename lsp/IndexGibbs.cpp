// GibbsCAM macros, dialogs and DefineData.txt: variables, labels, macros that are called. Names of one folder
// are one scope, compared without case.
#include "frontend/gibbs/Parse.h"
#include "frontend/gibbs/Walk.h"
#include "lsp/Index.h"
#include "project/Session.h"

#include <fmt/format.h>

namespace dotek::lsp {

namespace gibbs = frontend::gibbs;
using Role = Occurrence::Role;

namespace {

class Indexer {
public:
  Indexer(Index& index, const stdlib::GibbsKeywords& keywords) : index_(index), keywords_(keywords) {}

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
      const std::string title = control.text ? index_.utf8(*control.text) : "";
      if (control.variable) {
        add(*control.variable, Role::Write);
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
    else if (const auto* command = std::get_if<gibbs::Command>(&statement.node))
      signatures(*command);
    gibbs::ownExpressions(statement, [&](const gibbs::Expression& one) { expression(one, {}); });
  }

  void signatures(const gibbs::Command& command) {
    std::string text;
    for (const stdlib::CommandSignature* one : keywords_.commands(command.name.text)) {
      text += "`" + one->name;
      for (const stdlib::ArgumentSpec& argument : one->arguments) {
        text += text.ends_with(one->name) ? " " : ", ";
        std::string name = argument.name;
        if (name.empty()) name = argument.family;
        for (const std::string& keyword : argument.keywords)
          name += (name.empty() ? "" : "|") + keyword;
        text += argument.optional ? "[" + name + "]" : name;
      }
      text += "`\n\n";
    }
    for (const std::string_view note : keywords_.commandNotes(command.name.text))
      text += std::string(note) + "\n\n";
    if (!text.empty()) index_.facts.push_back({command.name.range, std::move(text)});
  }

  // `but`: a name that is counted already.
  void expression(const gibbs::Expression& expression, SourceRange but) {
    gibbs::walkExpression(expression, [&](const gibbs::Expression& one) {
      if (const auto* reference = std::get_if<gibbs::VariableRef>(&one.node))
        if (!(reference->name.range == but)) add(reference->name, Role::Read);
    });
  }

  void add(const gibbs::Name& name, Role role) {
    if (const stdlib::CallbackVariable* known = keywords_.callback(name.text))
      index_.facts.push_back({name.range, fmt::format("**{}** set by the CAM{}{}", known->name,
                                                      known->note.empty() ? "" : ": ", known->note)});
    index_.occurrences.push_back({"field " + index_.utf8(gibbs::foldCase(name.text)), role, name.range});
  }
  void label(const gibbs::Name& name, Role role) {
    const std::string key = "label " + index_.utf8(gibbs::foldCase(name.text));
    if (role == Role::Definition) index_.renamable.push_back(key);
    index_.occurrences.push_back({key, role, name.range});
  }

  Index& index_;
  const stdlib::GibbsKeywords& keywords_;
};

} // namespace

void indexGibbs(Index& index, project::Session& session) {
  Diagnostics unheard;
  const gibbs::ParseContext context{session.sources(), session.gibbsKeywords(), session.limits(), unheard};
  Indexer indexer(index, session.gibbsKeywords());
  switch (*index.kind) {
  case project::InputKind::Dialog: indexer.dialog(gibbs::parseDialog(index.file, context)); break;
  case project::InputKind::DefineData:
    indexer.definitions(gibbs::parseDefineData(index.file, context));
    break;
  default: indexer.macro(gibbs::parseMacro(index.file, context)); break;
  }
}

} // namespace dotek::lsp
