// DefineData.txt and the dialog: one row for each field that the user fills in, under the heading of its
// group.
#include "backends/gibbs/Macro.h"
#include "support/Decimal.h"

#include <algorithm>
#include <fmt/format.h>

namespace dotek::backends::gibbs {

namespace {

// Pixels. A character of the CAM's dialogs is at most kCharacter wide.
constexpr std::size_t kCharacter = 8, kMargin = 20, kGap = 12, kRow = 30, kHeight = 24, kInput = 90;
constexpr std::size_t kLeft = 40, kTop = 40;           // of the window on the screen
constexpr std::size_t kWidestText = 560, kButton = 80; // what is longer goes on below
constexpr std::size_t kCaptionRoom = 60, kFrame = 16;  // the window's own edges

std::size_t widthOf(std::string_view text) {
  return text.size() * kCharacter;
}

std::string title(const Field& field) {
  return field.unit.empty() ? field.name : field.name + " [" + field.unit + "]";
}

EmittedLine lineOf(std::string text) {
  return {std::move(text), {}, ""};
}

std::string placed(std::string_view control, std::size_t x, std::size_t y, std::size_t width,
                   std::size_t height) {
  return fmt::format("{} {}, {}, {}, {}", control, x, y, width, height);
}

class Dialog {
public:
  Dialog(const Folder& folder, Diagnostics& diagnostics) : folder_(folder), diagnostics_(diagnostics) {
    for (const Field& field : folder.fields) {
      if (!field.asked) continue;
      names_ = std::max(names_, widthOf(title(field)));
      texts_ = std::max(texts_, widthOf(plainOf(field.meaning)));
      for (const Choice& choice : field.choices)
        inputs_ = std::max(inputs_, widthOf(plainOf(choice.title)) + kHeight);
    }
    texts_ = std::min(texts_, kWidestText);
  }

  std::vector<EmittedLine> write() {
    std::string group;
    for (const Field& field : folder_.fields) {
      if (!field.asked || !field.group.empty()) continue;
      row(field);
    }
    std::vector<std::string> groups;
    for (const Field& field : folder_.fields)
      if (field.asked && !field.group.empty() &&
          std::find(groups.begin(), groups.end(), field.group) == groups.end())
        groups.push_back(field.group);
    for (const std::string& one : groups) {
      heading(one);
      for (const Field& field : folder_.fields)
        if (field.asked && field.group == one) row(field);
    }
    const std::size_t inside = kMargin + names_ + kGap + inputs_ + kGap + texts_ + kMargin;
    const std::string caption = plain(folder_.title.empty() ? folder_.name : folder_.title, {}, diagnostics_);
    const std::size_t width = std::max({inside, widest_ + 2 * kMargin, 2 * kButton + 3 * kMargin,
                                        widthOf(caption) + kCaptionRoom}) +
                              kFrame;
    y_ += kGap;
    const std::size_t cancel = width - kFrame - kMargin - kButton;
    lines_.push_back(lineOf(placed("ok", cancel - kMargin - kButton, y_, kButton, kHeight + 4)));
    lines_.push_back(lineOf(placed("cancel", cancel, y_, kButton, kHeight + 4)));
    const std::size_t height = y_ + kHeight + 4 + kMargin + kCaptionRoom;
    lines_.insert(lines_.begin(),
                  lineOf(fmt::format("dialog \"{}\", {}, {}, {}, {}", caption, kLeft, kTop, width, height)));
    return std::move(lines_);
  }

private:
  std::string plainOf(std::string_view text) {
    Diagnostics said; // once, where it is written
    return plain(text, {}, said);
  }

  void label(std::size_t x, std::size_t y, std::size_t width, std::size_t height, const std::string& text) {
    lines_.push_back(lineOf(placed("label", x, y, width, height) + ", \"" + text + "\""));
  }

  void heading(const std::string& text) {
    y_ += kGap;
    const std::string shown = plain(text, {}, diagnostics_);
    widest_ = std::max(widest_, widthOf(shown));
    label(kMargin, y_, widthOf(shown), kHeight, shown);
    y_ += kRow;
  }

  void row(const Field& field) {
    const std::size_t at = kMargin + names_ + kGap;
    const std::string meaning = plain(field.meaning, {}, diagnostics_);
    const std::size_t rows =
        texts_ == 0 ? 1 : std::max<std::size_t>(1, (widthOf(meaning) + texts_ - 1) / texts_);
    label(kMargin, y_, widthOf(title(field)), kHeight, title(field));
    if (field.choices.empty()) {
      lines_.push_back(
          lineOf(placed("input", at, y_, kInput, kHeight) + ", " + field.name + ", " + field.name));
    } else {
      const std::size_t number = ++lists_;
      lines_.push_back(lineOf(placed("dropdown_new", at, y_, inputs_, kHeight) + ", " + field.name));
      for (const Choice& choice : field.choices)
        lines_.push_back(
            lineOf(fmt::format("dropdown_add {}, \"{}\", {}", number, plain(choice.title, {}, diagnostics_),
                               numberText(choice.value))));
      lines_.push_back(lineOf(fmt::format("dropdown_val {}, {}", number, field.name)));
    }
    if (!meaning.empty())
      label(at + inputs_ + kGap, y_, std::min(widthOf(meaning), texts_), rows * kHeight, meaning);
    y_ += std::max(kRow, rows * kHeight + kRow - kHeight);
  }

  const Folder& folder_;
  Diagnostics& diagnostics_;
  std::vector<EmittedLine> lines_;
  std::size_t names_ = 0, inputs_ = kInput, texts_ = 0, widest_ = 0, y_ = kMargin, lists_ = 0;
};

} // namespace

std::vector<EmittedLine> defineLines(const Folder& folder, Diagnostics& diagnostics) {
  std::vector<EmittedLine> out;
  if (!folder.description.empty()) out.push_back(lineOf("! " + plain(folder.description, {}, diagnostics)));
  for (const Field& field : folder.fields)
    out.push_back(lineOf(field.name + " = " + numberText(field.initial)));
  return out;
}

std::vector<EmittedLine> dialogLines(const Folder& folder, Diagnostics& diagnostics) {
  return Dialog(folder, diagnostics).write();
}

std::optional<FolderText> emit(const ir::Cycle& cycle, const Folder& folder, const Names& names,
                               Diagnostics& diagnostics) {
  FolderText out;
  out.define = defineLines(folder, diagnostics);
  out.dialog = dialogLines(folder, diagnostics);
  Names ofChecks = names;
  MacroText checks(cycle, ofChecks, diagnostics);
  out.checks = checkLines(cycle, folder, checks);
  Names ofPath = names; // a macro's own names are no other macro's
  MacroText path(cycle, ofPath, diagnostics);
  out.path = pathLines(cycle, folder, path);
  if (checks.failed() || path.failed()) return std::nullopt;
  return out;
}

} // namespace dotek::backends::gibbs
