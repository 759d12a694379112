// Rules on posts of Fusion.
#pragma once

#include "lint/PostFile.h"
#include "lint/Project.h"

#include <functional>
#include <initializer_list>

namespace dotek::lint {

// The posts and fragments of a project.
const std::vector<const PostFile*>& postsOf(const Project& project);

// Calls `visit` with each post and fragment.
template <class Visit> void forEachPost(const Project& project, const Visit& visit) {
  for (const PostFile* post : postsOf(project))
    visit(*post);
}

// Calls `visit` with each node of a kind of each post, in the order of reading: what is within a node comes
// before it, or after, as the language wants it read.
template <class Visit> void forEachNode(const Project& project, fusion::Kind kind, const Visit& visit) {
  for (const PostFile* post : postsOf(project))
    for (const fusion::Node& node : post->tree.nodes)
      if (node.kind == kind) visit(*post, node);
}

// The name of a call, "createFormat" or "xOutput.format"; "" where it is another value.
std::string calledName(const fusion::Node& call);
// The literal text of a String node, else "".
std::string_view textLiteral(const fusion::Node* node);
// Of an object literal: the value of a property; nullptr: it has none.
const fusion::Node* propertyOf(const fusion::Node* object, std::string_view name);
// An object or a list that is written here, or is the one value of the variable that is named.
const fusion::Node* objectOf(const PostFile& post, const fusion::Node* node);
std::string_view keyOf(const fusion::Node& property); // without quotes
// The last statement of these that cannot be left downward: return, throw, break, continue, error(..).
bool endsFlow(const fusion::Node* statement);
// Arguments of a writer begin with a macro that measures: P9811 to P9899 and their like, no protected move.
// What is not written as a number is not judged.
bool callsMeasuringMacro(const fusion::Node& call);
// Calls `visit` with the node and all below it, but not with what is within functions, unless `functions`.
void walk(const fusion::Node* node, const std::function<void(const fusion::Node&)>& visit,
          bool functions = false);
// What the top level of a post gives a variable of its own or of the engine: the last value, nullptr: none.
const fusion::Node* topLevelValue(const PostFile& post, std::string_view name);

// What a script makes by createFormat(..), createVariable(..) and the like.
struct Made {
  const fusion::Symbol* symbol = nullptr;
  std::string_view maker; // "createFormat"
  const fusion::Node* call = nullptr;
  const fusion::Node* specifiers = nullptr; // an Object, or nullptr
  std::string_view prefix;                  // as it is written
  bool modal() const { return maker != "createFormat" && maker != "createReferenceVariable"; }
};
// All that are given to a variable of the top level, by its symbol.
std::vector<Made> madeOf(const PostFile& post);

} // namespace dotek::lint
