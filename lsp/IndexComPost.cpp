// Progs of ComPost: routines, fields of the operation, names of cycles, flags.
#include "frontend/compost/Parse.h"
#include "lsp/Index.h"
#include "project/Session.h"
#include "support/Ascii.h"

#include <fmt/format.h>
#include <set>

namespace dotek::lsp {

namespace compost = frontend::compost;
using Role = Occurrence::Role;

namespace {

class Indexer {
public:
  Indexer(Index& index, const stdlib::ComPostKeywords& keywords) : index_(index), keywords_(keywords) {}

  void program(const compost::Program& program) {
    for (const compost::Item& item : program.items)
      if (const auto* routine = std::get_if<compost::Routine>(&item)) routines_.insert(routine->name);
    for (const compost::Item& item : program.items) {
      if (const auto* routine = std::get_if<compost::Routine>(&item)) {
        const std::string key = "routine " + routine->name;
        index_.occurrences.push_back({key, Role::Definition, routine->nameRange});
        // The engine calls its entry points by name.
        if (!keywords_.isEntryPoint(routine->name)) index_.renamable.push_back(key);
        Symbol symbol{routine->name, "routine", SymbolKind::Function, routine->range, routine->nameRange, {}};
        symbol_ = &symbol;
        body(routine->body);
        index_.symbols.push_back(std::move(symbol));
      } else if (const auto* picture = std::get_if<compost::PictureDefinition>(&item)) {
        index_.occurrences.push_back(
            {fmt::format("picture {}", picture->number), Role::Definition, picture->numberRange});
      } else if (const auto* format = std::get_if<compost::FormatDirective>(&item)) {
        index_.occurrences.push_back(
            {fmt::format("picture {}", format->number), Role::Read, format->numberRange});
      }
    }
  }

private:
  void body(const std::vector<compost::Statement>& statements) {
    for (const compost::Statement& statement : statements) {
      if (const auto* word = std::get_if<compost::Word>(&statement)) {
        this->word(*word);
      } else if (const auto* branch = std::get_if<std::unique_ptr<compost::If>>(&statement)) {
        condition((*branch)->condition);
        const std::string outer = cycle_;
        if (const std::string asked = cycleAsked((*branch)->condition); !asked.empty()) cycle_ = asked;
        body((*branch)->thenBody);
        cycle_ = outer;
        body((*branch)->elseBody);
      }
    }
  }

  // The cycle of which alone the condition holds; "": of several, or none.
  std::string cycleAsked(const compost::Condition& condition) const {
    for (const compost::Connective connective : condition.connectives)
      if (connective != compost::Connective::And) return "";
    for (const compost::ConditionTerm& term : condition.terms)
      if (const auto* word = std::get_if<compost::Word>(&term.operand))
        if (term.nots.empty() && word->name == "CycleType" && word->arguments.size() == 1)
          return index_.utf8(word->arguments.front().text);
    return "";
  }

  void condition(const compost::Condition& condition) {
    for (const compost::ConditionTerm& term : condition.terms) {
      if (const auto* word = std::get_if<compost::Word>(&term.operand))
        this->word(*word);
      else if (const auto* inner = std::get_if<std::unique_ptr<compost::Condition>>(&term.operand))
        this->condition(**inner);
    }
  }

  void word(const compost::Word& word) {
    if (routines_.contains(word.name) && word.kind == compost::WordKind::Command)
      index_.occurrences.push_back({"routine " + word.name, Role::Read, word.nameRange});
    else if (const stdlib::ComPostKeyword* known = keywords_.find(word.name))
      index_.facts.push_back(
          {word.nameRange, fmt::format("**{}** {}\n\n*{}*: {}", known->name, known->summary,
                                       known->grade == 'D'   ? "documented"
                                       : known->grade == 'O' ? "observed"
                                       : known->grade == 'I' ? "inferred"
                                                             : "unknown",
                                       known->source)});
    for (const compost::Literal& argument : word.arguments) {
      // Between the apostrophes.
      const SourceRange inside{argument.range.file, argument.range.begin + 1,
                               argument.range.end > argument.range.begin + 1 ? argument.range.end - 1
                                                                             : argument.range.end};
      const std::string text = index_.utf8(argument.text);
      const std::string kind = word.name == "OpFieldData" ? "field"
                               : word.name == "CycleType" ? "cycle"
                                                          : "flag " + word.name;
      index_.occurrences.push_back({kind + " " + (kind == "field" ? upperCase(text) : text), Role::Read,
                                    inside, kind == "field" ? cycle_ : ""});
      if (kind == "cycle" && symbol_ != nullptr)
        symbol_->children.push_back({text, "cycle", SymbolKind::Key, word.range, inside, {}});
    }
  }

  Index& index_;
  const stdlib::ComPostKeywords& keywords_;
  std::set<std::string> routines_;
  Symbol* symbol_ = nullptr;
  std::string cycle_; // that is posted here; "": any
};

} // namespace

void indexComPost(Index& index, project::Session& session) {
  Diagnostics unheard;
  const compost::Program program = compost::parse(index.file, session.sources(), session.limits(), unheard);
  Indexer(index, session.compostKeywords()).program(program);
}

} // namespace dotek::lsp
