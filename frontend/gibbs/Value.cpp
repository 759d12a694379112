#include "frontend/gibbs/Value.h"

#include "support/Decimal.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace dotek::frontend::gibbs {
namespace {

constexpr std::size_t kMaxTerms = 8;

// terms += factor * value's terms; the constant part is returned.
double addTerms(std::map<Symbol, double>& terms, const Value& value, double factor) {
  if (const double* number = std::get_if<double>(&value)) return *number * factor;
  const Unknown* unknown = unknownIn(value);
  if (unknown == nullptr) return 0;
  for (const auto& [symbol, own] : unknown->terms) {
    double& sum = terms[symbol];
    sum += own * factor;
    if (sum == 0) terms.erase(symbol);
  }
  return unknown->constant * factor;
}

void append(std::string& text, const Symbol& symbol) {
  switch (symbol.kind) {
  case Symbol::Kind::Fresh: text += fmt::format("?{}", symbol.number); return;
  case Symbol::Kind::Place: text += fmt::format("?{}:{}", symbol.number, symbol.part); return;
  case Symbol::Kind::Derived: text += fmt::format("={}", symbol.number); return;
  case Symbol::Kind::Named:
  case Symbol::Kind::Host: text += symbol.name; return;
  case Symbol::Kind::Variable: text += fmt::format("v{}", symbol.number); return;
  case Symbol::Kind::Widened: text += fmt::format("w{}:{}", symbol.number, symbol.part); return;
  }
}

std::string termsText(const std::map<Symbol, double>& terms, double scale) {
  std::string text;
  for (const auto& [symbol, factor] : terms) {
    if (!text.empty()) text += " + ";
    if (factor / scale != 1) text += numberText(factor / scale) + "*";
    append(text, symbol);
  }
  return text;
}

void appendBytes(std::string& bytes, double number) {
  const double plain = number == 0 ? 0.0 : number; // no -0
  bytes.append(reinterpret_cast<const char*>(&plain), sizeof plain);
}
void appendBytes(std::string& bytes, std::size_t number) {
  bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
}

Relation mirrored(Relation relation) {
  switch (relation) {
  case Relation::Less: return Relation::Greater;
  case Relation::Greater: return Relation::Less;
  case Relation::LessEqual: return Relation::GreaterEqual;
  case Relation::GreaterEqual: return Relation::LessEqual;
  case Relation::Equal:
  case Relation::NotEqual: return relation;
  }
  return relation;
}

} // namespace

const Unknown* unknownIn(const Value& value) {
  const UnknownPtr* pointer = std::get_if<UnknownPtr>(&value);
  return pointer != nullptr ? pointer->get() : nullptr;
}

bool isTextValue(const Value& value) {
  const Unknown* unknown = unknownIn(value);
  return unknown != nullptr ? unknown->text : std::holds_alternative<std::string>(value);
}

const double* numberIn(const Value& value) {
  const auto* expression = std::get_if<ir::ExpressionPtr>(&value);
  return expression != nullptr ? ir::constantValue(*expression) : std::get_if<double>(&value);
}

Value sourceValue(const Symbol& symbol) {
  return opaqueValue(symbol, {symbol}, symbol.name, false);
}

Value opaqueValue(const Symbol& symbol, std::set<Symbol> sources, std::string reason, bool text) {
  return std::make_shared<const Unknown>(
      Unknown{{{symbol, 1.0}}, 0, std::move(sources), std::move(reason), text});
}

const Symbol* symbolIn(const Value& value) {
  const Unknown* unknown = unknownIn(value);
  const bool alone = unknown != nullptr && !unknown->text && unknown->constant == 0 &&
                     unknown->terms.size() == 1 && unknown->terms.begin()->second == 1;
  return alone ? &unknown->terms.begin()->first : nullptr;
}

double factorOf(const Symbol& symbol, const Value& value) {
  const Unknown* unknown = unknownIn(value);
  if (unknown == nullptr) return 0;
  const auto term = unknown->terms.find(symbol);
  return term == unknown->terms.end() ? 0 : term->second;
}

