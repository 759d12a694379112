// Private to frontend/fusion: the text of each node as ES5.
#pragma once

#include "frontend/fusion/Lower.h"

#include <set>
#include <unordered_set>

namespace dotek::frontend::fusion {

// Each piece keeps the line ends of what it replaces, so that places in the result are places in the post.
class Lowering {
public:
  Lowering(const Tree& tree, const Scopes& scopes) : tree_(tree), scopes_(scopes) {}
  Lowered run();

private:
  // Preparation
  bool mark(const Node* node); // whether it, or a part of it, changes
  static bool keyIs(const Node& key, std::string_view name);
  bool changes(const Node& node) const;
  void rename();
  void findPasses();
  bool staysInPass(const Use& use) const;
  static const Node* bodyOf(const Node& loop);
  const Node* loopOf(const Symbol& symbol) const;
  std::string noCall(const Node& loop, const Use& use) const;

  // Text
  std::string of(const Node* node);
  std::string parts(const Node& node, std::uint32_t from, std::uint32_t to);
  std::string parts(const Node& node) { return parts(node, node.begin, node.end); }
  std::string slice(std::uint32_t from, std::uint32_t to) const {
    return std::string(tree_.text.substr(from, to - from));
  }
  std::string lines(std::uint32_t from, std::uint32_t to) const;                    // the line ends there
  std::string filled(std::string text, std::uint32_t from, std::uint32_t to) const; // with those it lacks
  std::string temporary(); // declared in the function that is being written
  std::string ownName();   // declared where it is used
  void refuse(const Node& node, std::string what);

  std::string changed(const Node& node);
  std::string variables(const Node& node, bool inHead);
  std::string declarator(const Node& node, bool fresh);
  std::string assignments(const Node& node);
  std::string templateText(const Node& node);
  std::string arrow(const Node& node);
  std::string function(const Node& node, const std::string& prologue = "");
  std::string functionRest(const Node& parameters, const Node& body, const std::string& prologue);
  std::string parameterNames(const Node& parameters, std::string& prologue);
  std::string loop(const Node& node);
  std::string forLoop(const Node& node);
  std::string forIn(const Node& node);
  std::string forOf(const Node& node);
  std::string pass(const Node& body, const std::string& parameters, const std::string& given,
                   const std::string& first, const std::string& last);
  std::string leave(const Node& node); // return, break, continue
  std::string jump(const std::string& word, std::string_view label);
  void hoist(const std::string& name);
  void hoistAll(const Node& target);
  std::string array(const Node& node);
  std::string object(const Node& node);
  std::string objectPart(const Node& node);
  std::string list(const std::vector<Node*>& of, std::size_t first, std::uint32_t from, std::uint32_t to);
  std::string call(const Node& node);
  std::string chain(const Node& node);
  std::string binary(const Node& node);
  std::string assign(const Node& node);
  std::string classText(const Node& node);
  std::string member(const Node& key); // `.name` or `[..]`
  std::string keyText(const Node& key);
  void bind(const Node& pattern, const std::string& from, std::vector<std::string>& out);
  void bindOne(const Node& target, const std::string& value, std::vector<std::string>& out);

  // What surrounds a statement that is being written.
  struct Frame {
    enum class Kind : std::uint8_t {
      Function,
      Loop,
      Switch,
      Block,
      Pass
    }; // Pass: the call of a pass of the loop
    Kind kind = Kind::Function;
    std::vector<std::string_view> labels = {}; // of a Loop, or of another statement that has some
    bool leaves = false, returns = false;      // of a Pass: what its result may say
    std::set<std::pair<std::string, std::string>> jumps = {};
  };
  Frame* passAround(); // nullptr: a statement of the function itself

  const Tree& tree_;
  const Scopes& scopes_;
  Lowered out_;
  std::unordered_set<const Node*> changes_;
  std::unordered_map<const Symbol*, std::string> renamed_;
  std::unordered_set<const Node*> fixed_;                    // names of a const that something is assigned to
  std::set<std::string, std::less<>> names_;                 // all of the script
  std::vector<std::vector<std::string>> temporaries_ = {{}}; // of each function that is being written
  std::vector<std::string> supers_;
  std::set<const Node*> passes_; // loops whose passes are calls
  std::unordered_map<const Symbol*, std::string> inPass_;
  std::vector<Frame> frames_;
  std::vector<std::string_view> labels_; // of the statement that follows
  int count_ = 0;
};

} // namespace dotek::frontend::fusion
