#include "stdlib/Form.h"

#include "stdlib/ComPostKeywords.h"
#include "stdlib/DataFiles.h"
#include "stdlib/HostInputs.h"
#include "stdlib/Toml.h"
#include "support/NearestName.h"
#include "support/Picture.h"

#include <algorithm>
#include <fmt/format.h>
#include <variant>

namespace dotek::stdlib {
namespace {

class FormReader {
public:
  FormReader(const TomlDocument& document, const ComPostKeywords& keywords)
      : document_(document), keywords_(keywords) {}

  void commands(Form& form) const {
    for (const TomlTable& table : document_.root().value("command").tables()) {
      FormEntry entry = this->entry(table);
      entry.text = text(table);
      value(table, entry);
      insert(form.commands, table, KeywordKind::Command, std::move(entry));
    }
  }

  void numerics(Form& form) const {
    for (const TomlTable& table : document_.root().value("numeric").tables()) {
      FormEntry entry = this->entry(table);
      value(table, entry);
      if (entry.picture.empty())
        document_.fail(table.range(), "`picture` is missing; a numeric keyword is printed in one");
      insert(form.numerics, table, KeywordKind::Numeric, std::move(entry));
    }
  }

  void booleans(Form& form) const {
    for (const TomlTable& table : document_.root().value("boolean").tables()) {
      FormBoolean boolean;
      boolean.value = table.require("value", "true or false").flag();
      boolean.observed = observed(table);
      boolean.source = source(table);
      insert(form.booleans, table, KeywordKind::Boolean, std::move(boolean));
    }
  }

  void sequences(Form& form) const {
    for (const TomlTable& table : document_.root().value("sequence").tables()) {
      FormEntry entry = this->entry(table);
      entry.text = text(table);
      insert(form.sequences, table, KeywordKind::Sequence, std::move(entry));
      const TomlValue name = table.value("name");
      if (form.commands.contains(name.text()))
        document_.fail(name.range(), fmt::format("`{}` is a command and a sequence word", name.text()));
    }
  }

private:
  static bool observed(const TomlTable& table) {
    return table.require("grade", "observed or assumed").choice({"observed", "assumed"}) == "observed";
  }
  static std::string source(const TomlTable& table) {
    return table.require("source", "where the fact comes from").text();
  }

  FormEntry entry(const TomlTable& table) const {
    FormEntry entry;
    entry.observed = observed(table);
    entry.source = source(table);
    return entry;
  }

  std::string text(const TomlTable& table) const {
    const TomlValue value = table.require("text", "the text that is printed");
    std::string text = value.text();
    const bool printable = std::all_of(text.begin(), text.end(), [](char c) { return c >= ' ' && c <= '~'; });
    if (!printable)
      document_.fail(value.range(),
                     "`text` holds a character that controls do not read; printable ASCII is expected");
    return text;
  }

  // The host input and the picture it is printed in: one is nothing without the other.
  void value(const TomlTable& table, FormEntry& entry) const {
    const TomlValue value = table.value("value");
    const TomlValue picture = table.value("picture");
    entry.value = value.text();
    entry.picture = picture.text();
    if (value && !isHostInput(entry.value)) {
      const std::string nearest = nearestName(entry.value, hostInputNames());
      document_.fail(value.range(),
                     nearest.empty()
                         ? fmt::format("`{}` is no host input; known: `{}`", entry.value,
                                       fmt::join(hostInputNames(), "`, `"))
                         : fmt::format("`{}` is no host input; the nearest is `{}`", entry.value, nearest));
    }
    if (value && !picture)
      document_.fail(value.range(), fmt::format("`{}` has no `picture` to be printed in", entry.value));
    if (picture && !value)
      document_.fail(picture.range(), "`picture` is without `value`, the host input that it prints");
    if (!picture) return;
    const auto parsed = Picture::parse(entry.picture);
    if (const auto* error = std::get_if<PictureError>(&parsed)) {
      SourceRange range = picture.range();
      const bool plain =
          range.end - range.begin == entry.picture.size() + 2; // no escapes, one quote at either end
      if (plain)
        range = {range.file, range.begin + 1 + error->offset,
                 range.begin + 1 + error->offset + error->length};
      document_.fail(range, fmt::format("picture `{}`: {}", entry.picture, error->message));
    }
    const std::string& prefix = std::get<Picture>(parsed).prefix();
    if (!prefix.empty())
      document_.fail(picture.range(),
                     fmt::format("picture `{}`: what the characters `{}` before the number do is not known",
                                 entry.picture, prefix));
  }

  template <class Entry>
  void insert(std::map<std::string, Entry, std::less<>>& map, const TomlTable& table, KeywordKind kind,
              Entry entry) const {
    const TomlValue place = table.require("name", "a keyword");
    const std::string name = place.text();
    if (name.ends_with('#') || name.ends_with('?'))
      document_.fail(place.range(), fmt::format("`{}` is given with its suffix; write `{}`", name,
                                                name.substr(0, name.size() - 1)));
    const bool letters = std::all_of(name.begin(), name.end(), [](char c) {
      return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
    });
    if (name.empty() || !letters)
      document_.fail(place.range(), fmt::format("`{}` is no keyword: letters and digits are expected", name));
    const ComPostKeyword* keyword = keywords_.find(name);
    if (keyword != nullptr && keyword->kind != kind)
      document_.fail(place.range(), fmt::format("`{}` is {} and is under `{}`", name,
                                                kindPhrase(keyword->kind), kindTable(kind)));
    if (!map.emplace(name, std::move(entry)).second)
      document_.fail(place.range(), fmt::format("`{}` is given twice", name));
  }

  static std::string_view kindPhrase(KeywordKind kind) {
    switch (kind) {
    case KeywordKind::Flow: return "a word of the language";
    case KeywordKind::Command: return "a command";
    case KeywordKind::Numeric: return "a numeric keyword";
    case KeywordKind::Boolean: return "a boolean keyword";
    case KeywordKind::Directive: return "a directive";
    case KeywordKind::Sequence: return "a sequence word";
    }
    return "";
  }
  static std::string_view kindTable(KeywordKind kind) {
    switch (kind) {
    case KeywordKind::Command: return "[[command]]";
    case KeywordKind::Numeric: return "[[numeric]]";
    case KeywordKind::Boolean: return "[[boolean]]";
    default: return "[[sequence]]";
    }
  }

  const TomlDocument& document_;
  const ComPostKeywords& keywords_;
};

} // namespace

std::optional<Form> Form::load(const DataFiles& files, std::string_view name,
                               const ComPostKeywords& keywords) {
  const DataFile* file = files.find("forms", name);
  if (file == nullptr) return std::nullopt;
  const TomlDocument document = TomlDocument::parse(*file);
  const FormReader reader(document, keywords);
  Form form;
  form.name = name;
  form.origin = file->origin;
  const TomlValue control = document.root().value("control");
  form.control = control.text();
  if (control && files.find("controls", form.control) == nullptr)
    document.fail(control.range(),
                  fmt::format("no control `{}`; `dotek list controls` prints them", form.control));
  reader.commands(form);
  reader.numerics(form);
  reader.booleans(form);
  reader.sequences(form);
  document.finish();
  return form;
}

std::optional<Form> Form::load(const DataFiles& files, std::string_view name) {
  return load(files, name, ComPostKeywords::load(files));
}

} // namespace dotek::stdlib
