#include "frontend/fusion/Lowering.h"

#include <algorithm>
#include <fmt/format.h>

namespace dotek::frontend::fusion {

namespace {

// A value that may be written twice.
bool isPlain(const Node& node) {
  return node.is(Kind::Name) || node.is(Kind::This) ||
         (node.is(Kind::Member) && !node.flag && isPlain(*node.kids[0]));
}

bool hasSpread(const Node& node) {
  return std::any_of(node.kids.begin(), node.kids.end(),
                     [](const Node* one) { return one != nullptr && one->is(Kind::Spread); });
}

} // namespace

std::string Lowering::templateText(const Node& node) {
  std::string out = "(";
  std::uint32_t at = node.begin + 1;
  const auto chunk = [&](std::uint32_t end) {
    std::string text = "\"";
    for (; at < end; ++at) {
      const char c = tree_.text[at];
      if (c == '\\' && at + 1 < end) {
        if (tree_.text[at + 1] == '\n') {
          text += "\" +\n\"";
        } else {
          text += tree_.text[at + 1] == '`' ? "`" : std::string("\\") + tree_.text[at + 1];
        }
        ++at;
      } else if (c == '"') {
        text += "\\\"";
      } else if (c == '\n') {
        text += "\\n\" +\n\"";
      } else if (c != '\r') {
        text += c;
      }
    }
    return text + "\"";
  };
  for (std::size_t i = 0; i < node.kids.size(); ++i) {
    const Node& value = *node.kids[i];
    // `${` lies before the value, with blanks or brackets of comments between.
    std::uint32_t open = value.begin;
    while (open > at && !(tree_.text[open - 1] == '{' && open >= 2 && tree_.text[open - 2] == '$'))
      --open;
    out += chunk(open - 2) + " + String(" + lines(open, value.begin) + of(&value) + ")";
    at = value.end;
    while (at < node.end && tree_.text[at] != '}') {
      if (tree_.text[at] == '\n') out += "\n";
      ++at;
    }
    ++at;
    out += " + ";
  }
  return out + chunk(node.end - 1) + ")";
}

std::string Lowering::list(const std::vector<Node*>& of, std::size_t first, std::uint32_t from,
                           std::uint32_t to) {
  std::string out = "[].concat(";
  bool open = false, any = false;
  for (std::size_t i = first; i < of.size(); ++i) {
    const Node* const one = of[i];
    const bool spread = one != nullptr && one->is(Kind::Spread);
    if (spread && open) {
      out += "]";
      open = false;
    }
    if (any) out += ", ";
    if (one != nullptr) {
      out += lines(from, one->begin);
      from = one->end;
    }
    if (!spread && !open) {
      out += "[";
      open = true;
    }
    any = true;
    out += spread           ? "dotekEs6.list(" + this->of(one->kids[0]) + ")"
           : one == nullptr ? "undefined"
                            : this->of(one);
  }
  return out + (open ? "]" : "") + lines(from, to) + ")";
}

std::string Lowering::array(const Node& node) {
  return hasSpread(node) ? list(node.kids, 0, node.begin, node.end) : parts(node);
}

std::string Lowering::objectPart(const Node& node) {
  if (node.is(Kind::Property)) {
    if (!node.flag)
      return of(node.kids[0]) + slice(node.kids[0]->end, node.kids[1]->begin) + of(node.kids[1]);
    return std::string(node.kids[0]->text) + ": " + of(node.kids[1]);
  }
  const Node& function = *node.kids[1];
  const std::string rest = functionRest(*function.kids[1], *function.kids[2], "");
  if (!node.text.empty()) return slice(node.begin, node.kids[0]->end) + rest;
  return of(node.kids[0]) + ": function " + rest;
}

std::string Lowering::object(const Node& node) {
  const auto isPrototype = [](const Node* one) { // `__proto__: value` sets it, and is no property
    return one->is(Kind::Property) && !one->flag && keyIs(*one->kids[0], "__proto__");
  };
  const auto loose = [&](const Node* one) {
    return one->is(Kind::Spread) || one->kids[0]->is(Kind::Computed) || isPrototype(one);
  };
  if (std::none_of(node.kids.begin(), node.kids.end(), loose)) return parts(node);
  std::string out = "dotekEs6.object({";
  bool open = true, first = true;
  std::uint32_t from = node.begin;
  for (const Node* one : node.kids) {
    const std::string gap = lines(from, one->begin);
    from = one->end;
    if (loose(one)) {
      out += (open ? "}, " : ", ") + gap;
      open = false;
      if (one->is(Kind::Spread)) {
        out += "dotekEs6.spread(" + of(one->kids[0]) + ")";
      } else if (isPrototype(one)) {
        out += "dotekEs6.prototype(" + of(one->kids[1]) + ")";
      } else if (!one->text.empty() && one->is(Kind::Method)) {
        const Node& value = *one->kids[1];
        out += fmt::format("dotekEs6.computed({}, \"{}\", function {})", of(one->kids[0]->kids[0]), one->text,
                           functionRest(*value.kids[1], *value.kids[2], ""));
      } else {
        const Node& value = *one->kids[1];
        const std::string text = one->is(Kind::Method)
                                     ? "function " + functionRest(*value.kids[1], *value.kids[2], "")
                                     : of(&value);
        out += "dotekEs6.pair(" + of(one->kids[0]->kids[0]) + ", " + text + ")";
      }
      continue;
    }
    out += open ? (first ? "" : ", ") : ", {";
    open = true;
    first = false;
    out += gap + of(one);
  }
  return out + (open ? "}" : "") + lines(from, node.end) + ")";
}

std::string Lowering::call(const Node& node) {
  const Node& called = *node.kids[0];
  const bool spread = hasSpread(node);
  const auto plain = [&] {
    std::string out;
    std::uint32_t from = called.end;
    for (std::size_t i = 1; i < node.kids.size(); ++i) {
      out += (i > 1 ? ", " : "") + lines(from, node.kids[i]->begin) + of(node.kids[i]);
      from = node.kids[i]->end;
    }
    return out + lines(from, node.end);
  };
  const auto all = [&] { return spread ? list(node.kids, 1, called.end, node.end) : "[" + plain() + "]"; };
  if (called.is(Kind::Super) || (called.is(Kind::Member) && called.kids[0]->is(Kind::Super))) {
    if (supers_.empty()) {
      refuse(node, "`super` outside of a class");
      return "undefined";
    }
    if (called.is(Kind::Super)) return "dotekEs6.init(" + supers_.back() + ", this, " + all() + ")";
    return supers_.back() + ".prototype." + std::string(called.kids[1]->text) + ".apply(this, " + all() + ")";
  }
  if (node.is(Kind::New))
    return spread                 ? "dotekEs6.make(" + of(&called) + ", " + all() + ")"
           : node.kids.size() > 1 ? slice(node.begin, called.begin) + of(&called) + "(" + plain() + ")"
                                  : parts(node);
  if (node.flag) return chain(node);
  const Node* optional = &called;
  while (optional->is(Kind::Member) || optional->is(Kind::Index) || optional->is(Kind::Call)) {
    if (optional->flag) return chain(node);
    optional = optional->kids[0];
  }
  if (!spread) return of(&called) + "(" + plain() + ")";
  if (!called.is(Kind::Member) && !called.is(Kind::Index))
    return of(&called) + ".apply(undefined, " + all() + ")";
  const Node& object = *called.kids[0];
  if (isPlain(object)) return of(&called) + ".apply(" + of(&object) + ", " + all() + ")";
  const std::string name = temporary();
  return "(" + name + " = " + of(&object) + ")" + parts(called, object.end, called.end) + ".apply(" + name +
         ", " + all() + ")";
}

// `a?.b.c(d)`: what follows the first `?.` is reached only where there is something before it.
std::string Lowering::chain(const Node& node) {
  const Node* lowest = nullptr;
  for (const Node* at = &node; at->is(Kind::Member) || at->is(Kind::Index) || at->is(Kind::Call);
       at = at->kids[0]) {
    if (!at->flag) continue;
    lowest = at; // what is below it is a chain of its own, and of nothing comes nothing
    break;
  }
  if (lowest == nullptr) return parts(node);
  const Node& object = *lowest->kids[0];
  const bool method = lowest->is(Kind::Call) && !object.is(Kind::Name);
  const auto leaves = [](const Node* at) { // `?.` below may leave the chain
    for (; at->is(Kind::Member) || at->is(Kind::Index) || at->is(Kind::Call); at = at->kids[0])
      if (at->flag) return true;
    return false;
  };
  if (method && ((!object.is(Kind::Member) && !object.is(Kind::Index)) || hasSpread(*lowest) ||
                 object.kids[0]->is(Kind::Super) || leaves(object.kids[0]))) {
    refuse(node, "`?.` before these brackets");
    return "undefined";
  }
  const std::string name = temporary();
  const std::string self = method ? temporary() : "";
  const auto found = [&] { // the method, and what it belongs to
    std::string tail = parts(object, object.kids[0]->end, object.end);
    const std::string of = this->of(object.kids[0]);
    if (!object.flag) return fmt::format("({} = {}){}", self, of, tail);
    tail.erase(tail.find("?."), object.is(Kind::Member) ? 1 : 2);
    return fmt::format("(({0} = {1}) === null || {0} === undefined ? undefined : {0}{2})", self, of, tail);
  };
  std::string rest;
  for (const Node* at = &node;; at = at->kids[0]) {
    const std::uint32_t from = at->kids[0]->end;
    std::string one = parts(*at, from, at->end);
    if (at == lowest) {
      const std::size_t mark = one.find("?.");
      one.erase(mark, at->is(Kind::Member) ? 1 : 2);
      if (method) one.replace(one.find('('), 1, ".call(" + self + (at->kids.size() > 1 ? ", " : ""));
    }
    rest = one + rest;
    if (at == lowest) break;
  }
  return fmt::format("(({0} = {1}) === null || {0} === undefined ? undefined : {0}{2})", name,
                     method ? found() : of(&object), rest);
}

std::string Lowering::binary(const Node& node) {
  const Node& left = *node.kids[0];
  const Node& right = *node.kids[1];
  if (node.text == "**")
    return "Math.pow(" + of(&left) + "," + lines(left.end, right.begin) + of(&right) + ")";
  if (node.text != "?\?") return parts(node);
  const std::string name = temporary();
  return fmt::format("(({0} = {1}) !== null && {0} !== undefined ? {0} : {2}{3})", name, of(&left),
                     lines(left.end, right.begin), of(&right));
}

std::string Lowering::assign(const Node& node) {
  const Node& target = *node.kids[0];
  const Node& value = *node.kids[1];
  if (target.is(Kind::ArrayPattern) || target.is(Kind::ObjectPattern)) {
    const std::string name = temporary();
    std::vector<std::string> bound;
    const std::string right =
        target.is(Kind::ArrayPattern) ? "dotekEs6.list(" + of(&value) + ")" : of(&value);
    bind(target, name, bound);
    std::string out = "(" + name + " = " + right;
    for (const std::string& one : bound)
      out += ", " + one;
    return filled(out + ", " + name + ")", node.begin, node.end);
  }
  if (!changes(node)) return parts(node);
  if (!isPlain(target)) {
    refuse(node, fmt::format("`{}` to what has to be found first", node.text));
    return "undefined";
  }
  const std::string to = of(&target);
  const std::string gap = lines(target.end, value.begin);
  const std::string from = of(&value);
  if (node.text == "**=") return to + " = Math.pow(" + to + "," + gap + from + ")";
  if (node.text == "?\?=")
    return fmt::format("{0} = ({0} !== null && {0} !== undefined ? {0} : {1}({2}))", to, gap, from);
  return fmt::format("{0} = {0} {1} {2}({3})", to, node.text.substr(0, 2), gap, from);
}

} // namespace dotek::frontend::fusion
