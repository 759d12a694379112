#include "frontend/gibbs/CheckCommand.h"
#include "frontend/gibbs/Unverified.h"
#include "frontend/gibbs/Walk.h"
#include "support/messages/Gibbs.h"

#include <map>

namespace dotek::frontend::gibbs {

namespace {

// Notes of constructs that a dialog or DefineData.txt shares with macros.
class Notes {
public:
  explicit Notes(const ParseContext& context) : context_(context) {}

  void add(const Expression& expression) {
    for (const Unverified& found : unverifiedIn(expression, context_.keywords)) {
      if (found.assumption == "loose-caption" || !noted_.insert(found.assumption).second) continue;
      const Assumption* assumption = findAssumption(found.assumption);
      context_.diagnostics.report<diag::UnverifiedConstruct>(found.range, assumption->construct,
                                                             assumption->reading, assumption->id);
    }
  }

private:
  const ParseContext& context_;
  std::set<std::string_view> noted_;
};

class DialogCheck {
public:
  DialogCheck(const Dialog& dialog, const ParseContext& context)
      : dialog_(dialog), context_(context), notes_(context) {}

  void run() {
    if (dialog_.controls.empty()) return;
    for (const Control& control : dialog_.controls)
      check(control);
    // A broken line may have been the one that lacks.
    if (dialog_.hasErrorNodes) return;
    const auto window = first_.find("DIALOG");
    const Control& head = dialog_.controls.front();
    const SourceRange place = window == first_.end() ? head.kind.range : window->second->kind.range;
    if (window == first_.end())
      context_.diagnostics.report<diag::DialogNotFirst>(head.kind.range, "the file has no line DIALOG");
    else if (window->second != &head)
      context_.diagnostics.report<diag::DialogNotFirst>(place, "DIALOG is not the first line of the file");
    if (first_.count("OK") == 0) context_.diagnostics.report<diag::DialogWithoutOk>(place);
    if (first_.count("CANCEL") == 0) context_.diagnostics.report<diag::DialogWithoutCancel>(place);
  }

private:
  void check(const Control& control) {
    const std::string key = foldCase(control.kind.text);
    const auto [place, isNew] = first_.try_emplace(key, &control);
    if (!isNew && (key == "DIALOG" || key == "OK" || key == "CANCEL"))
      context_.diagnostics.report<diag::ControlTwice>(control.kind.range, control.kind.text)
          .note(place->second->kind.range, "the first one");
    const auto signatures = context_.keywords.dialogControls(key);
    if (signatures.empty()) {
      if (!context_.keywords.isUnprovedControl(key) &&
          !context_.diagnostics.full(diag::UnknownControl::code, control.range.file))
        context_.diagnostics.report<diag::UnknownControl>(control.kind.range, control.kind.text,
                                                          didYouMean(context_.keywords.nearestControl(key)));
    } else if (!context_.keywords.isUnprovedControl(key)) {
      checkArguments(signatures, control, key);
    }
    for (const ExpressionPtr& argument : control.arguments) {
      notes_.add(*argument);
      checkExpression(*argument, {}, context_);
    }
    checkVariable(control);
    if (key == "IMAGE") checkImage(control);
  }

  void checkArguments(const std::vector<const stdlib::CommandSignature*>& signatures, const Control& control,
                      const std::string& key) {
    if (key == "FRAME" && control.arguments.size() == 5) {
      const Expression& caption = *control.arguments[4];
      const auto* word = std::get_if<VariableRef>(&caption.node);
      const auto* text = std::get_if<TextLiteral>(&caption.node);
      if ((text != nullptr && text->quote == 0) || (word != nullptr && !word->name.isText())) {
        context_.diagnostics.report<diag::LooseCaption>(caption.range);
        return;
      }
    }
    gibbs::checkArguments(control.kind, control.arguments, signatures, control.range, context_);
  }

  void checkVariable(const Control& control) {
    const std::string key = foldCase(control.kind.text);
    // A button has a number, and buttons of a RADIO group share their variable.
    if (!control.variable || key == "BUTTON" || key == "RADIO") return;
    const auto [place, isNew] =
        inputs_.try_emplace(foldCase(control.variable->text), control.variable->range);
    if (!isNew)
      context_.diagnostics.report<diag::VariableTwice>(control.variable->range, control.variable->text)
          .note(place->second, "the first one");
  }

  void checkImage(const Control& control) {
    if (control.arguments.size() < 5) return;
    const auto* file = std::get_if<TextLiteral>(&control.arguments[4]->node);
    if (file == nullptr) return;
    const SourceRange range = control.arguments[4]->range;
    const std::string suffix = fmt::format(".{}", context_.keywords.imageSuffix());
    const std::string& name = file->text;
    const bool matches =
        name.size() > suffix.size() && foldCase(name.substr(name.size() - suffix.size())) == foldCase(suffix);
    bool accent = false;
    for (const char c : name)
      accent = accent || static_cast<unsigned char>(c) > 127;
    const std::string shown =
        fmt::format("`{}`", context_.sources.textUtf8({range.file, range.begin + 1, range.end - 1}));
    if (!matches)
      context_.diagnostics.report<diag::ImageName>(
          range, shown + " is no .bmp file; IMAGE shows nothing else; convert the picture");
    else if (name.find(' ') != std::string::npos)
      context_.diagnostics.report<diag::ImageName>(
          range,
          "the file name " + shown + " holds a blank; GibbsCAM does not find the picture; rename the file");
    else if (accent)
      context_.diagnostics.report<diag::ImageName>(
          range,
          "the file name " + shown +
              " holds a letter that is not ASCII; GibbsCAM does not find the picture; rename the file");
  }

  const Dialog& dialog_;
  const ParseContext& context_;
  Notes notes_;
  std::map<std::string, const Control*> first_;
  std::map<std::string, SourceRange> inputs_;
};

} // namespace

void checkDialog(const Dialog& dialog, const ParseContext& context) {
  DialogCheck(dialog, context).run();
}

void checkDefineData(const DefineData& data, const ParseContext& context) {
  Notes notes(context);
  std::map<std::string, SourceRange> names;
  for (const Definition& definition : data.definitions) {
    const auto [place, isNew] = names.try_emplace(foldCase(definition.name.text), definition.name.range);
    if (!isNew)
      context.diagnostics.report<diag::DuplicateDefinition>(definition.name.range, definition.name.text)
          .note(place->second, "the first one");
    notes.add(*definition.value);
    checkExpression(*definition.value, {}, context);
    const bool text = typeOf(*definition.value, context.keywords) == ValueType::Text;
    if (text || definition.name.isText() || !definition.number)
      context.diagnostics.report<diag::FieldValue>(definition.valueRange, definition.name.text,
                                                   text || definition.name.isText() ? "a text" : "computed");
  }
}

} // namespace dotek::frontend::gibbs
