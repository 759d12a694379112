#include "frontend/gibbs/Labels.h"

#include <algorithm>
#include <unordered_set>

namespace dotek::frontend::gibbs {

namespace {

// Rows that two boxes have in common; 0 or less for none.
int sharedRows(const Box& a, const Box& b) {
  return std::min(a.top + a.height, b.top + b.height) - std::max(a.top, b.top);
}

bool isBlank(char c) {
  return c == ' ' || c == '\t';
}

std::string trimmed(const std::string& text) {
  std::size_t begin = 0;
  std::size_t end = text.size();
  while (begin < end && isBlank(text[begin]))
    ++begin;
  while (end > begin && isBlank(text[end - 1]))
    --end;
  return text.substr(begin, end - begin);
}

void splitUnit(const std::string& label, InputLabel& into) {
  std::string text = trimmed(label);
  if (!text.empty() && text.back() == ']') {
    const std::size_t open = text.rfind('[');
    if (open != std::string::npos) {
      into.unit = trimmed(text.substr(open + 1, text.size() - open - 2));
      text.resize(open);
    }
  }
  for (const char c : text)
    if (!isBlank(c)) into.name += c;
}

// The label with the smallest distance; on a tie the one that shares more rows, then the first of the file.
class Nearest {
public:
  void offer(const Control& label, int distance, int rows) {
    if (best_ != nullptr && (distance > distance_ || (distance == distance_ && rows <= rows_))) return;
    best_ = &label;
    distance_ = distance;
    rows_ = rows;
  }
  const Control* best() const { return best_; }

private:
  const Control* best_ = nullptr;
  int distance_ = 0;
  int rows_ = 0;
};

bool isInput(const Control& control) {
  const std::string kind = foldCase(control.kind.text);
  return control.variable && control.box &&
         (kind == "INPUT" || kind == "CHECK" || kind == "RADIO" || kind == "DROPDOWN_NEW");
}

SourceRange textRange(const Control& label) {
  return label.arguments.size() > 4 ? label.arguments[4]->range : label.range;
}

} // namespace

Box closedBox(const Dialog& dialog, const Control& control) {
  constexpr int kUsual = 22; // of a dialog without an INPUT
  Box box = *control.box;
  if (foldCase(control.kind.text) != "DROPDOWN_NEW") return box;
  std::optional<int> lowest;
  for (const Control& other : dialog.controls)
    if (foldCase(other.kind.text) == "INPUT" && other.box && other.box->height > 0)
      lowest = std::min(lowest.value_or(other.box->height), other.box->height);
  box.height = std::min(box.height, lowest.value_or(kUsual));
  return box;
}

std::vector<InputLabel> inputLabels(const Dialog& dialog) {
  std::vector<const Control*> labels;
  for (const Control& control : dialog.controls)
    if (foldCase(control.kind.text) == "LABEL" && control.box && control.text) labels.push_back(&control);

  std::vector<InputLabel> found;
  std::unordered_set<const Control*> names;
  for (const Control& input : dialog.controls) {
    if (!isInput(input)) continue;
    InputLabel made;
    made.input = &input;
    made.variable = *input.variable;
    const Box box = closedBox(dialog, input);
    Nearest nearest;
    for (const Control* label : labels) {
      const int rows = sharedRows(*label->box, box);
      if (rows > 0 && label->box->left < box.left) nearest.offer(*label, box.left - label->box->left, rows);
    }
    if (const Control* label = nearest.best()) {
      names.insert(label);
      splitUnit(*label->text, made);
      made.nameRange = textRange(*label);
    }
    found.push_back(std::move(made));
  }
  for (InputLabel& each : found) {
    const Box box = closedBox(dialog, *each.input);
    Nearest nearest;
    for (const Control* label : labels) {
      if (names.contains(label)) continue;
      const int rows = sharedRows(*label->box, box);
      const int distance = label->box->left - (box.left + box.width);
      if (rows > 0 && distance >= 0) nearest.offer(*label, distance, rows);
    }
    if (const Control* label = nearest.best()) {
      each.meaning = trimmed(*label->text);
      each.meaningRange = textRange(*label);
    }
  }
  return found;
}

} // namespace dotek::frontend::gibbs
