#include "frontend/fusion/Lowering.h"

#include <algorithm>
#include <fmt/format.h>

namespace dotek::frontend::fusion {

std::string Lowering::keyText(const Node& key) {
  if (key.is(Kind::Name)) return "\"" + std::string(key.text) + "\"";
  if (key.is(Kind::Computed)) return of(key.kids[0]);
  return std::string(tree_.textOf(key));
}

std::string Lowering::member(const Node& key) {
  if (key.is(Kind::Name)) return "." + std::string(key.text);
  return "[" + keyText(key) + "]";
}

void Lowering::bindOne(const Node& target, const std::string& value, std::vector<std::string>& out) {
  if (target.is(Kind::Default)) {
    bindOne(*target.kids[0], fmt::format("{0} === undefined ? {1} : {0}", value, of(target.kids[1])), out);
  } else if (target.is(Kind::ArrayPattern) || target.is(Kind::ObjectPattern)) {
    const std::string name = temporary();
    out.push_back(name + " = " + value);
    bind(target, name, out);
  } else {
    out.push_back(of(&target) + " = " + value);
  }
}

// What a pattern takes out of the variable `from`, as assignments.
void Lowering::bind(const Node& pattern, const std::string& from, std::vector<std::string>& out) {
  if (!pattern.is(Kind::ArrayPattern) && !pattern.is(Kind::ObjectPattern)) return bindOne(pattern, from, out);
  std::string taken;
  for (std::size_t i = 0; i < pattern.kids.size(); ++i) {
    const Node* const one = pattern.kids[i];
    if (one == nullptr) continue;
    if (one->is(Kind::Spread)) {
      bindOne(*one->kids[0],
              pattern.is(Kind::ArrayPattern) ? fmt::format("{}.slice({})", from, i)
                                             : fmt::format("dotekEs6.rest({}, [{}])", from, taken),
              out);
    } else if (pattern.is(Kind::ArrayPattern)) {
      bindOne(*one, fmt::format("{}[{}]", from, i), out);
    } else {
      taken += (taken.empty() ? "" : ", ") + keyText(*one->kids[0]);
      bindOne(*one->kids[1], from + member(*one->kids[0]), out);
    }
  }
}

std::string Lowering::declarator(const Node& node, bool fresh) {
  const Node& target = *node.kids[0];
  if (target.is(Kind::Name)) {
    if (node.kids[1] == nullptr) return of(&target) + (fresh ? " = undefined" : "");
    return of(&target) + slice(target.end, node.kids[1]->begin) + of(node.kids[1]);
  }
  const std::string name = ownName();
  std::vector<std::string> bound;
  const std::string value =
      target.is(Kind::ArrayPattern) ? "dotekEs6.list(" + of(node.kids[1]) + ")" : of(node.kids[1]);
  bind(target, name, bound);
  std::string out = name + " = " + value;
  for (const std::string& one : bound)
    out += ", " + one;
  return filled(out, node.begin, node.end);
}

std::string Lowering::variables(const Node& node, bool inHead) {
  if (node.text == "var" && passAround() != nullptr) return assignments(node);
  const Scope* scope = nullptr;
  if (const Node* const first = node.kids.front()->kids[0]; first->is(Kind::Name))
    if (const Symbol* symbol = scopes_.symbolOf(first)) scope = symbol->scope;
  const bool fresh = !inHead && node.text == "let" && scope != nullptr && scope->inLoop;
  std::string out = "var";
  std::uint32_t from = node.begin + static_cast<std::uint32_t>(node.text.size());
  for (const Node* one : node.kids) {
    out += slice(from, one->begin) + declarator(*one, fresh);
    from = one->end;
  }
  return out + slice(from, node.end);
}

// `var` in a pass that is a call: the variables are those of the function around it.
std::string Lowering::assignments(const Node& node) {
  std::string out;
  std::uint32_t from = node.begin + 3;
  for (const Node* one : node.kids) {
    const Node& target = *one->kids[0];
    hoistAll(target);
    out += slice(from, one->begin);
    from = one->end;
    if (one->kids[1] == nullptr) {
      out += "void 0";
    } else if (target.is(Kind::Name)) {
      out += declarator(*one, false);
    } else {
      const std::string name = temporary();
      std::vector<std::string> bound;
      out += name + " = " +
             (target.is(Kind::ArrayPattern) ? "dotekEs6.list(" + of(one->kids[1]) + ")" : of(one->kids[1]));
      bind(target, name, bound);
      for (const std::string& each : bound)
        out += ", " + each;
      out = filled(out, node.begin, one->end);
    }
  }
  return out + slice(from, node.end);
}

// Names for the list, and what the body begins with.
std::string Lowering::parameterNames(const Node& parameters, std::string& prologue) {
  std::string out;
  for (std::size_t i = 0; i < parameters.kids.size(); ++i) {
    const Node& one = *parameters.kids[i];
    const std::string comma = out.empty() ? "" : ", ";
    if (one.is(Kind::Name)) {
      out += comma + of(&one);
    } else if (one.is(Kind::Spread)) {
      std::vector<std::string> bound;
      bindOne(*one.kids[0], fmt::format("Array.prototype.slice.call(arguments, {})", i), bound);
      for (const std::string& each : bound)
        prologue += " var " + each + ";";
    } else if (one.is(Kind::Default) && one.kids[0]->is(Kind::Name)) {
      const std::string name = of(one.kids[0]);
      out += comma + name;
      prologue += fmt::format(" if ({0} === undefined) {{ {0} = {1}; }}", name, of(one.kids[1]));
    } else {
      const std::string name = ownName();
      out += comma + name;
      const Node* pattern = &one;
      if (one.is(Kind::Default)) {
        prologue += fmt::format(" if ({0} === undefined) {{ {0} = {1}; }}", name, of(one.kids[1]));
        pattern = one.kids[0];
      }
      std::vector<std::string> bound;
      bind(*pattern, name, bound);
      for (const std::string& each : bound)
        prologue += " var " + each + ";";
    }
  }
  return out;
}

std::string Lowering::functionRest(const Node& parameters, const Node& body, const std::string& more) {
  temporaries_.emplace_back();
  frames_.push_back({Frame::Kind::Function});
  std::string prologue;
  const std::string names = parameterNames(parameters, prologue);
  std::string text = body.is(Kind::Block) ? parts(body, body.begin + 1, body.end) : of(&body);
  prologue += more;
  for (const std::string& name : temporaries_.back())
    prologue = " var " + name + ";" + prologue;
  temporaries_.pop_back();
  frames_.pop_back();
  const std::string gap = filled(prologue, parameters.begin, body.begin);
  std::string lacking = gap.substr(prologue.size());
  if (!body.is(Kind::Block)) return "(" + names + ") {" + prologue + lacking + " return " + text + "; }";
  return "(" + names + ") {" + prologue + lacking + text;
}

std::string Lowering::function(const Node& node, const std::string& prologue) {
  const Node& parameters = *node.kids[1];
  const Node& body = *node.kids[2];
  return slice(node.begin, parameters.begin) + functionRest(parameters, body, prologue);
}

std::string Lowering::arrow(const Node& node) {
  const auto scope = scopes_.ofNode.find(&node);
  const bool bound = scope != scopes_.ofNode.end() && scope->second->usesThis;
  if (scope != scopes_.ofNode.end() && scope->second->usesArguments)
    refuse(node, "`arguments` within an arrow function");
  const std::string text = "(function " + functionRest(*node.kids[0], *node.kids[1], "") + ")";
  return bound ? text + ".bind(this)" : text;
}

std::string Lowering::classText(const Node& node) {
  const Node* const called = node.kids[0];
  const Node* const base = node.kids[1];
  const std::string name = called == nullptr ? ownName() : of(called);
  const std::string super = ownName();
  const bool statement = called != nullptr && scopes_.symbolOf(called) != nullptr &&
                         scopes_.symbolOf(called)->scope->node != &node;
  supers_.push_back(base == nullptr ? "Object" : super);
  std::string fields, statics;
  const Node* constructor = nullptr;
  for (std::size_t i = 2; i < node.kids.size(); ++i) {
    const Node& one = *node.kids[i];
    if (one.is(Kind::Method) && one.kids[0]->isName("constructor") && !one.flag) constructor = &one;
    if (!one.is(Kind::Field)) continue;
    const std::string value = one.kids[1] == nullptr ? "undefined" : of(one.kids[1]);
    (one.flag ? statics : fields) += (one.flag ? name : "this") + member(*one.kids[0]) + " = " + value + "; ";
    if (value.find('\n') != std::string::npos) refuse(one, "a field of a class over several lines");
  }
  if (base != nullptr && constructor != nullptr && !fields.empty())
    refuse(node, "fields of a class with `extends` and a constructor");
  const std::string needsNew = fmt::format("dotekEs6.made(this, {}); ", name);
  std::string out = statement ? "var " + name + " = " : "";
  out += "(function (" + super + ") {";
  if (constructor == nullptr)
    out += fmt::format(" function {}() {{ {}{}{}}}", name, needsNew,
                       base == nullptr ? "" : "dotekEs6.init(" + super + ", this, arguments); ", fields);
  if (base != nullptr) out += " dotekEs6.extend(" + name + ", " + super + ");";
  std::uint32_t from = node.begin;
  for (std::size_t i = 2; i < node.kids.size(); ++i) {
    const Node& one = *node.kids[i];
    out += lines(from, one.begin) + " ";
    from = one.end;
    if (one.is(Kind::Field)) {
      out += lines(one.begin, one.end);
      continue;
    }
    const Node& of_ = *one.kids[1];
    const std::string function =
        functionRest(*of_.kids[1], *of_.kids[2], &one == constructor ? " " + needsNew + fields : "");
    const std::string place = one.flag ? name : name + ".prototype";
    if (&one == constructor)
      out += "function " + name + function;
    else if (one.text.empty())
      out += fmt::format("dotekEs6.method({}, {}, function {});", place, keyText(*one.kids[0]), function);
    else
      out += fmt::format("dotekEs6.accessor({}, {}, \"{}\", function {});", place, keyText(*one.kids[0]),
                         one.text, function);
  }
  out += lines(from, node.end) + " " + statics + "return " + name + "; })(" +
         (base == nullptr ? "" : of(base)) + ")" + (statement ? ";" : "");
  supers_.pop_back();
  return out;
}

} // namespace dotek::frontend::fusion
