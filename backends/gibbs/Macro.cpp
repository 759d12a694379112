#include "backends/gibbs/Macro.h"

#include "backends/common/ExpressionPrinter.h"
#include "backends/common/PlainText.h"
#include "ir/Walk.h"
#include "support/Ascii.h"
#include "support/Decimal.h"
#include "support/messages/CamFolder.h"

#include <algorithm>
#include <utility>

namespace dotek::backends::gibbs {

namespace {

constexpr std::size_t kLongestName = 32;
constexpr std::uint32_t kDepth = 50; // brackets inside one another; the language states no limit

bool isWord(std::string_view small) {
  constexpr std::string_view kWords[] = {"if",   "then",  "not",          "and", "or", "else", "goto", "for",
                                         "next", "to",    "step",         "x",   "y",  "z",    "proc", "op",
                                         "tool", "plane", "retract_plane"};
  return std::find(std::begin(kWords), std::end(kWords), small) != std::end(kWords);
}

std::string legal(std::string_view name) {
  std::string out;
  for (const char c : plainText(name).text) {
    const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    const bool digit = c >= '0' && c <= '9';
    if (out.empty() && !letter) out = "v";
    out += letter || digit ? c : '_';
  }
  if (out.empty()) out = "v";
  return out.substr(0, kLongestName);
}

std::string unused(const std::string& wanted, TakenNames& taken) {
  std::string out = wanted;
  int& next = taken.next.emplace(lowerCase(wanted), 2).first->second;
  while (!taken.names.insert(lowerCase(out)).second) {
    const std::string end = "_" + std::to_string(next++);
    out = wanted.substr(0, kLongestName - end.size()) + end;
  }
  return out;
}

class CamNotation final : public Notation {
public:
  std::string_view function(ir::UnaryOp op) const override {
    using Op = ir::UnaryOp;
    switch (op) {
    case Op::Absolute: return "abs";
    case Op::Truncate: return "int";
    case Op::SquareRoot: return "sqrt";
    case Op::Sine: return "sin";
    case Op::Cosine: return "cos";
    case Op::Tangent: return "tan";
    case Op::ArcSine: return "asin";
    case Op::ArcCosine: return "acos";
    case Op::ArcTangent: return "atan";
    case Op::Negate:
    case Op::RoundUp:
    case Op::Round:
    case Op::Logarithm:
    case Op::Exponential:
    case Op::NullAsZero:
    case Op::RoundIncrement:
    case Op::FromBcd:
    case Op::ToBcd:
    case Op::AddPoint: return "";
    }
    return "";
  }
  Infix infix(ir::BinaryOp op) const override {
    switch (op) {
    case ir::BinaryOp::Add: return {"+", kAdditive};
    case ir::BinaryOp::Subtract: return {"-", kAdditive};
    case ir::BinaryOp::Multiply: return {"*", kMultiplicative};
    case ir::BinaryOp::Divide: return {"/", kMultiplicative};
    case ir::BinaryOp::Modulo:
    case ir::BinaryOp::Direction:
    case ir::BinaryOp::BitAnd:
    case ir::BinaryOp::BitOr:
    case ir::BinaryOp::BitXor:
    case ir::BinaryOp::ValueOr:
    case ir::BinaryOp::RoundedAnd:
    case ir::BinaryOp::RoundedOr:
    case ir::BinaryOp::RoundedXor:
    case ir::BinaryOp::RoundedModulo:
    case ir::BinaryOp::Power:
    case ir::BinaryOp::Bearing: return {};
    }
    return {};
  }
  char open() const override { return '('; }
  char close() const override { return ')'; }
};

class Printer final : public ExpressionPrinter {
public:
  Printer(const Names& names, Diagnostics& diagnostics, const ir::Origin& origin, bool& failed)
      : ExpressionPrinter(kNotation), names_(names), diagnostics_(diagnostics), origin_(origin),
        failed_(failed) {}

protected:
  std::string leaf(const ir::ExpressionPtr& expression, std::uint32_t /*depth*/) override {
    if (const double* value = ir::constantValue(expression)) return numberText(*value);
    if (const auto* use = std::get_if<ir::VariableUse>(&expression->node)) return names_.of(use->variable);
    return refuse(expression, "what a control has measured or keeps");
  }
  std::string aside(const ir::ExpressionPtr& expression) override { return refuse(expression, "this"); }
  std::string operation(const ir::Binary& binary, const ir::ExpressionPtr& whole,
                        std::uint32_t depth) override {
    if (binary.op != ir::BinaryOp::Direction || depth < 1) return aside(whole);
    return "angle_line(" + print(binary.left, depth - 1) + ", " + print(binary.right, depth - 1) + ")";
  }

private:
  std::string refuse(const ir::ExpressionPtr& expression, std::string_view what) {
    failed_ = true;
    diagnostics_.report<diag::CamExpression>(
        expression->range.hasPlace() ? expression->range : origin_.range(), what);
    return "0";
  }