std::string canonical(const Value& value) {
  if (const double* number = std::get_if<double>(&value)) return numberText(*number);
  if (const std::string* text = std::get_if<std::string>(&value)) return '"' + *text + '"';
  if (unknownIn(value) == nullptr) return "";
  const Unknown& unknown = *unknownIn(value);
  std::string text = termsText(unknown.terms, 1);
  if (unknown.constant != 0) text += " + " + numberText(unknown.constant);
  return text;
}

void appendKey(std::string& bytes, const Value& value) {
  bytes += static_cast<char>(value.index());
  if (const double* number = std::get_if<double>(&value)) appendBytes(bytes, *number);
  if (const std::string* text = std::get_if<std::string>(&value)) bytes += *text;
  const Unknown* unknown = unknownIn(value);
  if (unknown == nullptr) return;
  appendBytes(bytes, unknown->constant);
  for (const auto& [symbol, factor] : unknown->terms) {
    appendBytes(bytes, factor);
    bytes += static_cast<char>(symbol.kind);
    appendBytes(bytes, symbol.number);
    appendBytes(bytes, symbol.part);
    appendBytes(bytes, symbol.name.size());
    bytes += symbol.name;
  }
}

std::optional<Value> linear(const Value& a, double factorA, const Value& b, double factorB) {
  Unknown sum;
  const double partA = addTerms(sum.terms, a, factorA);
  sum.constant = partA + addTerms(sum.terms, b, factorB);
  if (!std::isfinite(sum.constant)) return std::nullopt;
  for (const auto& [symbol, factor] : sum.terms) {
    if (!std::isfinite(factor)) return std::nullopt;
  }
  if (sum.terms.empty()) return Value(sum.constant == 0 ? 0.0 : sum.constant);
  if (sum.terms.size() > kMaxTerms) return std::nullopt;
  sum.sources = sourcesOf({a, b});
  for (const Value* part : {&a, &b}) {
    const Unknown* unknown = unknownIn(*part);
    if (unknown != nullptr && (sum.reason.empty() || sum.sources.empty())) sum.reason = unknown->reason;
  }
  return Value(std::make_shared<const Unknown>(std::move(sum)));
}

Combined combine(ir::BinaryOp op, const Value& left, const Value& right) {
  const double* a = std::get_if<double>(&left);
  const double* b = std::get_if<double>(&right);
  const bool both = a != nullptr && b != nullptr;
  const auto known = [](const ir::Computed& result) {
    return result.ok() ? Combined{Value(result.value)} : Combined{{}, result.error};
  };
  switch (op) {
  case ir::BinaryOp::Add:
    if (both) return known(ir::add(*a, *b));
    return {linear(left, 1, right, 1)};
  case ir::BinaryOp::Subtract:
    if (both) return known(ir::subtract(*a, *b));
    return {linear(left, 1, right, -1)};
  case ir::BinaryOp::Multiply:
    if (both) return known(ir::multiply(*a, *b));
    if (a != nullptr) return {linear(right, *a, 0.0, 0)};
    if (b != nullptr) return {linear(left, *b, 0.0, 0)};
    return {};
  case ir::BinaryOp::Divide:
    if (both || (b != nullptr && *b == 0)) return known(ir::divide(a != nullptr ? *a : 1, *b));
    if (b != nullptr) return {linear(left, 1 / *b, 0.0, 0)};
    return {};
  case ir::BinaryOp::Direction:
    if (both) return known(ir::direction(*a, *b, ir::AngleUnit::Degrees));
    return {};
  case ir::BinaryOp::Modulo:
  case ir::BinaryOp::BitAnd:
  case ir::BinaryOp::BitOr:
  case ir::BinaryOp::BitXor:
  case ir::BinaryOp::ValueOr:
  case ir::BinaryOp::RoundedAnd:
  case ir::BinaryOp::RoundedOr:
  case ir::BinaryOp::RoundedXor:
  case ir::BinaryOp::RoundedModulo:
  case ir::BinaryOp::Power:
  case ir::BinaryOp::Bearing: return {}; // no macro of the CAM has these
  }
  return {};
}

