// Files of the cycle language: parameters, results, variables, measurements, cycles that are called.
#include "frontend/cycle/Parse.h"
#include "frontend/cycle/Walk.h"
#include "lsp/Index.h"
#include "project/CycleFiles.h"
#include "project/Session.h"

#include <cstdint>
#include <filesystem>
#include <fmt/format.h>
#include <map>
#include <set>

namespace dotek::lsp {

namespace cycle = frontend::cycle;
using Role = Occurrence::Role;

namespace {

std::string typeOf(const cycle::Type& type) {
  std::string out(cycle::typeText(type.name));
  for (std::size_t i = 0; i < type.choices.size(); ++i)
    out += (i == 0 ? " " : ", ") + type.choices[i].text;
  return out;
}

// "diameter: length = 30.0 mm "bore diameter""
std::string parameterText(const cycle::Parameter& parameter, const std::string& name) {
  std::string out =
      fmt::format("**{}** {}{}", name, parameter.optional ? "optional " : "", typeOf(parameter.type));
  if (parameter.value != nullptr) out += " = " + cycle::layOut(*parameter.value);
  if (parameter.title) out += "\n\n" + parameter.title->text;
  return out;
}

class Indexer {
public:
  Indexer(Index& index, const SourceMap& sources) : index_(index), sources_(sources) {}

  void file(const cycle::File& file) {
    cycle::eachStatement(file.body, [&](const cycle::Statement& statement) { declare(statement); });
    cycle::eachStatement(file.body, [&](const cycle::Statement& statement) { use(statement); });
  }

private:
  void define(const cycle::Name& name, std::string fact, SymbolKind kind, SourceRange range,
              const std::string& detail) {
    const std::string key = "name " + name.text;
    index_.occurrences.push_back({key, Role::Definition, name.range});
    defined_.insert(name.range.begin);
    if (!fact.empty()) index_.facts.push_back({name.range, fact});
    if (known_.insert(name.text).second) {
      index_.symbols.push_back({name.text, detail, kind, range, name.range, {}});
      // A parameter or result is known to callers; what only this file sees may be renamed.
      if (kind == SymbolKind::Variable) index_.renamable.push_back(key);
    }
    if (!fact.empty()) facts_.try_emplace(name.text, std::move(fact));
  }

  void declare(const cycle::Statement& statement) {
    if (const auto* header = std::get_if<cycle::Header>(&statement.node)) {
      index_.occurrences.push_back({"cycle " + header->name.text, Role::Definition, header->name.range});
      index_.symbols.push_back({header->name.text,
                                header->title ? header->title->text : "",
                                SymbolKind::Function,
                                statement.range,
                                header->name.range,
                                {}});
    } else if (const auto* parameter = std::get_if<cycle::Parameter>(&statement.node)) {
      for (const cycle::Name& name : parameter->names) {
        define(name, parameterText(*parameter, name.text), SymbolKind::Field, statement.range,
               typeOf(parameter->type));
        if (!parameter->optional && parameter->value == nullptr) index_.needed.push_back(name.text);
      }
    } else if (const auto* result = std::get_if<cycle::Result>(&statement.node)) {
      for (const cycle::Name& name : result->names)
        define(name,
               fmt::format("**{}** result, {}{}", name.text, typeOf(result->type),
                           result->title ? "\n\n" + result->title->text : ""),
               SymbolKind::Field, statement.range, "result");
    } else if (const auto* touch = std::get_if<cycle::Touch>(&statement.node)) {
      if (touch->name)
        define(*touch->name, fmt::format("**{}** touch", touch->name->text), SymbolKind::Variable,
               statement.range, touch->along.empty() ? "touch" : "touch along a direction");
    } else if (const auto* call = std::get_if<cycle::Call>(&statement.node)) {
      if (call->result)
        define(*call->result, fmt::format("**{}** results of `{}`", call->result->text, call->cycle.text),
               SymbolKind::Variable, statement.range, call->cycle.text);
    } else if (const auto* loop = std::get_if<cycle::For>(&statement.node)) {
      define(loop->name, "", SymbolKind::Variable, statement.range, "loop");
    } else if (const auto* assign = std::get_if<cycle::Assign>(&statement.node)) {
      if (!known_.contains(assign->name.text))
        define(assign->name, "", SymbolKind::Variable, statement.range, "");
    }
  }

  void use(const cycle::Statement& statement) {
    if (const auto* call = std::get_if<cycle::Call>(&statement.node)) called(*call);
    if (const auto* used = std::get_if<cycle::Use>(&statement.node))
      index_.occurrences.push_back({"cycle " + used->name.text, Role::Read, used->name.range});
    if (const auto* assign = std::get_if<cycle::Assign>(&statement.node);
        assign && !defined_.contains(assign->name.range.begin))
      name(assign->name, Role::Write);
    eachExpression(statement, [&](const cycle::Expression& one) { expression(one); });
  }

