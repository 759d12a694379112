#include "frontend/gibbs/Match.h"

#include "frontend/gibbs/Unverified.h"

#include <algorithm>

namespace dotek::frontend::gibbs {

using stdlib::ArgumentSpec;
using stdlib::CommandSignature;

namespace {

const ArgumentSpec* specAt(const CommandSignature& signature, std::size_t index) {
  std::size_t first = 0;
  for (const ArgumentSpec& spec : signature.arguments) {
    if (spec.repeat == stdlib::kNoBound || index < first + spec.repeat) return &spec;
    first += spec.repeat;
  }
  return nullptr;
}

class Matcher {
public:
  Matcher(const CommandSignature& signature, const std::vector<ExpressionPtr>& arguments,
          const stdlib::GibbsKeywords& keywords, const SourceMap& sources)
      : signature_(signature), arguments_(arguments), keywords_(keywords), sources_(sources) {}

  Match run() {
    match_.signature = &signature_;
    for (std::size_t i = 0; i < arguments_.size(); ++i) {
      match_.specs.push_back(specAt(signature_, i));
      if (match_.specs.back() != nullptr) check(*match_.specs.back(), i);
    }
    const ArgumentCount count = countOf(signature_);
    if (arguments_.size() < count.least || (count.most != stdlib::kNoBound && arguments_.size() > count.most))
      match_.misfits.insert(match_.misfits.begin(),
                            {Misfit::Kind::Count, std::min<std::size_t>(arguments_.size(), count.most)});
    return std::move(match_);
  }

private:
  void add(Misfit::Kind kind, std::size_t argument) { match_.misfits.push_back({kind, argument}); }

  void check(const ArgumentSpec& spec, std::size_t i) {
    const Expression& argument = *arguments_[i];
    switch (spec.kind) {
    case ArgumentSpec::Kind::Choice: {
      const std::string word = keywordText(argument, sources_);
      if (std::find(spec.keywords.begin(), spec.keywords.end(), word) == spec.keywords.end())
        add(Misfit::Kind::Choice, i);
      return;
    }
    case ArgumentSpec::Kind::Parameter: {
      const std::string word = keywordText(argument, sources_);
      parameter_ = keywords_.parameterKind(spec.family, word);
      if (!keywords_.isParameter(spec.family, word)) add(Misfit::Kind::Parameter, i);
      return;
    }
    case ArgumentSpec::Kind::Result:
    case ArgumentSpec::Kind::ReadWrite:
      if (!std::holds_alternative<VariableRef>(argument.node)) return add(Misfit::Kind::Variable, i);
      break;
    case ArgumentSpec::Kind::Value: break;
    }
    if (spec.array && !std::holds_alternative<VariableRef>(argument.node)) return add(Misfit::Kind::Array, i);
    checkType(spec, argument, i);
  }

  void checkType(const ArgumentSpec& spec, const Expression& argument, std::size_t i) {
    const bool text = typeOf(argument, keywords_) == ValueType::Text;
    bool wantsText = spec.type == ArgumentSpec::Type::Text;
    if (spec.type == ArgumentSpec::Type::ByParameter) {
      if (!parameter_ ||
          (*parameter_ != stdlib::ParameterKind::Number && *parameter_ != stdlib::ParameterKind::Text))
        return;
      wantsText = *parameter_ == stdlib::ParameterKind::Text;
    }
    if (text != wantsText) add(wantsText ? Misfit::Kind::Text : Misfit::Kind::Number, i);
  }

  const CommandSignature& signature_;
  const std::vector<ExpressionPtr>& arguments_;
  const stdlib::GibbsKeywords& keywords_;
  const SourceMap& sources_;
  std::optional<stdlib::ParameterKind> parameter_;
  Match match_;
};

// Smaller fits better: a keyword decides more than a count, a count more than a kind.
std::size_t badness(const Match& match) {
  std::size_t sum = 0;
  for (const Misfit& misfit : match.misfits)
    sum += misfit.kind == Misfit::Kind::Choice ? 100 : misfit.kind == Misfit::Kind::Count ? 10 : 1;
  return sum;
}

} // namespace

ArgumentCount countOf(const CommandSignature& signature) {
  ArgumentCount count;
  for (const ArgumentSpec& spec : signature.arguments) {
    if (!spec.optional) ++count.least;
    if (spec.repeat == stdlib::kNoBound || count.most == stdlib::kNoBound)
      count.most = stdlib::kNoBound;
    else
      count.most += spec.repeat;
  }
  return count;
}

std::string keywordText(const Expression& argument, const SourceMap& sources) {
  std::string word;
  for (const char c : sources.text(argument.range))
    if (c != ' ' && c != '\t' && c != '\f' && c != '\v') word += c;
  return foldCase(word);
}

std::string signatureText(const CommandSignature& signature) {
  std::string text = signature.name;
  std::string closing;
  for (std::size_t i = 0; i < signature.arguments.size(); ++i) {
    const ArgumentSpec& spec = signature.arguments[i];
    text += spec.optional ? " [" : i == 0 ? " " : "";
    if (i > 0) text += ", ";
    if (spec.optional) closing += "]";
    if (spec.kind == ArgumentSpec::Kind::Choice) {
      for (std::size_t k = 0; k < spec.keywords.size(); ++k)
        text += (k == 0 ? "" : " or ") + spec.keywords[k];
    } else {
      text += spec.kind == ArgumentSpec::Kind::Parameter ? "PARAMETER" : spec.name;
      if (spec.type == ArgumentSpec::Type::Text && (text.empty() || text.back() != '$')) text += "$";
    }
    if (spec.repeat > 1) text += ", ...";
  }
  return text + closing;
}

Match matchArguments(const std::vector<const CommandSignature*>& signatures,
                     const std::vector<ExpressionPtr>& arguments, const stdlib::GibbsKeywords& keywords,
                     const SourceMap& sources) {
  Match best;
  best.specs.resize(arguments.size(), nullptr);
  for (const CommandSignature* signature : signatures) {
    Match match = Matcher(*signature, arguments, keywords, sources).run();
    if (best.signature == nullptr || badness(match) < badness(best)) best = std::move(match);
  }
  return best;
}

} // namespace dotek::frontend::gibbs
