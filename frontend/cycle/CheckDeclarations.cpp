#include "frontend/cycle/Checker.h"
#include "frontend/cycle/Words.h"
#include "support/Ascii.h"
#include "support/messages/Cycle.h"

#include <algorithm>

namespace dotek::frontend::cycle {
namespace {

bool isDeclaration(const Statement& statement) {
  return std::holds_alternative<Header>(statement.node) || std::holds_alternative<Use>(statement.node) ||
         std::holds_alternative<Needs>(statement.node) || std::holds_alternative<Parameter>(statement.node) ||
         std::holds_alternative<Result>(statement.node) || std::holds_alternative<Require>(statement.node) ||
         std::holds_alternative<ErrorStatement>(statement.node);
}

// `probing/bore-3.cycle` gives `bore-3`; "" where the name is none of a cycle's file.
std::string stemOf(const std::string& path) {
  const std::size_t slash = path.find_last_of("/\\");
  const std::string name = slash == std::string::npos ? path : path.substr(slash + 1);
  constexpr std::string_view kEnd = ".cycle";
  return name.size() > kEnd.size() && name.ends_with(kEnd) ? name.substr(0, name.size() - kEnd.size())
                                                           : std::string();
}

} // namespace

bool Checker::declareName(const Name& name, Symbol symbol) {
  symbol.range = used_.hasPlace() ? used_ : name.range;
  const auto [at, isNew] = symbols_.try_emplace(name.text, symbol);
  if (isNew) return true;
  if (!at->second.range.hasPlace() && at->second.role != Symbol::Role::Host) {
    // It was only read so far, and reported there.
    symbol.read = true;
    at->second = symbol;
    return true;
  }
  if (at->second.role == Symbol::Role::Host)
    diagnostics_.report<diag::HostName>(symbol.range, name.text, proposeName("my_" + name.text));
  else
    diagnostics_.report<diag::NameDeclaredTwice>(symbol.range, name.text)
        .note(at->second.range, "the first is here");
  return false;
}

void Checker::header() {
  const std::vector<Statement>& all = file_.body.statements;
  const Header* first = nullptr;
  const auto begin = std::find_if(all.begin(), all.end(), [](const Statement& one) {
    return !std::holds_alternative<ErrorStatement>(one.node); // what that was is reported
  });
  for (const Statement& statement : all) {
    const auto* header = std::get_if<Header>(&statement.node);
    if (header == nullptr) continue;
    if (first != nullptr) {
      diagnostics_.report<diag::HeaderTwice>(statement.range);
      continue;
    }
    first = header;
    options_ = header->options;
    if (&statement != &*begin) diagnostics_.report<diag::HeaderFirst>(statement.range);
    std::string stem = stemOf(sources_.file(file_.file).name());
    std::string wanted = header->name.text;
    std::replace(wanted.begin(), wanted.end(), '_', '-');
    const bool named = !file_.hasErrorNodes || sources_.text(header->name.range) == header->name.text;
    if (named && !stem.empty() && stem != wanted)
      diagnostics_.report<diag::CycleFileName>(header->name.range, header->name.text, wanted);
  }
  if (first == nullptr) {
    const SourceRange where = all.empty() ? SourceRange{file_.file, 0, 0} : all.front().range;
    diagnostics_.report<diag::HeaderMissing>(where);
  }
}

void Checker::clauses(const Parameter& parameter) {
  for (const Clause& clause : parameter.clauses) {
    if (clause.kind != Clause::Kind::Letter || !clause.letter) continue;
    const auto [at, isNew] = letters_.emplace(clause.letter->text, parameter.names.front());
    if (!isNew)
      diagnostics_
          .report<diag::LetterWish>(clause.letter->range, clause.letter->text,
                                    "is wished for twice, and a call hands over one value; write another "
                                    "capital, or leave out the clause")
          .note(at->second.range, "`" + at->second.text + "` has it");
  }
  // They are checked only where the caller gives the parameter.
  Known known;
  for (const Name& name : parameter.names)
    known.given.insert(name.text);
  inClause_ = true;
  for (const Clause& clause : parameter.clauses) {
    if (clause.kind == Clause::Kind::Require) wantFlag(*clause.first, "`require`", known);
    if (clause.kind == Clause::Kind::Range) {
      const Quantity quantity = quantityOf(parameter.type);
      want(*clause.first, quantity, "the least value", known);
      want(*clause.second, quantity, "the largest value", known);
    }
  }
  inClause_ = false;
}

void Checker::parameter(const Parameter& parameter) {
  if (parameter.value != nullptr) {
    if (parameter.optional)
      diagnostics_.report<diag::OptionalWithDefault>(parameter.value->range, parameter.names.front().text);
    want(*parameter.value, quantityOf(parameter.type), "the default", Known());
  }
  declareNames(parameter);
  clauses(parameter);
  constants(parameter);
}

void Checker::declareNames(const Parameter& parameter) {
  for (const Name& name : parameter.names) {
    Symbol symbol;
    symbol.role = Symbol::Role::Parameter;
    symbol.quantity = quantityOf(parameter.type);
    symbol.parameter = &parameter;
    declareName(name, symbol);
  }
}

void Checker::result(const Result& result) {
  for (const Name& name : result.names) {
    Symbol symbol;
    symbol.role = Symbol::Role::Result;
    symbol.quantity = quantityOf(result.type);
    symbol.read = true;
    declareName(name, symbol);
  }
}

// Values and conditions of options are checked in their own file.
void Checker::use(const Use& use) {
  const Header* header = use.options == nullptr ? nullptr : use.options->header();
  if (header == nullptr) {
    diagnostics_.report<diag::UnknownOptions>(use.name.range, use.name.text);
    return;
  }
  if (!header->options) {
    diagnostics_.report<diag::UseOfCycle>(use.name.range, use.name.text);
    return;
  }
  used_ = use.name.range;
  for (const Statement& statement : use.options->body.statements) {
    if (const auto* one = std::get_if<Parameter>(&statement.node)) declareNames(*one);
    if (const auto* one = std::get_if<Result>(&statement.node)) result(*one);
  }
  used_ = {};
}

void Checker::declare(const Statement& statement) {
  if (const auto* one = std::get_if<Parameter>(&statement.node)) parameter(*one);
  if (std::holds_alternative<Needs>(statement.node)) needsProbe_ = true;
  if (const auto* require = std::get_if<Require>(&statement.node))
    wantFlag(*require->condition, "`require`", Known());
  if (const auto* one = std::get_if<Result>(&statement.node)) result(*one);
  if (const auto* one = std::get_if<Use>(&statement.node)) use(*one);
}

void Checker::unread() {
  if (file_.hasErrorNodes) return; // a line that was not read may read it
  for (const auto& [name, symbol] : symbols_)
    if (symbol.role == Symbol::Role::Parameter && !symbol.read)
      diagnostics_.report<diag::ParameterUnread>(symbol.range, name);
    else if (symbol.role == Symbol::Role::Local && !symbol.read && symbol.range.hasPlace())
      diagnostics_.report<diag::NameUnread>(symbol.range, name);
}

Checker::Checker(const File& file, const SourceMap& sources, Diagnostics& diagnostics)
    : file_(file), sources_(sources), diagnostics_(diagnostics) {
  addHosts(symbols_);
}

std::vector<std::string> Checker::wordsOf(std::string_view line) {
  std::vector<std::string> out;
  std::string word;
  for (const char c : line) {
    if (isLetter(c) || isDigit(c) || c == '_') {
      word += c;
    } else if (!word.empty()) {
      out.push_back(std::move(word));
      word.clear();
    }
  }
  if (!word.empty()) out.push_back(std::move(word));
  return out;
}

void Checker::collect(const Block& block) {
  for (const Statement& statement : block.statements) {
    if (std::holds_alternative<ErrorStatement>(statement.node))
      for (std::string& word : wordsOf(sources_.text(statement.range)))
        unreadable_.insert(std::move(word));
    if (const auto* touch = std::get_if<Touch>(&statement.node)) {
      if (!touch->name) unnamed_.push_back(statement.range);
      if (touch->name) later_.emplace(touch->name->text, Symbol::Role::Touch);
      if (touch->name && touch->otherwise != nullptr) mayMiss_.insert(touch->name->text);
      if (touch->otherwise != nullptr) collect(*touch->otherwise);
    }
    if (const auto* call = std::get_if<Call>(&statement.node); call != nullptr && call->result)
      later_.emplace(call->result->text, Symbol::Role::Call);
    if (const auto* assign = std::get_if<Assign>(&statement.node))
      later_.emplace(assign->name.text, Symbol::Role::Local);
    if (const auto* choice = std::get_if<If>(&statement.node)) {
      for (const If::Part& part : choice->parts)
        collect(part.body);
      if (choice->otherwise != nullptr) collect(*choice->otherwise);
    }
    if (const auto* repeat = std::get_if<Repeat>(&statement.node)) collect(repeat->body);
    if (const auto* loop = std::get_if<For>(&statement.node)) collect(loop->body);
    if (const auto* loop = std::get_if<While>(&statement.node)) collect(loop->body);
  }
}

void Checker::collectDeclarations() {
  const auto add = [&](const Statement& statement, SourceRange from) {
    const auto take = [&](const auto& declaration) {
      for (const Name& name : declaration.names)
        below_.emplace(name.text, from.hasPlace() ? from : name.range);
    };
    if (const auto* one = std::get_if<Parameter>(&statement.node)) take(*one);
    if (const auto* one = std::get_if<Result>(&statement.node)) take(*one);
  };
  for (const Statement& statement : file_.body.statements) {
    add(statement, {});
    const auto* use = std::get_if<Use>(&statement.node);
    if (use == nullptr || use->options == nullptr) continue;
    for (const Statement& one : use->options->body.statements)
      add(one, use->name.range);
  }
}

void Checker::run() {
  header();
  collectDeclarations();
  collect(file_.body);
  bool running = false;
  for (const Statement& statement : file_.body.statements) {
    const bool declares = isDeclaration(statement);
    if (declares && running && !std::holds_alternative<Header>(statement.node) &&
        !std::holds_alternative<ErrorStatement>(statement.node))
      diagnostics_.report<diag::LateDeclaration>(statement.range);
    const bool own = options_ && (!declares || std::holds_alternative<Use>(statement.node) ||
                                  std::holds_alternative<Needs>(statement.node));
    if (own) diagnostics_.report<diag::OptionsOnlyDeclare>(statement.range);
    running = running || !declares;
    if (declares && !own) declare(statement);
  }
  if (!file_.hasErrorNodes) defaults();
  if (options_) return; // whoever uses them reads the parameters and gives the results their values
  Known known;
  known.probe = needsProbe_ ? ProbeState::On : ProbeState::Off;
  block(file_.body, known);
  const auto end = static_cast<std::uint32_t>(sources_.file(file_.file).bytes().size());
  finish(known, file_.body.statements.empty() ? SourceRange{file_.file, end, end}
                                              : file_.body.statements.back().range);
  if (!file_.hasErrorNodes) checkMotion(file_, diagnostics_);
  unread();
}

void check(const File& file, const SourceMap& sources, Diagnostics& diagnostics) {
  Checker(file, sources, diagnostics).run();
}

} // namespace dotek::frontend::cycle
