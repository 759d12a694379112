#include "frontend/gibbs/Blame.h"

#include "frontend/gibbs/Walk.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace dotek::frontend::gibbs {
namespace {

using Values = std::map<std::string, double>;

constexpr double kUsual[] = {0, 1, -1, 5, -5, 10, -10, 20, -20, 56, 100, -100, 500, -500};
constexpr std::size_t kMostValues = 60;     // tried for one field
constexpr std::size_t kMostFields = 8;      // among so many, pairs are tried
constexpr std::uint32_t kMostSteps = 20000; // of one run; checks of a dialog take some dozens

class Search {
public:
  Search(const Macro& cycleData, const std::vector<const Macro*>& others, const RunContext& context,
         const std::set<std::string>& candidates)
      : cycleData_(cycleData), context_(context), limits_(context.limits) {
    limits_.steps = std::min(limits_.steps, kMostSteps);
    for (const auto& [name, value] : context.fields)
      if (candidates.empty() || candidates.contains(name)) fields_.push_back(name);
    collectValues(others);
  }

  std::vector<std::string> run() const {
    std::vector<std::string> out;
    for (const std::string& field : fields_)
      if (passesWith(context_.fields, field)) out.push_back(field);
    if (!out.empty() || fields_.size() > kMostFields) return out;
    for (std::size_t one = 0; one < fields_.size(); ++one)
      for (const double value : values_) {
        Values changed = context_.fields;
        changed[fields_[one]] = value;
        for (std::size_t two = one + 1; two < fields_.size(); ++two)
          if (const auto other = passesWith(changed, fields_[two]))
            return behindFirst({fields_[one], value}, {fields_[two], *other});
      }
    return out;
  }

private:
  using Cured = std::pair<std::string, double>; // a field and a value for it

  // Two values that are wrong each for itself: the message is that of the one whose change takes it away.
  std::vector<std::string> behindFirst(const Cured& one, const Cured& two) const {
    const auto first = firstRejection(context_.fields);
    const auto moved = [&](const Cured& cured) {
      Values fields = context_.fields;
      fields[cured.first] = cured.second;
      return firstRejection(fields) != first;
    };
    const bool byOne = moved(one), byTwo = moved(two);
    if (byOne == byTwo) return {one.first, two.first};
    return {byOne ? one.first : two.first};
  }
  std::optional<std::pair<FileId, std::uint32_t>> firstRejection(const Values& fields) const {
    const ChecksResult result = run(fields);
    if (result.rejections.empty()) return std::nullopt;
    const SourceRange range = result.rejections.front().range;
    return std::pair(range.file, range.begin);
  }

  // Another message in the place of the first shows nothing: the new value may be what it complains of.
  std::optional<double> passesWith(Values fields, const std::string& field) const {
    for (const double value : values_) {
      fields[field] = value;
      const auto verdict = run(fields).verdict;
      if (verdict == ChecksResult::Verdict::NotRun) return std::nullopt;
      if (verdict != ChecksResult::Verdict::Rejected) return value;
    }
    return std::nullopt;
  }

  ChecksResult run(const Values& fields) const {
    Diagnostics ignored;
    RunContext context{
        context_.sources, context_.keywords,  limits_, ignored, fields, context_.hosts, context_.assumptions,
        context_.load,    context_.loadDialog};
    return runChecks(cycleData_, context);
  }

  // Usual values, and those around the bounds that the macros state and around the other fields.
  void collectValues(const std::vector<const Macro*>& others) {
    std::set<double> all;
    const auto around = [&](double value) {
      for (const double step : {-1.0, 0.0, 1.0})
        all.insert(value + step);
    };
    const auto constantsOf = [&](const Macro& macro) {
      walkLines(macro.lines, [&](const Statement& statement) {
        ownExpressions(statement, [&](const Expression& expression) {
          walkExpression(expression, [&](const Expression& each) {
            if (const auto* number = std::get_if<NumberLiteral>(&each.node)) around(number->value);
          });
        });
      });
    };
    constantsOf(cycleData_);
    for (const Macro* other : others)
      constantsOf(*other);
    for (const auto& [name, value] : context_.fields)
      around(value);
    values_.assign(std::begin(kUsual), std::end(kUsual));
    for (const double value : all)
      if (values_.size() < kMostValues && std::find(values_.begin(), values_.end(), value) == values_.end())
        values_.push_back(value);
  }

  const Macro& cycleData_;
  const RunContext& context_;
  Limits limits_;
  std::vector<std::string> fields_;
  std::vector<double> values_;
};

} // namespace

std::vector<std::string> fieldsToBlame(const Macro& cycleData, const std::vector<const Macro*>& others,
                                       const RunContext& context, const std::set<std::string>& candidates) {
  return Search(cycleData, others, context, candidates).run();
}

} // namespace dotek::frontend::gibbs