std::set<Symbol> sourcesOf(const std::vector<Value>& values) {
  std::set<Symbol> sources;
  for (const Value& value : values) {
    const Unknown* unknown = unknownIn(value);
    if (unknown != nullptr) sources.insert(unknown->sources.begin(), unknown->sources.end());
  }
  return sources;
}

const std::string& unknownText(const Unknown& unknown) {
  return unknown.sources.empty() ? unknown.reason : unknown.sources.begin()->name;
}

Relation opposite(Relation relation) {
  switch (relation) {
  case Relation::Equal: return Relation::NotEqual;
  case Relation::NotEqual: return Relation::Equal;
  case Relation::Less: return Relation::GreaterEqual;
  case Relation::Greater: return Relation::LessEqual;
  case Relation::LessEqual: return Relation::Greater;
  case Relation::GreaterEqual: return Relation::Less;
  }
  return relation;
}

bool holds(double left, Relation relation, double right) {
  switch (relation) {
  case Relation::Equal: return left == right;
  case Relation::NotEqual: return left != right;
  case Relation::Less: return left < right;
  case Relation::Greater: return left > right;
  case Relation::LessEqual: return left <= right;
  case Relation::GreaterEqual: return left >= right;
  }
  return false;
}

void Range::Bounds::narrow(Relation relation, double bound) {
  const bool fromBelow =
      relation == Relation::Greater || relation == Relation::GreaterEqual || relation == Relation::Equal;
  const bool fromAbove =
      relation == Relation::Less || relation == Relation::LessEqual || relation == Relation::Equal;
  const bool open = relation == Relation::Less || relation == Relation::Greater;
  if (fromBelow && (!low || bound > *low || (bound == *low && open))) {
    low = bound;
    lowOpen = open;
  }
  if (fromAbove && (!high || bound < *high || (bound == *high && open))) {
    high = bound;
    highOpen = open;
  }
}

bool Range::leaves(const Bounds& bounds, std::optional<double> except) const {
  if (!bounds.low || !bounds.high || *bounds.low < *bounds.high) return true;
  return *bounds.low == *bounds.high && !bounds.lowOpen && !bounds.highOpen && except != bounds.low &&
         !std::binary_search(excluded_.begin(), excluded_.end(), *bounds.low);
}

bool Range::restrict(Relation relation, double bound) {
  if (relation == Relation::NotEqual) {
    const auto place = std::lower_bound(excluded_.begin(), excluded_.end(), bound);
    if (place == excluded_.end() || *place != bound) excluded_.insert(place, bound);
  }
  bounds_.narrow(relation, bound);
  const bool left = leaves(bounds_, std::nullopt);
  // Of one value nothing can be left out any more.
  if (left && bounds_.low && bounds_.low == bounds_.high) excluded_ = {};
  return left;
}

bool Range::allows(Relation relation, double bound) const {
  if (relation == Relation::NotEqual) return leaves(bounds_, bound);
  Bounds bounds = bounds_;
  bounds.narrow(relation, bound);
  return leaves(bounds, std::nullopt);
}

std::optional<bool> Range::answer(Relation relation, double bound) const {
  if (!allows(opposite(relation), bound)) return true;
  if (!allows(relation, bound)) return false;
  return std::nullopt;
}

Question questionOf(const Unknown& difference, Relation relation, SourceRange range) {
  const double scale = difference.terms.begin()->second;
  const double bound = difference.constant == 0 ? 0.0 : -difference.constant / scale;
  return {termsText(difference.terms, scale),
          scale < 0 ? mirrored(relation) : relation,
          bound,
          difference.sources,
          difference.reason,
          range};
}

} // namespace dotek::frontend::gibbs
