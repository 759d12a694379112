// Posts of Fusion: functions, variables, properties that the user of the post sets, names of the engine.
#include "frontend/fusion/Parse.h"
#include "frontend/fusion/Scopes.h"
#include "lint/Posts.h"
#include "lsp/Index.h"
#include "project/Session.h"

#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace dotek::lsp {

namespace fusion = frontend::fusion;
using fusion::Kind;
using Role = Occurrence::Role;

namespace {

constexpr std::size_t kMostShown = 300; // bytes of a value that a hover shows

class Indexer {
public:
  Indexer(Index& index, const lint::PostFile& post) : index_(index), post_(post) {}

  void post() {
    names();
    renames();
    properties();
    for (const auto& [name, symbol] : post_.scopes.scopes.front().names)
      topLevel(*symbol);
    std::stable_sort(index_.symbols.begin(), index_.symbols.end(),
                     [](const Symbol& a, const Symbol& b) { return a.range.begin < b.range.begin; });
  }

private:
  SourceRange range(const fusion::Node& node) const { return post_.tree.range(node); }
  std::string text(const fusion::Node& node) const { return index_.utf8(post_.tree.textOf(node)); }

  static std::string keyOf(const fusion::Symbol& symbol) {
    return symbol.declaration == nullptr ? fmt::format("engine {}", symbol.name)
                                         : fmt::format("js {} {}", symbol.declaration->begin, symbol.name);
  }

  void names() {
    for (const fusion::Symbol& symbol : post_.scopes.symbols) {
      if (symbol.declaration == nullptr) continue;
      index_.occurrences.push_back({keyOf(symbol), Role::Definition, range(*symbol.declaration), ""});
      if (std::string fact = factOf(symbol); !fact.empty())
        index_.facts.push_back({range(*symbol.declaration), std::move(fact)});
    }
    for (const fusion::Use& use : post_.scopes.uses) {
      if (use.name == nullptr || use.symbol == nullptr || use.name == use.symbol->declaration) continue;
      const bool writes = use.kind == fusion::Use::Kind::Write || use.kind == fusion::Use::Kind::ReadWrite;
      index_.occurrences.push_back(
          {keyOf(*use.symbol), writes ? Role::Write : Role::Read, range(*use.name), ""});
      if (std::string fact = factOf(*use.symbol); !fact.empty())
        index_.facts.push_back({range(*use.name), std::move(fact)});
    }
  }

  // A name that only this script sees. The engine calls functions and reads variables by their names, other
  // scripts see what is outside of functions, and a name that is a property's too cannot change alone.
  void renames() {
    std::set<std::uint32_t> asProperty;
    bool elsewhere = false; // another script, or a text that is run
    for (const fusion::Node& node : post_.tree.nodes) {
      if (node.is(Kind::Property) && node.flag) asProperty.insert(node.begin);
      if (!node.is(Kind::Call) && !node.is(Kind::New)) continue;
      const std::string called = lint::calledName(node);
      elsewhere = elsewhere || called == "include" || called == "eval" || called == "Function";
    }
    std::set<const fusion::Symbol*> fixed;
    for (const fusion::Use& use : post_.scopes.uses)
      if (use.name != nullptr && asProperty.contains(use.name->begin)) fixed.insert(use.symbol);
    for (const fusion::Symbol& symbol : post_.scopes.symbols) {
      if (symbol.declaration == nullptr) continue;
      const bool local = symbol.scope != nullptr && symbol.scope->parent != nullptr;
      const bool known =
          post_.names->all.contains(symbol.name) || symbol.name == "properties" || symbol.name == "arguments";
      if (fixed.contains(&symbol) || asProperty.contains(symbol.declaration->begin)) continue;
      if (local || (!known && !elsewhere)) index_.renamable.push_back(keyOf(symbol));
    }
    for (const fusion::Symbol& symbol : post_.scopes.symbols)
      index_.taken.insert(index_.utf8(symbol.name));
    index_.taken.insert(post_.names->all.begin(), post_.names->all.end());
    // Words that the language reserves are no names anywhere; these are in some places.
    for (const char* word : {"arguments", "await", "eval", "let", "static", "undefined", "yield"})
      index_.taken.insert(word);
  }