  static const CamNotation kNotation;
  const Names& names_;
  Diagnostics& diagnostics_;
  const ir::Origin& origin_;
  bool& failed_;
};
const CamNotation Printer::kNotation;

bool isOfAngles(const ir::Expression& node) {
  if (const auto* unary = std::get_if<ir::Unary>(&node.node))
    return unary->op >= ir::UnaryOp::Sine && unary->op <= ir::UnaryOp::ArcTangent;
  const auto* binary = std::get_if<ir::Binary>(&node.node);
  return binary != nullptr && binary->op == ir::BinaryOp::Direction;
}

std::string_view sign(ir::Relation relation) {
  switch (relation) {
  case ir::Relation::Same:
  case ir::Relation::Equal: return "=";
  case ir::Relation::Different:
  case ir::Relation::NotEqual: return "<>";
  case ir::Relation::Less: return "<";
  case ir::Relation::Greater: return ">";
  case ir::Relation::LessEqual: return "<=";
  case ir::Relation::GreaterEqual: return ">=";
  }
  return "=";
}

} // namespace

Names::Names(const ir::Cycle& cycle, Diagnostics& diagnostics) {
  for (const ir::Variable& variable : cycle.variables) {
    std::string name =
        legal(variable.role == ir::Role::Host && variable.name == "tool_radius" ? "radius" : variable.name);
    if (isWord(lowerCase(name)) && variable.name.size() > 1) name = legal(name + "_value");
    name = unused(name, taken_);
    if (name != variable.name && variable.role == ir::Role::Parameter)
      diagnostics.report<diag::CamNameChanged>(variable.range, variable.name, name,
                                               "the CAM takes it as another word, or not at all");
    names_.push_back(std::move(name));
  }
}

ir::VariableId Names::add(std::string_view wanted) {
  names_.push_back(fresh(wanted));
  return static_cast<ir::VariableId>(names_.size() - 1);
}

std::string Names::fresh(std::string_view wanted) {
  return unused(std::string(wanted), taken_);
}

std::string plain(std::string_view utf8, SourceRange range, Diagnostics& diagnostics) {
  const PlainText plainly = plainText(utf8);
  std::string out = plainly.text;
  std::replace(out.begin(), out.end(), '"', '\'');
  if (out != utf8) diagnostics.report<diag::CamTextPlain>(range, out);
  return out;
}

void MacroText::add(std::string text, const ir::Origin& origin) {
  std::vector<SourceRange> ranges = origin.ranges;
  std::erase_if(ranges, [](const SourceRange& range) { return !range.hasPlace(); });
  lines_.push_back({std::move(text), std::move(ranges), origin.reason});
}

std::string MacroText::expression(const ir::ExpressionPtr& value, const ir::Origin& origin) {
  ir::eachNode(value, [&](const ir::Expression& node) { turns_ = turns_ || isOfAngles(node); });
  return Printer(names_, diagnostics_, origin, failed_).print(value, kDepth);
}

void MacroText::assign(const std::string& name, const ir::ExpressionPtr& value, const ir::Origin& origin) {
  add(name + " = " + expression(value, origin), origin);
}

std::string MacroText::freshLabel(std::string_view wanted) {
  return unused(legal(wanted), taken_);
}

std::string MacroText::name(ir::LabelId label) {
  const auto found = labels_.find(label);
  if (found != labels_.end()) return found->second;
  return labels_.emplace(label, freshLabel(cycle_.labels[label].name)).first->second;
}

void MacroText::label(ir::LabelId label, const ir::Origin& origin) {
  add(":" + name(label), origin);
}

void MacroText::jump(ir::LabelId target, const ir::Origin& origin) {
  add("goto " + name(target), origin);
}

void MacroText::jumpIf(const ir::ConditionPtr& condition, ir::LabelId target, const ir::Origin& origin) {
  jumpIf(condition, name(target), origin);
}

void MacroText::jumpIf(const ir::ConditionPtr& condition, const std::string& target,
                       const ir::Origin& origin) {
  if (const auto* comparison = std::get_if<ir::Comparison>(&condition->node)) {
    const std::string left = expression(comparison->left, origin),
                      right = expression(comparison->right, origin);
    add("if " + left + " " + std::string(sign(comparison->relation)) + " " + right + " then goto " + target,
        origin);
    return;
  }
  if (const auto* truth = std::get_if<ir::Truth>(&condition->node)) {
    if (truth->value) add("goto " + target, origin);
    return;
  }
  if (const auto* junction = std::get_if<ir::Junction>(&condition->node)) {
    if (junction->op == ir::Connective::Or) {
      jumpIf(junction->left, target, origin);
      jumpIf(junction->right, target, origin);
      return;
    }
    const std::string over = freshLabel("next_check");
    jumpIf(ir::negate(junction->left), over, origin);
    jumpIf(junction->right, target, origin);
    add(":" + over, origin);
    return;
  }
  failed_ = true;
  diagnostics_.report<diag::CamExpression>(condition->range.hasPlace() ? condition->range : origin.range(),
                                           "whether a value was left out");
}

std::optional<ir::VariableId> findHost(const ir::Cycle& cycle, std::string_view name) {
  for (ir::VariableId id = 0; id < cycle.variables.size(); ++id)
    if (cycle.variable(id).role == ir::Role::Host && cycle.variable(id).name == name) return id;
  return std::nullopt;
}

void readRadius(MacroText& text, std::string_view family, std::string_view callback,
                const std::string& variable) {
  const std::string number = text.names().fresh("tool");
  text.add("get_" + std::string(family) + "_data " + std::string(callback) + ", TOOL_NUM, " + number);
  text.add("get_tool_data " + number + ", MTOOL_RADIUS, " + variable);
}

} // namespace dotek::backends::gibbs
