#include "stdlib/DataFiles.h"
#include "stdlib/GibbsTables.h"
#include "stdlib/HostInputs.h"
#include "stdlib/Signature.h"
#include "stdlib/StoredTables.h"
#include "stdlib/Toml.h"
#include "support/NearestName.h"

#include <algorithm>
#include <fmt/format.h>

namespace dotek::stdlib {
namespace {

using Tables = GibbsKeywords::Tables;

// One file of the folder keywords/, with what all of them have in common.
class KeywordFile {
public:
  KeywordFile(const DataFiles& files, std::string_view name)
      : document_(open(files, name)), root_(document_.root()) {
    root_.value("language").choice({"gibbs"});
  }

  const TomlTable& root() const { return root_; }
  std::vector<TomlTable> tables(std::string_view key) const { return root_.value(key).tables(); }
  [[noreturn]] void fail(SourceRange range, const std::string& message) const {
    document_.fail(range, message);
    throw DataError(message); // not reached: a data file's fail() throws
  }
  void finish() const { document_.finish(); }

  // Grade and source are in every table.
  static char grade(const TomlTable& table) {
    table.require("source", "where the fact comes from").text();
    return table.require("grade", "D, O, I or U").choice({"D", "O", "I", "U"}, "U")[0];
  }
  static std::string name(const TomlTable& table, std::string_view key) {
    return upperCase(table.require(key, "a name").text());
  }

  // A place is a value or a table: its range costs time and is wanted for a message only.
  // Adds a name that is to be new in its table.
  template <class T, class Place>
  T& insert(NameMap<T>& map, const std::string& key, T value, const Place& place) const {
    const auto [at, isNew] = map.emplace(key, std::move(value));
    if (!isNew) fail(place.range(), fmt::format("`{}` is given twice", key));
    return at->second;
  }
  template <class T, class Place>
  const T& known(const NameMap<T>& map, const std::string& key, const Place& place,
                 std::string_view what) const {
    const auto at = map.find(key);
    if (at != map.end()) return at->second;
    const std::string nearest = nearestName(key, map);
    fail(place.range(), fmt::format("`{}` is no {} of the tables{}", key, what,
                                    nearest.empty() ? "" : fmt::format("; the nearest is `{}`", nearest)));
  }

private:
  static TomlDocument open(const DataFiles& files, std::string_view name) {
    const DataFile* file = files.find("keywords", name);
    if (file == nullptr) throw DataError(fmt::format("keywords/{}.toml is missing", name));
    return TomlDocument::parse(*file);
  }

