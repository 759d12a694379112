#include "lint/Page.h"

#include "support/Wrap.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace dotek::lint {
namespace {

// The next line without its end; `text` begins after it.
std::string_view takeLine(std::string_view& text) {
  const std::size_t end = std::min(text.find('\n'), text.size());
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return line;
}

// "Note, off by default. A label .." -> "A label .."; other texts are kept.
std::string_view withoutSeverity(std::string_view text) {
  for (const std::string_view severity : {"Error", "Warning", "Note"}) {
    if (!text.starts_with(severity)) continue;
    std::string_view rest = text.substr(severity.size());
    constexpr std::string_view kOff = ", off by default";
    if (rest.starts_with(kOff)) rest.remove_prefix(kOff.size());
    if (rest.starts_with(". ")) return rest.substr(2);
  }
  return text;
}

// Lines of text as paragraphs of one line each; a heading ends a paragraph.
class Paragraphs {
public:
  void line(std::string_view text) {
    if (text.empty()) {
      end();
    } else {
      if (!open_.empty()) open_ += ' ';
      open_ += text;
    }
  }
  void end() {
    if (!open_.empty()) done_.push_back(std::move(open_));
    open_.clear();
  }
  std::vector<std::string> take() {
    end();
    return std::exchange(done_, {});
  }

private:
  std::string open_;
  std::vector<std::string> done_;
};

} // namespace

std::string_view pageOf(std::string_view id) {
  const auto pages = rulePages();
  // Names end in ".md", which sorts before letters and after `-`: no order by id.
  const auto found = std::find_if(pages.begin(), pages.end(), [&](const RulePage& page) {
    return page.name.size() == id.size() + 3 && page.name.starts_with(id);
  });
  return found != pages.end() ? found->text : std::string_view{};
}

std::string proseOf(std::string_view page) {
  takeLine(page); // # id
  Paragraphs paragraphs;
  while (!page.empty()) {
    const std::string_view line = takeLine(page);
    if (line.starts_with("## ")) break;
    paragraphs.line(line);
  }
  std::string out;
  for (const std::string& paragraph : paragraphs.take())
    out += out.empty() ? std::string(withoutSeverity(paragraph)) : "\n" + paragraph;
  return out;
}

std::string firstSentence(std::string_view text) {
  text = text.substr(0, text.find('\n'));
  bool code = false;
  for (std::size_t at = 0; at + 2 < text.size(); ++at) {
    if (text[at] == '`') code = !code;
    if (code || text[at] != '.' || text[at + 1] != ' ') continue;
    const char next = text[at + 2];
    if ((next >= 'A' && next <= 'Z') || next == '`' || next == '#')
      return std::string(text.substr(0, at + 1));
  }
  return std::string(text);
}

std::string shownPage(std::string_view page) {
  std::string out;
  const std::string prose = proseOf(page);
  for (std::string_view left = prose; !left.empty();)
    out += (out.empty() ? "" : "\n") + wrapped(takeLine(left));
  bool examples = false;
  bool inside = false; // a block
  Paragraphs paragraphs;
  const auto flush = [&] {
    for (const std::string& paragraph : paragraphs.take())
      out += "\n" + wrapped(paragraph);
  };
  while (!page.empty()) {
    const std::string_view line = takeLine(page);
    examples = examples || line.starts_with("## ");
    if (!examples) continue;
    if (line.starts_with("```")) {
      flush();
      const std::size_t name = line.find(' ');
      inside = !inside;
      if (inside && name != std::string_view::npos) out += "\n  " + std::string(line.substr(name + 1)) + "\n";
    } else if (inside) {
      out += line.empty() ? "\n" : "    " + std::string(line) + "\n";
    } else if (line.starts_with("#")) {
      flush();
      const std::string_view title = line.substr(line.find(' ') + 1);
      out += "\n" + std::string(title) +
             (line.starts_with("## ") ? "\n" + std::string(title.size(), '-') : ":") + "\n";
    } else {
      paragraphs.line(line);
    }
  }
  flush();
  return out;
}

} // namespace dotek::lint
