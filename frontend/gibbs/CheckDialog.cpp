// Controls of a dialog, definitions of DefineData.txt.
#include "frontend/gibbs/Check.h"
#include "frontend/gibbs/Unverified.h"
#include "support/WriteInstead.h"

#include <algorithm>

namespace dotek::frontend::gibbs {

namespace {

template <class Visit> void eachControl(const CheckedFile& input, const Visit& visit) {
  if (input.dialog == nullptr) return;
  for (const Control& control : input.dialog->controls)
    visit(control, foldCase(control.kind.text));
}

// The first control of the kind; nullptr: there is none.
const Control* firstOf(const CheckedFile& input, std::string_view kind) {
  for (const Control& control : input.dialog->controls)
    if (foldCase(control.kind.text) == kind) return &control;
  return nullptr;
}

// A dialog whose lines were all read: a broken one may have been the one that is missing.
bool isWhole(const CheckedFile& input) {
  return input.dialog != nullptr && !input.dialog->controls.empty() && !input.dialog->hasErrorNodes;
}

// Where what the whole dialog lacks is reported: at its DIALOG, else at its first control.
SourceRange headOf(const CheckedFile& input) {
  const Control* window = firstOf(input, "DIALOG");
  return (window != nullptr ? *window : input.dialog->controls.front()).kind.range;
}

} // namespace

void dialogNotFirst(const CheckedFile& input, Report& report) {
  if (!isWhole(input)) return;
  const Control* window = firstOf(input, "DIALOG");
  if (window == &input.dialog->controls.front()) return;
  report.at(headOf(input),
            "{}; GibbsCAM opens no window for what precedes it; write `DIALOG caption, left, top, "
            "width, height` "
            "on the first line",
            window == nullptr ? "the file has no line DIALOG" : "DIALOG is not the first line of the file");
}

void dialogWithoutOk(const CheckedFile& input, Report& report) {
  if (isWhole(input) && firstOf(input, "OK") == nullptr)
    report.at(headOf(input),
              "the dialog has no OK; the values cannot be taken over; add `OK left, top, width, height`");
}

void dialogWithoutCancel(const CheckedFile& input, Report& report) {
  if (isWhole(input) && firstOf(input, "CANCEL") == nullptr)
    report.at(headOf(input),
              "the dialog has no CANCEL; the user cannot leave it without taking the values over; add "
              "`CANCEL left, top, width, height`");
}

void controlTwice(const CheckedFile& input, Report& report) {
  eachControl(input, [&](const Control& control, const std::string& key) {
    if (key != "DIALOG" && key != "OK" && key != "CANCEL") return;
    const Control* first = firstOf(input, key);
    if (first != &control)
      report.at(control.kind.range, "`{}` appears twice; a dialog has one", control.kind.text)
          .note(first->kind.range, "the first one");
  });
}

void unknownControl(const CheckedFile& input, Report& report) {
  eachControl(input, [&](const Control& control, const std::string& key) {
    if (!input.keywords.dialogControls(key).empty() || input.keywords.isUnprovedControl(key)) return;
    if (report.full(input.file)) return;
    const std::string meant = input.keywords.nearestControl(key);
    report.at(control.kind.range, "no source knows a control `{}`{}", control.kind.text, didYouMean(meant))
        .fix = writeInstead(control.kind.range, meant);
  });
}

void variableTwice(const CheckedFile& input, Report& report) {
  std::map<std::string, SourceRange> inputs;
  eachControl(input, [&](const Control& control, const std::string& key) {
    // A button has a number, and buttons of a RADIO group share their variable.
    if (!control.variable || key == "BUTTON" || key == "RADIO") return;
    const auto [first, isNew] = inputs.try_emplace(foldCase(control.variable->text), control.variable->range);
    if (!isNew)
      report
          .at(control.variable->range,
              "two inputs write `{}`; the one that GibbsCAM stores last wins; give each a variable of its "
              "own",
              control.variable->text)
          .note(first->second, "the first one");
  });
}

void imageName(const CheckedFile& input, Report& report) {
  const std::string suffix = foldCase(fmt::format(".{}", input.keywords.imageSuffix()));
  eachControl(input, [&](const Control& control, const std::string& key) {
    if (key != "IMAGE" || control.arguments.size() < 5) return;
    const auto* file = std::get_if<TextLiteral>(&control.arguments[4]->node);
    if (file == nullptr) return;
    const SourceRange range = control.arguments[4]->range;
    const std::string shown = input.text({range.file, range.begin + 1, range.end - 1});
    const std::string name = foldCase(file->text);
    if (name.size() <= suffix.size() || !name.ends_with(suffix))
      report.at(range, "`{}` is no .bmp file; IMAGE shows nothing else; convert the picture", shown);
    else if (name.find(' ') != std::string::npos)
      report.at(range,
                "the file name `{}` holds a blank; GibbsCAM does not find the picture; rename the file",
                shown);
    else if (std::any_of(name.begin(), name.end(),
                         [](char c) { return static_cast<unsigned char>(c) > 127; }))
      report.at(
          range,
          "the file name `{}` holds a letter that is not ASCII; GibbsCAM does not find the picture; rename "
          "the file",
          shown);
  });
}

const Expression* looseCaptionOf(const Control& control) {
  if (foldCase(control.kind.text) != "FRAME" || control.arguments.size() != 5) return nullptr;
  const Expression& caption = *control.arguments[4];
  const auto* word = std::get_if<VariableRef>(&caption.node);
  const auto* text = std::get_if<TextLiteral>(&caption.node);
  const bool loose = (text != nullptr && text->quote == 0) || (word != nullptr && !word->name.isText());
  return loose ? &caption : nullptr;
}

void looseCaption(const CheckedFile& input, Report& report) {
  eachControl(input, [&](const Control& control, const std::string& key) {
    if (input.keywords.dialogControls(key).empty() || input.keywords.isUnprovedControl(key)) return;
    if (const Expression* caption = looseCaptionOf(control))
      report.at(caption->range, "the caption has no quotes; Dotek takes it as text; put it between quotes");
  });
}

// ---- DefineData.txt

void duplicateDefinition(const CheckedFile& input, Report& report) {
  if (input.defines == nullptr) return;
  std::map<std::string, SourceRange> names;
  for (const Definition& definition : input.defines->definitions) {
    const auto [first, isNew] = names.try_emplace(foldCase(definition.name.text), definition.name.range);
    if (!isNew)
      report
          .at(definition.name.range,
              "`{}` is defined twice; which value GibbsCAM takes is not known; remove one",
              definition.name.text)
          .note(first->second, "the first one");
  }
}

void fieldValue(const CheckedFile& input, Report& report) {
  if (input.defines == nullptr) return;
  for (const Definition& definition : input.defines->definitions) {
    const bool text =
        typeOf(*definition.value, input.keywords) == ValueType::Text || definition.name.isText();
    if (text || !definition.number)
      report.at(definition.valueRange,
                "the first value of `{}` is {}; sources show numbers only, so what GibbsCAM makes of it is "
                "unverified",
                definition.name.text, text ? "a text" : "computed");
  }
}

} // namespace dotek::frontend::gibbs