  TomlDocument document_;
  TomlTable root_;
};

CommandSignature signatureOf(const KeywordFile& file, const TomlValue& value, char grade,
                             const std::string& source) {
  std::string defect;
  std::optional<CommandSignature> signature = parseSignature(value.text(), defect);
  if (!signature) file.fail(value.range(), defect);
  signature->grade = grade;
  signature->source = source;
  return std::move(*signature);
}

void loadParameters(const DataFiles& files, Tables& tables) {
  const KeywordFile file(files, "gibbs-parameters");
  for (const TomlTable& table : file.tables("family")) {
    KeywordFile::grade(table);
    table.value("note").text();
    const std::string name = KeywordFile::name(table, "name");
    ParameterFamily& family = file.insert(tables.families, name, {}, table);
    family.open = table.value("open").flag();
    constexpr std::pair<const char*, ParameterKind> kLists[] = {{"int", ParameterKind::Number},
                                                                {"float", ParameterKind::Number},
                                                                {"text", ParameterKind::Text},
                                                                {"mixed", ParameterKind::Mixed},
                                                                {"keyword", ParameterKind::Keyword}};
    for (const auto& [list, kind] : kLists) {
      const TomlValue names = table.value(list);
      for (const TomlValue& item : names.items()) {
        const std::string parameter = upperCase(item.text());
        const auto [at, isNew] = family.parameters.emplace(parameter, kind);
        // The vendor prints some names as int and as float: both are numbers of a macro.
        if (!isNew && at->second != kind)
          file.fail(item.range(), fmt::format("`{}` of `{}` has two kinds", parameter, name));
      }
    }
  }
  for (const TomlTable& table : file.tables("host")) {
    KeywordFile::grade(table);
    const std::string familyName = KeywordFile::name(table, "family");
    const ParameterFamily& family = file.known(tables.families, familyName, table.value("family"), "family");
    const std::string parameter = KeywordFile::name(table, "parameter");
    file.known(family.parameters, parameter, table.value("parameter"), "parameter");
    const TomlValue host = table.require("host", "a host input");
    if (!isHostInput(host.text())) file.fail(host.range(), fmt::format("`{}` is no host input", host.text()));
    file.insert(tables.hosts, familyName + "." + parameter, host.text(), table);
  }
  file.finish();
}

void loadCommands(const DataFiles& files, Tables& tables) {
  const KeywordFile file(files, "gibbs-commands");
  for (const TomlTable& table : file.tables("group")) {
    table.require("title", "a title").text();
    table.value("since").text();
    const char grade = KeywordFile::grade(table);
    const std::string source = table.value("source").text();
    const bool core = table.value("core").flag();
    const bool openKeywords = table.value("open_keywords").flag();
    for (const std::string& word : table.value("words").texts())
      tables.coreWords.push_back(upperCase(word));
    for (const TomlValue& item : table.require("commands", "a list of signatures").items()) {
      CommandSignature signature = signatureOf(file, item, grade, source);
      signature.openKeywords = openKeywords;
      for (const ArgumentSpec& argument : signature.arguments) {
        if (argument.kind == ArgumentSpec::Kind::Parameter)
          file.known(tables.families, upperCase(argument.family), item, "family");
      }
      Tables::Command& command = tables.commands[signature.name];
      if (!command.signatures.empty() && command.core != core)
        file.fail(item.range(), fmt::format("`{}` is in a core group and in another one", signature.name));
      command.core = core;
      command.signatures.push_back(std::move(signature));
    }
  }
  for (const TomlValue& item : file.root().value("unsure_arguments").items()) {
    const std::string name = upperCase(item.text());
    file.known(tables.commands, name, item, "command");
    for (CommandSignature& signature : tables.commands.find(name)->second.signatures)
      signature.unsure = true;
  }
  for (const TomlValue& item : file.root().value("unpure_reads").items())
    file.insert(tables.advances, upperCase(item.text()), true, item);
  for (const TomlTable& table : file.tables("prefix")) {
    KeywordFile::grade(table);
    tables.commandPrefixes.push_back(KeywordFile::name(table, "name"));
  }
  const auto rename = [&](const TomlTable& table, std::string_view from, std::string_view to) {
    KeywordFile::grade(table);
    table.value("since").text();
    const std::string old = KeywordFile::name(table, from);
    const std::string current = KeywordFile::name(table, to);
    if (tables.commands.contains(old))
      file.fail(table.value(from).range(), fmt::format("`{}` is a command of its own", old));
    file.known(tables.commands, current, table.value(to), "command");
    file.insert(tables.renamed, old, current, table);
  };
  for (const TomlTable& table : file.tables("alias"))
    rename(table, "name", "use");
  for (const TomlTable& table : file.tables("renamed"))
    rename(table, "old", "new");
  for (const TomlTable& table : file.tables("note")) {
    KeywordFile::grade(table);
    const std::string name = KeywordFile::name(table, "command");
    file.known(tables.commands, name, table.value("command"), "command");
    tables.commands.find(name)->second.notes.push_back(table.require("note", "a remark").text());
  }
  file.finish();
}

void loadDialog(const DataFiles& files, Tables& tables) {
  const KeywordFile file(files, "gibbs-dialog");
  for (const TomlTable& table : file.tables("group")) {
    table.require("title", "a title").text();
    const char grade = KeywordFile::grade(table);
    const std::string source = table.value("source").text();
    const bool unproved = table.value("unproved").flag();
    for (const TomlValue& item : table.require("statements", "a list of signatures").items()) {
      CommandSignature signature = signatureOf(file, item, grade, source);
      signature.unsure = unproved;
      Tables::Control& control = tables.controls[signature.name];
      control.unproved |= unproved;
      control.signatures.push_back(std::move(signature));
    }
  }
  for (const TomlValue& item : file.root().value("required").items()) {
    const std::string name = upperCase(item.text());
    file.known(tables.controls, name, item, "control");
    tables.requiredControls.push_back(name);
  }
  const TomlValue first = file.root().require("first", "the control that is first");
  tables.firstControl = upperCase(first.text());
  file.known(tables.controls, tables.firstControl, first, "control");
  tables.imageSuffix = file.root().require("image_suffix", "the suffix of images").text();
  for (const TomlTable& table : file.tables("note")) {
    KeywordFile::grade(table);
    const std::string name = KeywordFile::name(table, "statement");
    file.known(tables.controls, name, table.value("statement"), "control");
    tables.controls.find(name)->second.notes.push_back(table.require("note", "a remark").text());
  }
  file.finish();
}

void loadFunctions(const DataFiles& files, Tables& tables) {
  const KeywordFile file(files, "gibbs-functions");
  for (const TomlTable& table : file.tables("function")) {
    FunctionSpec function;
    function.name = KeywordFile::name(table, "name");
    function.grade = KeywordFile::grade(table);
    function.source = table.value("source").text();
    table.value("since").text();
    function.note = table.value("note").text();
    function.open = table.value("open").flag();
    const TomlValue types = table.require("args", "one letter an argument, n or t");
    function.types = types.text();
    if (function.types.find_first_not_of("nt") != std::string::npos)
      file.fail(
          types.range(),
          fmt::format("`args` is \"{}\"; the letters n (number) and t (text) are expected", function.types));
    if (function.open && !function.types.empty())
      file.fail(types.range(), "`args` is given although `open` says that it is not known");
    function.result = table.require("result", "n or t").choice({"n", "t"}, "n")[0];
    const std::string name = function.name;
    file.insert(tables.functions, name, std::move(function), table);
  }
  file.finish();
}

void loadCursors(const KeywordFile& file, Tables& tables) {
  const auto commands = [&](const TomlValue& list) {
    std::vector<std::string> names;
    for (const TomlValue& item : list.items()) {
      names.push_back(upperCase(item.text()));
      file.known(tables.commands, names.back(), item, "command");
    }
    return names;
  };
  NameMap<bool> advances;
  for (const TomlTable& table : file.tables("cursor")) {
    KeywordFile::grade(table);
    table.value("note").text();
    CursorNames cursor;
    cursor.snapshot = commands(table.require("snapshot", "a list of commands"));
    if (const TomlValue after = table.value("after")) {
      cursor.after = upperCase(after.text());
      file.known(tables.commands, cursor.after, after, "command");
    }
    for (const TomlValue& item : table.require("names", "a list of names").items()) {
      const std::string name = upperCase(item.text());
      file.insert(tables.variables, name, item.text(), item);
      tables.cursorOf.emplace(name, tables.cursors.size());
      cursor.names.push_back(name);
    }
    for (const TomlValue& item : table.value("advances").items()) {
      const std::string name = upperCase(item.text());
      if (std::find(cursor.names.begin(), cursor.names.end(), name) == cursor.names.end())
        file.fail(item.range(), fmt::format("`{}` is none of the names of its cursor", name));
      if (!tables.advances.contains(name))
        file.fail(item.range(),
                  fmt::format("`{}` is missing in `unpure_reads` of keywords/gibbs-commands.toml", name));
      file.insert(advances, name, true, item);
      cursor.advances.push_back(name);
    }
    tables.cursors.push_back(std::move(cursor));
  }
  for (const auto& [name, unused] : tables.advances) {
    if (!advances.contains(name))
      file.fail(file.root().range(),
                fmt::format(
                    "`{}` of `unpure_reads` in keywords/gibbs-commands.toml is no cursor name that advances",
                    name));
  }
}

void loadVariables(const DataFiles& files, Tables& tables) {
  const KeywordFile file(files, "gibbs-variables");
  const auto names = [&](const TomlTable& table, NameMap<std::string>& into) {
    KeywordFile::grade(table);
    table.require("group", "a title").text();
    table.value("note").text();
    for (const TomlValue& item : table.require("names", "a list of names").items())
      file.insert(into, upperCase(item.text()), item.text(), item);
  };
  for (const TomlTable& table : file.tables("variables")) {
    table.require("set_by", "command or system").choice({"command", "system"});
    names(table, tables.variables);
  }
  for (const TomlTable& table : file.tables("constants"))
    names(table, tables.constants);
  for (const TomlTable& table : file.tables("reserved"))
    names(table, tables.reserved);
  for (const TomlTable& table : file.tables("removed")) {
    KeywordFile::grade(table);
    const std::string since = table.require("since", "a version").text();
    for (const TomlValue& item : table.require("names", "a list of names").items())
      file.insert(tables.removed, upperCase(item.text()), since, item);
  }
  loadCursors(file, tables);
  for (const TomlTable& table : file.tables("callback")) {
    CallbackVariable callback;
    callback.grade = KeywordFile::grade(table);
    callback.name = table.require("name", "a name").text();
    callback.read = table.require("read", "true or false").flag();
    callback.write = table.require("write", "true or false").flag();
    callback.where = table.require("where", "a list of macro files").texts();
    callback.note = table.value("note").text();
    const std::string name = upperCase(callback.name);
    file.insert(tables.variables, name, callback.name, table);
    file.insert(tables.callbacks, name, std::move(callback), table);
  }
  for (const TomlTable& table : file.tables("prefix")) {
    KeywordFile::grade(table);
    tables.variablePrefixes.push_back(KeywordFile::name(table, "name"));
  }
  for (const auto* map : {&tables.constants, &tables.removed}) {
    for (const auto& [name, unused] : *map) {
      if (tables.variables.contains(name))
        file.fail(file.root().range(),
                  fmt::format("`{}` is a variable and a constant or a removed name", name));
    }
  }
  file.finish();
}

void loadSystemMacros(const DataFiles& files, Tables& tables) {
  const KeywordFile file(files, "gibbs-system-macros");
  for (const TomlTable& table : file.tables("system_macro")) {
    KeywordFile::grade(table);
    table.value("since").text();
    SystemMacro macro;
    macro.event = table.require("event", "an event").text();
    macro.when = table.require("when", "at, before or after").choice({"at", "before", "after"});
    macro.file = table.require("file", "a file name").text();
    tables.systemMacros.push_back(std::move(macro));
  }
  file.finish();
}

} // namespace

GibbsKeywords TableStore::readGibbs(const DataFiles& files) {
  GibbsKeywords keywords;
  keywords.tables_ = std::make_unique<Tables>();
  loadParameters(files, *keywords.tables_); // the commands name families, the variables name commands
  loadCommands(files, *keywords.tables_);
  loadDialog(files, *keywords.tables_);
  loadFunctions(files, *keywords.tables_);
  loadVariables(files, *keywords.tables_);
  loadSystemMacros(files, *keywords.tables_);
  return keywords;
}

} // namespace dotek::stdlib
