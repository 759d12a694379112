#include "backends/gibbs/TargetDialog.h"

#include "support/Decimal.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace dotek::targets {

namespace gibbs = backends::gibbs;

namespace {

using frontend::gibbs::foldCase;

std::string plainOf(std::string_view text) {
  Diagnostics ignored;
  return gibbs::plain(text, {}, ignored);
}

// As inputLabels() reads a name.
std::string withoutBlanks(std::string text) {
  std::erase_if(text, [](char c) { return c == ' ' || c == '\t'; });
  return text;
}

class DialogComparison {
public:
  DialogComparison(const frontend::gibbs::Dialog& dialog, const SourceMap& sources,
                   const std::map<std::string, gibbs::Field>& fields)
      : dialog_(dialog), sources_(sources), fields_(fields), labels_(inputLabels(dialog)) {}

  std::vector<std::string> run(const ChoiceLists& offered, const ChoiceLists& lists) {
    for (const auto& [name, own] : fields_) {
      const gibbs::Field& field = own; // clang 14 takes no binding into a lambda
      const auto label = std::find_if(labels_.begin(), labels_.end(), [&](const auto& one) {
        return foldCase(one.variable.text) == foldCase(field.name);
      });
      if (label == labels_.end()) {
        differs({}, fmt::format("no row asks for `{}`, which the source asks for", field.name));
        continue;
      }
      texts(*label, field);
      const auto list = lists.find(foldCase(name));
      choices(label->variable.range, field, list == lists.end() ? nullptr : &list->second, offered);
    }
    firstValues();
    return std::move(out_);
  }

private:
  void differs(SourceRange range, const std::string& text) {
    const std::string line = range.hasPlace() ? fmt::format(", line {}", sources_.line(range)) : "";
    out_.push_back(fmt::format("CycleData.dlg{}: {}", line, text));
  }

  // A text of another field misleads; other words may say the same.
  void texts(const frontend::gibbs::InputLabel& label, const gibbs::Field& own) {
    for (const auto& [name, other] : fields_) {
      if (other.name == own.name) continue;
      if (foldCase(label.name) == foldCase(withoutBlanks(other.name)) &&
          foldCase(label.name) != foldCase(withoutBlanks(own.name)))
        differs(label.nameRange, fmt::format("the name beside `{}` is that of `{}`", own.name, other.name));
      const std::string meaning = plainOf(other.meaning);
      if (!meaning.empty() && label.meaning == meaning && meaning != plainOf(own.meaning))
        differs(label.meaningRange,
                fmt::format("the text beside `{}` is that of `{}`: `{}`", own.name, other.name, meaning));
    }
    if (!label.unit.empty() && !own.unit.empty() && label.unit != plainOf(own.unit))
      differs(label.nameRange,
              fmt::format("`{}` is in {}, and counts {}", own.name, label.unit, plainOf(own.unit)));
  }

  // `list`: of the source; nullptr: that of convert, which offers systems by their names.
  void choices(SourceRange range, const gibbs::Field& field, const std::vector<DialogChoice>* list,
               const ChoiceLists& offered) {
    if (field.choices.empty()) return;
    const auto found = offered.find(foldCase(field.name));
    if (found == offered.end())
      return differs(range, fmt::format("`{}` is no list, as it is in the source", field.name));
    std::vector<DialogChoice> wanted;
    for (const gibbs::Choice& one : field.choices)
      wanted.push_back({one.value, one.title});
    if (list != nullptr) {
      // What convert leaves out it has said.
      const std::vector<DialogChoice> written = std::exchange(wanted, *list);
      std::erase_if(wanted, [&](const DialogChoice& one) { return named(written, one.value) == nullptr; });
    }
    for (const DialogChoice& choice : wanted) {
      const DialogChoice* const there = named(found->second, choice.value);
      const std::string value = numberText(choice.value), title = plainOf(choice.title);
      // A list may offer a value twice.
      if (std::any_of(found->second.begin(), found->second.end(), [&](const DialogChoice& one) {
            return one.value == choice.value && plainOf(one.title) == title;
          }))
        continue;
      if (there == nullptr)
        differs(range, fmt::format("the list of `{}` does not offer {}, `{}` of the source", field.name,
                                   value, title));
      else
        differs(range, fmt::format("the list of `{}` calls {} `{}` against `{}`, as the source has it",
                                   field.name, value, plainOf(there->title), title));
    }
    for (const DialogChoice& one : found->second)
      if (named(wanted, one.value) == nullptr)
        differs(range, fmt::format("the list of `{}` offers {}, which that of the source does not",
                                   field.name, numberText(one.value)));
  }

  static const DialogChoice* named(const std::vector<DialogChoice>& list, double value) {
    const auto at =
        std::find_if(list.begin(), list.end(), [&](const DialogChoice& one) { return one.value == value; });
    return at == list.end() ? nullptr : &*at;
  }

  // An input begins with the field that it writes.
  void firstValues() {
    std::vector<std::string> lists; // in the order of creation, which is their number
    for (const frontend::gibbs::Control& control : dialog_.controls) {
      const std::string kind = foldCase(control.kind.text);
      if (kind == "DROPDOWN_NEW") lists.push_back(control.variable ? control.variable->text : "");
      if (control.variable && control.initial != nullptr) shows(*control.initial, control.variable->text);
      if (kind != "DROPDOWN_VAL" || control.arguments.size() != 2) continue;
      const auto* number = std::get_if<frontend::gibbs::NumberLiteral>(&control.arguments[0]->node);
      if (number != nullptr && number->value >= 1 && number->value <= static_cast<double>(lists.size()))
        shows(*control.arguments[1], lists[static_cast<std::size_t>(number->value) - 1]);
    }
  }
  void shows(const frontend::gibbs::Expression& first, const std::string& field) {
    const auto* name = std::get_if<frontend::gibbs::VariableRef>(&first.node);
    const auto isField = [&](const auto& one) {
      return name != nullptr && foldCase(one.second.name) == foldCase(name->name.text);
    };
    if (name != nullptr && foldCase(name->name.text) != foldCase(field) &&
        std::any_of(fields_.begin(), fields_.end(), isField))
      differs(first.range,
              fmt::format("the input of `{}` begins with the value of `{}`", field, name->name.text));
  }

  const frontend::gibbs::Dialog& dialog_;
  const SourceMap& sources_;
  const std::map<std::string, gibbs::Field>& fields_;
  const std::vector<frontend::gibbs::InputLabel> labels_;
  std::vector<std::string> out_;
};

} // namespace

std::vector<std::string> dialogDifferences(const project::CycleFolder& folder, const SourceMap& sources,
                                           const std::map<std::string, gibbs::Field>& fields,
                                           const ChoiceLists& lists) {
  if (folder.cycle == nullptr || !folder.cycle->dialog) return {};
  return DialogComparison(*folder.cycle->dialog, sources, fields).run(dialogChoices(folder, sources), lists);
}

} // namespace dotek::targets