  // What it is to the engine, and how the post declares it.
  std::string factOf(const fusion::Symbol& symbol) const {
    std::string out;
    const stdlib::FusionNames& names = *post_.names;
    if (symbol.scope == nullptr || symbol.scope->parent == nullptr) {
      if (names.entries.contains(symbol.name))
        out = "called by the engine";
      else if (names.functions.contains(symbol.name))
        out = "function of the engine";
      else if (names.variables.contains(symbol.name) || names.hooks.contains(symbol.name))
        out = "known to the engine";
      else if (names.classes.contains(symbol.name))
        out = "class of the engine";
      for (const stdlib::FusionNames::Family& family : names.families)
        if (std::find(family.names.begin(), family.names.end(), symbol.name) != family.names.end())
          out = "constant of the engine, " + family.name;
    }
    if (symbol.declaration == nullptr && out.empty()) return "";
    out = fmt::format("**{}**{}{}", index_.utf8(symbol.name), out.empty() ? "" : " ", out);
    if (symbol.kind == fusion::Symbol::Kind::Parameter) return out + " parameter";
    if (symbol.value == nullptr) return out;
    const bool function = symbol.value->is(Kind::Function) && symbol.value->kid(1) != nullptr;
    std::string shown =
        function ? fmt::format("function {}{}", index_.utf8(symbol.name), text(*symbol.value->kid(1)))
                 : fmt::format("{} = {}", index_.utf8(symbol.name),
                               index_.utf8(post_.tree.textOf(*symbol.value).substr(0, kMostShown)));
    if (!function && post_.tree.textOf(*symbol.value).size() > kMostShown) shown += " ...";
    return out + "\n\n```javascript\n" + shown + "\n```";
  }

  void topLevel(const fusion::Symbol& symbol) {
    if (symbol.declaration == nullptr || symbol.name == "properties") return;
    const bool function = symbol.kind == fusion::Symbol::Kind::Function;
    const SourceRange name = range(*symbol.declaration);
    SourceRange whole = name;
    if (symbol.value != nullptr) whole = spanning(name, range(*symbol.value));
    if (function && symbol.value != nullptr) whole = range(*symbol.value);
    index_.symbols.push_back(
        {index_.utf8(symbol.name),
         function && post_.names->entries.contains(symbol.name) ? "called by the engine" : "",
         function ? SymbolKind::Function : SymbolKind::Variable,
         whole,
         name,
         {}});
  }

  void properties() {
    const fusion::Node* const all = fusion::bare(lint::topLevelValue(post_, "properties"));
    std::map<std::string_view, std::string> facts;
    if (all != nullptr && all->is(Kind::Object)) {
      Symbol symbol{"properties", "", SymbolKind::Module, range(*all), range(*all), {}};
      symbol.nameRange.end = symbol.nameRange.begin;
      for (const fusion::Node* one : all->kids) {
        if (!one->is(Kind::Property) || one->kids[0]->is(Kind::Computed)) continue;
        const std::string_view name = lint::keyOf(*one);
        const std::string title = plain(lint::propertyOf(one->kids[1], "title"));
        std::string fact = fmt::format("**{}** property of the post{}", index_.utf8(name),
                                       title.empty() ? "" : ": " + title);
        if (const std::string said = plain(lint::propertyOf(one->kids[1], "description")); !said.empty())
          fact += "\n\n" + said;
        for (const char* part : {"type", "value", "group", "scope"})
          if (const fusion::Node* value = lint::propertyOf(one->kids[1], part))
            fact += fmt::format("\n- {}: `{}`", part, text(*value));
        const SourceRange place = inside(*one->kids[0]);
        index_.occurrences.push_back({propertyKey(name), Role::Definition, place, ""});
        index_.facts.push_back({place, fact});
        facts[name] = std::move(fact);
        symbol.children.push_back({index_.utf8(name), title, SymbolKind::Field, range(*one), place, {}});
      }
      index_.symbols.push_back(std::move(symbol));
    }
    const auto use = [&](std::string_view name, SourceRange place) {
      if (name.empty()) return;
      index_.occurrences.push_back({propertyKey(name), Role::Read, place, ""});
      if (const auto at = facts.find(name); at != facts.end()) index_.facts.push_back({place, at->second});
    };
    for (const fusion::Node& node : post_.tree.nodes) {
      if (node.is(Kind::Member) && node.kid(0) != nullptr && node.kids[0]->isName("properties") &&
          node.kid(1) != nullptr)
        use(node.kids[1]->text, range(*node.kids[1]));
      if (!node.is(Kind::Call) || node.kids.size() < 2) continue;
      const std::string called = lint::calledName(node);
      if (called != "getProperty" && called != "setProperty") continue;
      const fusion::Node* const name = fusion::bare(node.kids[1]);
      if (name != nullptr && name->is(Kind::String)) use(fusion::stringText(*name), inside(*name));
    }
  }

  std::string propertyKey(std::string_view name) const { return "property " + index_.utf8(name); }
  // Without the quotes of a text.
  SourceRange inside(const fusion::Node& node) const {
    SourceRange out = range(node);
    if (node.is(Kind::String) && out.end >= out.begin + 2) ++out.begin, --out.end;
    return out;
  }
  std::string plain(const fusion::Node* node) const { return index_.utf8(lint::textLiteral(node)); }

  Index& index_;
  const lint::PostFile& post_;
};

} // namespace

void indexPost(Index& index, project::Session& session) {
  const stdlib::FusionNames names = stdlib::FusionNames::load(session.data());
  lint::PostFile post;
  post.file = index.file;
  post.names = &names;
  post.tree = fusion::parse(index.file, session.sources());
  post.scopes = fusion::resolve(post.tree);
  Indexer(index, post).post();
}

} // namespace dotek::lsp