  void called(const cycle::Call& call) {
    index_.occurrences.push_back({"cycle " + call.cycle.text, Role::Read, call.cycle.range});
    const cycle::File* const target = call.called;
    if (target == nullptr) return;
    const std::string& path = sources_.file(target->file).name();
    std::error_code error;
    if (std::filesystem::is_regular_file(path, error)) index_.files["cycle " + call.cycle.text] = path;
    std::string fact = "**" + call.cycle.text + "**";
    if (const cycle::Header* header = target->header(); header != nullptr && header->title)
      fact += " " + header->title->text;
    fact += "\n";
    std::map<std::string, std::string> parameters;
    for (const cycle::Statement& one : target->body.statements)
      if (const auto* parameter = std::get_if<cycle::Parameter>(&one.node))
        for (const cycle::Name& name : parameter->names) {
          parameters.emplace(name.text, parameterText(*parameter, name.text));
          fact += fmt::format("\n- `{}` {}{}", name.text, typeOf(parameter->type),
                              parameter->title ? ", " + parameter->title->text : "");
        }
    index_.facts.push_back({call.cycle.range, std::move(fact)});
    for (const cycle::Argument& argument : call.arguments)
      if (const auto at = parameters.find(argument.name.text); at != parameters.end())
        index_.facts.push_back({argument.name.range, at->second});
  }

  template <class Visit> static void eachExpression(const cycle::Statement& statement, const Visit& visit) {
    const auto one = [&](const cycle::ExpressionPtr& expression) {
      if (expression != nullptr) visit(*expression);
    };
    const auto axes = [&](const std::vector<cycle::Coordinate>& list) {
      for (const cycle::Coordinate& coordinate : list) {
        one(coordinate.system);
        one(coordinate.value);
      }
    };
    const auto& node = statement.node;
    if (const auto* p = std::get_if<cycle::Parameter>(&node)) {
      one(p->value);
      for (const cycle::Clause& clause : p->clauses) {
        one(clause.first);
        one(clause.second);
      }
    }
    if (const auto* r = std::get_if<cycle::Require>(&node)) one(r->condition);
    if (const auto* d = std::get_if<cycle::Dwell>(&node)) one(d->time);
    if (const auto* r = std::get_if<cycle::Report>(&node))
      one(r->nominal), one(r->measured), one(r->tolerance);
    if (const auto* m = std::get_if<cycle::Move>(&node)) axes(m->axes), one(m->feed);
    if (const auto* t = std::get_if<cycle::Touch>(&node)) axes(t->along), one(t->value), one(t->overtravel);
    if (const auto* s = std::get_if<cycle::SetOffset>(&node)) {
      one(s->system);
      for (const cycle::Becomes& item : s->items)
        one(item.value), one(item.coordinate);
    }
    if (const auto* s = std::get_if<cycle::SetTool>(&node)) one(s->tool), one(s->value);
    if (const auto* s = std::get_if<cycle::SetStored>(&node)) one(s->value);
    if (const auto* a = std::get_if<cycle::Assign>(&node)) one(a->value);
    if (const auto* i = std::get_if<cycle::If>(&node))
      for (const cycle::If::Part& part : i->parts)
        one(part.condition);
    if (const auto* r = std::get_if<cycle::Repeat>(&node)) one(r->count);
    if (const auto* f = std::get_if<cycle::For>(&node)) one(f->first), one(f->last), one(f->step);
    if (const auto* w = std::get_if<cycle::While>(&node)) one(w->condition), one(w->most);
    if (const auto* c = std::get_if<cycle::Call>(&node))
      for (const cycle::Argument& argument : c->arguments)
        one(argument.value);
  }

  void expression(const cycle::Expression& expression) {
    if (const auto* use = std::get_if<cycle::NameUse>(&expression.node))
      name({expression.range, use->name}, Role::Read);
    else if (const auto* member = std::get_if<cycle::Member>(&expression.node))
      name(member->object, Role::Read);
    else if (const auto* given = std::get_if<cycle::Given>(&expression.node))
      name(given->name, Role::Read);
    else if (const auto* unary = std::get_if<cycle::Unary>(&expression.node))
      this->expression(*unary->operand);
    else if (const auto* binary = std::get_if<cycle::Binary>(&expression.node))
      this->expression(*binary->left), this->expression(*binary->right);
    else if (const auto* bracketed = std::get_if<cycle::Bracketed>(&expression.node))
      this->expression(*bracketed->inner);
    else if (const auto* function = std::get_if<cycle::Function>(&expression.node))
      for (const cycle::ExpressionPtr& argument : function->arguments)
        this->expression(*argument);
  }

  void name(const cycle::Name& name, Role role) {
    if (!known_.contains(name.text)) return;
    index_.occurrences.push_back({"name " + name.text, role, name.range});
    if (const auto at = facts_.find(name.text); at != facts_.end())
      index_.facts.push_back({name.range, at->second});
  }

  Index& index_;
  const SourceMap& sources_;
  std::set<std::string> known_;
  std::set<std::uint32_t> defined_; // where names are defined
  std::map<std::string, std::string> facts_;
};

} // namespace

void indexCycle(Index& index, project::Session& session, const std::string& path) {
  project::CycleFiles files(session);
  if (const cycle::File* file = files.linked(path)) Indexer(index, session.sources()).file(*file);
}

} // namespace dotek::lsp
