#include "project/FormDraft.h"

#include "frontend/compost/Summary.h"
#include "support/Printable.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <set>
#include <variant>

namespace dotek::project {

namespace compost = frontend::compost;

namespace {

// What the engine or `post` decides by itself.
constexpr std::string_view kOwn[] = {"OpFieldData", "CycleType", "Flag", "SetFlag", "SetFlagF"};

std::string quoted(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + '"';
}

class Draft {
public:
  Draft(const compost::Program& program, const SourceMap& sources, const stdlib::ComPostKeywords& keywords,
        const std::vector<stdlib::Form>& known)
      : program_(program), sources_(sources), keywords_(keywords), known_(known) {
    for (const compost::Item& item : program.items) {
      if (const auto* picture = std::get_if<compost::PictureDefinition>(&item))
        pictures_.emplace(picture->number, picture->picture.text);
      if (const auto* format = std::get_if<compost::FormatDirective>(&item))
        formats_.emplace(format->name, format->number);
    }
  }

  std::string tables() {
    for (const compost::Item& item : program_.items)
      if (const auto* routine = std::get_if<compost::Routine>(&item)) body(routine->body);
    return std::move(out_);
  }

private:
  void body(const std::vector<compost::Statement>& statements) {
    for (const compost::Statement& statement : statements) {
      if (const auto* one = std::get_if<compost::Word>(&statement)) word(*one);
      const auto* branch = std::get_if<std::unique_ptr<compost::If>>(&statement);
      if (branch == nullptr) continue;
      condition((*branch)->condition);
      body((*branch)->thenBody);
      body((*branch)->elseBody);
    }
  }

  void condition(const compost::Condition& condition) {
    for (const compost::ConditionTerm& term : condition.terms) {
      if (const auto* one = std::get_if<compost::Word>(&term.operand)) word(*one);
      if (const auto* inner = std::get_if<std::unique_ptr<compost::Condition>>(&term.operand))
        this->condition(**inner);
    }
  }

  void word(const compost::Word& word) {
    if (std::find(std::begin(kOwn), std::end(kOwn), word.name) != std::end(kOwn) || !word.arguments.empty())
      return;
    if (word.kind == compost::WordKind::Command && compost::findRoutine(program_, word.name) != nullptr)
      return;
    const stdlib::ComPostKeyword* keyword = keywords_.find(word.name);
    const bool silent = keyword != nullptr && (keyword->kind == stdlib::KeywordKind::Flow ||
                                               keyword->kind == stdlib::KeywordKind::Directive ||
                                               keyword->prints == stdlib::Prints::No);
    if ((silent && word.kind == compost::WordKind::Command) || !done_.insert(word.name).second) return;
    switch (word.kind) {
    case compost::WordKind::Boolean: boolean(word); return;
    case compost::WordKind::Numeric: numeric(word); return;
    case compost::WordKind::Command:
      if (keyword != nullptr && keyword->kind == stdlib::KeywordKind::Sequence)
        text("sequence", word, &stdlib::Form::sequences, "before the digits of a block number");
      else
        text("command", word, &stdlib::Form::commands, "as it is printed, blank included");
      return;
    }
  }

  std::string place(const compost::Word& word) const {
    const SourceFile& file = sources_.file(word.nameRange.file);
    return fmt::format("{}:{}", printable(file.name()), sources_.line(word.nameRange));
  }

  template <class Entry>
  const Entry* find(std::map<std::string, Entry, std::less<>> stdlib::Form::*entries, const std::string& name,
                    const stdlib::Form*& from) const {
    for (const stdlib::Form& form : known_) {
      const auto& map = form.*entries;
      if (const auto at = map.find(name); at != map.end()) {
        from = &form;
        return &at->second;
      }
    }
    return nullptr;
  }

  void copied(const stdlib::Form& from, const std::string& source) {
    out_ += fmt::format("grade = \"assumed\"\nsource = {}\n",
                        quoted(fmt::format("form {}: {}", from.name, source)));
  }

