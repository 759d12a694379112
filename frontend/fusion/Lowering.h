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
  void checkClosures();
  bool staysInPass(const Use& use) const;

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
  std::string templateText(const Node& node);
  std::string arrow(const Node& node);
  std::string function(const Node& node, const std::string& prologue = "");
  std::string functionRest(const Node& parameters, const Node& body, const std::string& prologue);
  std::string parameterNames(const Node& parameters, std::string& prologue);
  std::string forOf(const Node& node);
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

  const Tree& tree_;
  const Scopes& scopes_;
  Lowered out_;
  std::unordered_set<const Node*> changes_;
  std::unordered_map<const Symbol*, std::string> renamed_;
  std::set<std::string, std::less<>> names_;                 // all of the script
  std::vector<std::vector<std::string>> temporaries_ = {{}}; // of each function that is being written
  std::vector<std::string> supers_;
  int count_ = 0;
};

} // namespace dotek::frontend::fusion
