#include "project/Fields.h"

#include "frontend/gibbs/Assumptions.h"
#include "frontend/gibbs/Labels.h"
#include "support/Decimal.h"
#include "support/NearestName.h"
#include "support/messages/Commands.h"
#include "support/messages/Gibbs.h"

#include <algorithm>
#include <numeric>

namespace dotek::project {

namespace gibbs = frontend::gibbs;

FieldTable::FieldTable(const CycleFolder& folder, std::vector<std::string> printed, Session& session)
    : folder_(folder), session_(session), printed_(std::move(printed)) {
  for (const gibbs::Field& field : gibbs::declaredFields(*folder.cycle))
    entries_.push_back(
        {field.name.text, gibbs::foldCase(field.name.text), field.value, field.valueRange, field.assumption});
  auto byName = std::make_shared<std::vector<std::size_t>>(entries_.size());
  std::iota(byName->begin(), byName->end(), 0);
  std::stable_sort(byName->begin(), byName->end(),
                   [&](std::size_t a, std::size_t b) { return entries_[a].folded < entries_[b].folded; });
  byName_ = std::move(byName);
}

const FieldTable::Entry* FieldTable::declared(const std::string& name) const {
  const std::string folded = gibbs::foldCase(name);
  const auto found =
      std::lower_bound(byName_->begin(), byName_->end(), folded,
                       [&](std::size_t i, const std::string& wanted) { return entries_[i].folded < wanted; });
  return found == byName_->end() || entries_[*found].folded != folded ? nullptr : &entries_[*found];
}

FieldTable::Entry* FieldTable::declared(const std::string& name) {
  return const_cast<Entry*>(std::as_const(*this).declared(name));
}

bool FieldTable::set(const std::string& name, double value, SourceRange where) {
  if (Entry* entry = declared(name)) {
    entry->value = value;
    entry->assumption = {};
    return true;
  }
  if (std::find(printed_.begin(), printed_.end(), name) == printed_.end()) return false;
  postOnly_.insert_or_assign(name, value);
  session_.diagnostics().report<diag::SetKnownToPostOnly>(where, name, folder_.name);
  return true;
}

bool FieldTable::knows(const std::string& postField, const std::string& variable) const {
  return std::find(printed_.begin(), printed_.end(), postField) != printed_.end() && declares(variable) &&
         (!declares(postField) || declared(postField) == declared(variable));
}

bool FieldTable::map(const std::string& postField, const std::string& variable) {
  if (std::find(printed_.begin(), printed_.end(), postField) == printed_.end()) {
    const std::string near = nearestName(postField, printed_);
    session_.diagnostics().report<diag::UnknownName>({}, "--field", postField,
                                                     "field that the post prints for `" + folder_.name + "`",
                                                     near.empty() ? "" : "; did you mean `" + near + "`?");
    return false;
  }
  const Entry* entry = declared(variable);
  if (entry == nullptr) {
    std::vector<std::string> names;
    for (const Entry& e : entries_)
      names.push_back(e.name);
    const std::string near = nearestName(variable, names);
    session_.diagnostics().report<diag::UnknownName>({}, "--field", variable,
                                                     "variable of the macro `" + folder_.name + "`",
                                                     near.empty() ? "" : "; did you mean `" + near + "`?");
    return false;
  }
  if (const Entry* own = declared(postField); own != nullptr && own != entry)
    session_.diagnostics().report<diag::FieldPassedOver>({}, postField, entry->name, folder_.name);
  const auto& sets = session_.options().set;
  if (postOnly_.contains(postField) &&
      std::any_of(sets.begin(), sets.end(), [&](const auto& given) { return given.first == postField; })) {
    session_.diagnostics().report<diag::GivenTwice>({}, "--field beside --set", postField);
    return false;
  }
  if (!mapped_.emplace(postField, entry->name).second) {
    session_.diagnostics().report<diag::GivenTwice>({}, "--field", postField);
    return false;
  }
  return true;
}

bool FieldTable::mapGiven(bool several, std::set<std::string>& used) {
  bool good = true;
  const CommonOptions& options = session_.options();
  for (const auto& [postField, variable] : options.field) {
    if (several && !knows(postField, variable)) continue;
    used.insert(postField + "=" + variable);
    good = map(postField, variable) && good;
  }
  for (const auto& [postField, variable] : options.projectField)
    if (knows(postField, variable) && !mapped_.contains(postField) && !postOnly_.contains(postField))
      mapped_.emplace(postField, declared(variable)->name);
  return good;
}

bool FieldTable::certain() const {
  bool all = true;
  for (const Entry& entry : entries_) {
    if (!entry.value && !entry.name.ends_with('$')) {
      session_.diagnostics().report<diag::FieldWithoutValue>(entry.valueRange, entry.name, folder_.name);
      all = false;
    } else if (!entry.assumption.empty() &&
               !session_.options().assume.contains(std::string(entry.assumption))) {
      const gibbs::Assumption* reading = gibbs::findAssumption(entry.assumption);
      session_.diagnostics().report<diag::UnverifiedConstructRun>(
          entry.valueRange, reading != nullptr ? reading->construct : "the value", entry.assumption);
      all = false;
    }
  }
  return all;
}

std::string FieldTable::hint(const std::string& name) const {
  std::vector<std::string> names;
  for (const Entry& entry : entries_)
    names.push_back(entry.name);
  for (const std::string& field : printed_) {
    if (std::find(names.begin(), names.end(), field) == names.end()) names.push_back(field);
  }
  if (const std::string near = nearestName(name, names); !near.empty())
    return "; did you mean `" + near + "`?";
  constexpr std::size_t kMost = 20;
  std::string known;
  for (std::size_t i = 0; i < std::min(names.size(), kMost); ++i)
    known += (known.empty() ? "`" : ", `") + names[i] + "`";
  if (names.size() > kMost) known += " and others";
  return known.empty() ? "" : "; known: " + known;
}

// The remedy for a field that no file declares: the variable whose input the dialog labels with its name.
std::string FieldTable::proposal(const std::string& name) const {
  std::vector<std::string> variables;
  if (folder_.cycle->dialog) {
    for (const gibbs::InputLabel& label : gibbs::inputLabels(*folder_.cycle->dialog)) {
      const std::string& variable = label.variable.text;
      if (label.name != name || gibbs::foldCase(variable) == gibbs::foldCase(name)) continue;
      if (std::find(variables.begin(), variables.end(), variable) == variables.end())
        variables.push_back(variable);
    }
  }
  std::vector<std::string> declaredNames;
  for (const Entry& entry : entries_)
    declaredNames.push_back(entry.name);
  if (const std::string near = nearestName(name, declaredNames); variables.empty() && !near.empty())
    return fmt::format(
        "did you mean `{1}`? else give `--field {0}={1}`, which prints that, or `--set {0}=VALUE`", name,
        near);
  if (variables.empty())
    return fmt::format("give `--set {}=VALUE`, or `--field {}=VARIABLE` with a variable of the macro", name,
                       name);
  std::string flags;
  std::string inputs;
  for (const std::string& variable : variables) {
    flags += fmt::format("`--field {}={}`{}", name, variable, variables.size() > 1 ? " or " : " ");
    inputs += fmt::format("{}`{}`", inputs.empty() ? "" : " and of ", variable);
  }
  if (variables.size() > 1) flags.resize(flags.size() - 3);
  return fmt::format("give {}(the dialog labels the input of {} with `{}`) or `--set {}=VALUE`", flags,
                     inputs, name, name);
}

std::optional<FieldOrigin> FieldTable::origin(const std::string& name, SourceRange where) {
  Diagnostics& diagnostics = session_.diagnostics();
  const auto mapped = mapped_.find(name);
  const std::string wanted = mapped == mapped_.end() ? name : mapped->second;
  if (mapped == mapped_.end()) {
    if (const auto given = postOnly_.find(name); given != postOnly_.end())
      return FieldOrigin{"", given->second};
  }
  if (const Entry* entry = declared(wanted)) {
    if (entry->name != wanted && told_.insert(name).second)
      diagnostics.report<diag::FieldCase>(where, name, entry->name, folder_.name);
    return FieldOrigin{entry->name, std::nullopt};
  }
  const bool zero = session_.options().assume.contains("missing-field-zero");
  const std::optional<FieldOrigin> nothing =
      zero ? std::optional(FieldOrigin{"", 0.0}) : std::optional<FieldOrigin>();
  if (!told_.insert(name).second) return nothing;
  const std::string defineData = folder_.cycle->defineData
                                     ? session_.sources().file(folder_.cycle->defineData->file).name()
                                     : folder_.name;
  if (zero) {
    diagnostics.report<diag::MissingFieldZero>(where, name, defineData);
    return nothing;
  }
  Diagnostic& missing = diagnostics.report<diag::MissingField>(
      where, name, session_.sources().file(where.file).name(), defineData, proposal(name));
  for (const auto& [postField, variable] : session_.options().projectField)
    if (postField == name)
      missing.note({}, "dotek.toml names `" + variable + "` for it, which the macro does not declare");
  if (folder_.cycle->defineData) {
    std::string names;
    for (const Entry& entry : entries_)
      names += (names.empty() ? "`" : ", `") + entry.name + "`";
    missing.note({folder_.cycle->defineData->file, 0, 0},
                 "the macro declares " + (names.empty() ? "nothing" : names));
  }
  return nothing;
}

std::optional<double> FieldTable::value(const std::string& name, SourceRange where) {
  const std::optional<FieldOrigin> from = origin(name, where);
  if (!from || from->number) return from ? from->number : std::nullopt;
  const Entry* entry = declared(from->variable);
  if (!entry->value && told_.insert(entry->name).second)
    session_.diagnostics().report<diag::FieldWithoutValue>(where, entry->name, folder_.name);
  return entry->value;
}

std::map<std::string, double> FieldTable::macroValues() const {
  std::map<std::string, double> out;
  for (const std::size_t i : *byName_)
    if (entries_[i].value) out.emplace_hint(out.end(), entries_[i].folded, *entries_[i].value);
  return out;
}

void FieldTable::change(const std::string& folded, double value) {
  for (Entry& entry : entries_) {
    if (entry.folded == folded) entry.value = value;
  }
}

} // namespace dotek::project