  void text(std::string_view table, const compost::Word& word,
            std::map<std::string, stdlib::FormEntry, std::less<>> stdlib::Form::*entries,
            std::string_view meaning) {
    const stdlib::Form* from = nullptr;
    if (const stdlib::FormEntry* entry = find(entries, word.name, from)) {
      out_ += fmt::format("\n# {}\n[[{}]]\nname = \"{}\"\ntext = {}\n", place(word), table, word.name,
                          quoted(entry->text));
      value(*entry);
      copied(*from, entry->source);
      return;
    }
    out_ += fmt::format("\n# {}: not known\n# [[{}]]\n# name = \"{}\"\n# text = \"\" # {}\n"
                        "# grade = \"observed\"\n# source = \"\"\n",
                        place(word), table, word.name, meaning);
  }

  void value(const stdlib::FormEntry& entry) {
    if (entry.value.empty()) return;
    out_ += fmt::format("value = \"{}\"\npicture = {}\n", entry.value, quoted(entry.picture));
  }

  // A FORMAT of the Prog wins over the picture of a form.
  std::string pictureOf(const std::string& keyword) const {
    const auto format = formats_.find(keyword);
    const auto picture = format == formats_.end() ? pictures_.end() : pictures_.find(format->second);
    return picture == pictures_.end() ? "" : picture->second;
  }

  void numeric(const compost::Word& word) {
    const stdlib::Form* from = nullptr;
    if (const stdlib::FormEntry* entry = find(&stdlib::Form::numerics, word.name, from)) {
      out_ += fmt::format("\n# {}\n[[numeric]]\nname = \"{}\"\n", place(word), word.name);
      value(*entry);
      copied(*from, entry->source);
      return;
    }
    out_ += fmt::format("\n# {}: not known\n# [[numeric]]\n# name = \"{}\"\n"
                        "# value = \"\" # the host input that it prints (dotek list hosts)\n"
                        "# picture = {}\n# grade = \"observed\"\n# source = \"\"\n",
                        place(word), word.name, quoted(pictureOf(word.name)));
  }

  void boolean(const compost::Word& word) {
    const stdlib::Form* from = nullptr;
    if (const stdlib::FormBoolean* entry = find(&stdlib::Form::booleans, word.name, from)) {
      out_ += fmt::format("\n# {}\n[[boolean]]\nname = \"{}\"\nvalue = {}\n", place(word), word.name,
                          entry->value);
      copied(*from, entry->source);
      return;
    }
    out_ += fmt::format("\n# {}: not known\n# [[boolean]]\n# name = \"{}\"\n"
                        "# value = true # whether it holds for a probing operation\n"
                        "# grade = \"observed\"\n# source = \"\"\n",
                        place(word), word.name);
  }

  const compost::Program& program_;
  const SourceMap& sources_;
  const stdlib::ComPostKeywords& keywords_;
  const std::vector<stdlib::Form>& known_;
  std::map<std::uint32_t, std::string> pictures_;
  std::map<std::string, std::uint32_t> formats_;
  std::set<std::string> done_;
  std::string out_;
};

} // namespace

std::string draftForm(const std::string& name, const compost::Program& program, const SourceMap& sources,
                      const stdlib::ComPostKeywords& keywords, const std::vector<stdlib::Form>& known) {
  const std::string prog = printable(sources.file(program.file).name());
  return fmt::format(
             "# What the Form of the post {1} decides. Save as DIR/forms/{0}.toml; `--data DIR --form "
             "{0}` reads it.\n"
             "# Compare each entry with a program that the post has written: then its grade is "
             "observed.\n\n"
             "schema = 1\n\n"
             "# profile of the machine that the post writes for (dotek list controls)\n"
             "# control = \"\"\n",
             name, prog) +
         Draft(program, sources, keywords, known).tables();
}

} // namespace dotek::project
