#include "project/CycleFolder.h"
#include "project/Inputs.h"
#include "support/Files.h"
#include "support/messages/Commands.h"
#include "support/messages/Common.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace dotek::project {

namespace fs = std::filesystem;
namespace gibbs = frontend::gibbs;

namespace {

constexpr std::array<std::string_view, 4> kFiles = {"DefineData.txt", "CycleData.dlg", "CycleData.mac",
                                                    "ToolPath.mac"};

bool sameName(std::string_view a, std::string_view b) {
  return gibbs::foldCase(std::string(a)) == gibbs::foldCase(std::string(b));
}

// The entry of `folder` with this name; case does not matter on the CAM's file system.
std::optional<fs::path> findEntry(const fs::path& folder, std::string_view name) {
  std::error_code error;
  if (fs::path exact = folder / name; fs::exists(exact, error)) return exact;
  std::vector<fs::path> found;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (sameName(entry.path().filename().string(), name)) found.push_back(entry.path());
  }
  if (found.empty()) return std::nullopt;
  return *std::min_element(found.begin(), found.end());
}

// One key a file, however its path is spelt. Asks the file system for each folder on the way, so trees are
// known by their path as it was spelt as well.
std::string keyOf(const fs::path& path) {
  std::error_code error;
  const fs::path real = fs::canonical(path, error);
  return (error ? path : real).generic_string();
}

gibbs::ParseContext contextOf(Session& session) {
  return {session.sources(), session.gibbsKeywords(), session.limits(), session.diagnostics()};
}

} // namespace

MacroLoader::MacroLoader(Session& session, fs::path folder)
    : session_(session), folder_(std::move(folder)), bounds_(session.bounds(folder_.generic_string())),
      includes_([this](const std::string& name, SourceRange where) { return macro(name, where); },
                session.limits(), session.diagnostics()) {}

std::optional<fs::path> MacroLoader::find(const std::string& name, const std::string& suffix) {
  const std::string key = name + '\n' + suffix;
  if (const auto known = found_.find(key); known != found_.end()) return known->second;
  std::optional<fs::path> path = search(name, suffix);
  if (path) found_.emplace(key, *path);
  return path;
}

// In the folder, then in those of --include.
std::optional<fs::path> MacroLoader::search(const std::string& name, const std::string& suffix) const {
  std::string local = name;
  std::replace(local.begin(), local.end(), '\\', '/'); // the CAM runs on Windows
  std::optional<fs::path> found = searchIn(folder_, local, suffix);
  for (const std::string& folder : session_.options().include)
    if (!found) found = searchIn(folder, local, suffix);
  return found;
}

std::optional<fs::path> MacroLoader::searchIn(const fs::path& where, const fs::path& relative,
                                              const std::string& suffix) const {
  fs::path folder = relative.is_absolute() ? relative.parent_path() : where / relative.parent_path();
  const bool here = folder.empty();
  if (here) folder = ".";
  std::error_code error;
  if (!fs::is_directory(folder, error)) return std::nullopt;
  const std::string file = relative.filename().string();
  if (file.empty()) return std::nullopt;
  std::optional<fs::path> found = findEntry(folder, file);
  if (!found || !fs::is_regular_file(*found, error)) found = findEntry(folder, file + suffix);
  if (!found || !fs::is_regular_file(*found, error)) return std::nullopt;
  // One spelling a file: the command line says `a.mac`, not `./a.mac` or `b/../a.mac`.
  if (here) return found->filename();
  if (relative.string().find("..") == std::string::npos) return found;
  const fs::path plain = found->lexically_normal();
  return fs::equivalent(plain, *found, error) ? plain : *found;
}

// false, reported: the file is out of bounds.
bool MacroLoader::mayRead(const fs::path& path, SourceRange where) {
  if (bounds_.allow(path.string())) return true;
  session_.diagnostics().report<diag::IncludeOutside>(where, path.generic_string(), bounds_.text(),
                                                      dotek::folderName(path.generic_string()));
  return false;
}

bool MacroLoader::hasDialog(const std::string& name) const {
  return search(name, ".dlg").has_value();
}

std::string MacroLoader::folderName() const {
  return folder_.empty() ? "." : folder_.generic_string();
}

const gibbs::Macro* MacroLoader::macro(const std::string& name, SourceRange where) {
  const std::optional<fs::path> path = find(name, ".mac");
  if (!path) {
    session_.diagnostics().report<diag::MacroNotFound>(where, name, folderName());
    return nullptr;
  }
  const std::string spelt = path->generic_string();
  if (const auto known = macros_.find(spelt); known != macros_.end()) return known->second;
  const std::string key = keyOf(*path);
  if (const auto known = macros_.find(key); known != macros_.end())
    return macros_.emplace(spelt, known->second).first->second;
  const gibbs::Macro* parsed = nullptr;
  std::optional<FileId> id;
  if (mayRead(*path, where)) id = session_.read(path->generic_string(), Encoding::Cp1250);
  if (id) parsed = &ownMacros_.emplace_back(gibbs::parseMacro(*id, contextOf(session_)));
  macros_.emplace(key, parsed);
  macros_.emplace(spelt, parsed);
  return parsed;
}

const gibbs::Dialog* MacroLoader::dialog(const std::string& name, SourceRange where) {
  const std::optional<fs::path> path = find(name, ".dlg");
  if (!path) {
    session_.diagnostics().report<diag::DialogNotFound>(where, name, folderName());
    return nullptr;
  }
  const std::string spelt = path->generic_string();
  if (const auto known = dialogs_.find(spelt); known != dialogs_.end()) return known->second;
  const std::string key = keyOf(*path);
  if (const auto known = dialogs_.find(key); known != dialogs_.end())
    return dialogs_.emplace(spelt, known->second).first->second;
  const gibbs::Dialog* parsed = nullptr;
  std::optional<FileId> id;
  if (mayRead(*path, where)) id = session_.read(path->generic_string(), Encoding::Cp1250);
  if (id) parsed = &ownDialogs_.emplace_back(gibbs::parseDialog(*id, contextOf(session_)));
  dialogs_.emplace(key, parsed);
  dialogs_.emplace(spelt, parsed);
  return parsed;
}

void MacroLoader::know(const std::string& path, const gibbs::Macro& macro) {
  macros_.emplace(keyOf(path), &macro);
}

void MacroLoader::know(const std::string& path, const gibbs::Dialog& dialog) {
  dialogs_.emplace(keyOf(path), &dialog);
}

std::vector<const gibbs::Macro*> MacroLoader::included(const gibbs::Macro& macro) {
  return includes_.includedBy(macro);
}

namespace {

// What one statement calls or shows, if it names a file by a plain text.
struct Callee {
  std::string name;
  SourceRange range;
  bool dialog = false;
};

std::optional<Callee> calleeOf(const gibbs::Statement& statement) {
  if (const auto* call = std::get_if<gibbs::CallMacro>(&statement.node)) {
    if (call->macro == nullptr) return Callee{call->bareName, call->macroRange, false};
    if (const auto* text = std::get_if<gibbs::TextLiteral>(&call->macro->node))
      return Callee{text->text, call->macroRange, false};
  }
  if (const auto* command = std::get_if<gibbs::Command>(&statement.node)) {
    if (gibbs::foldCase(command->name.text) != "DIALOG" || command->arguments.size() != 1)
      return std::nullopt;
    if (const auto* text = std::get_if<gibbs::TextLiteral>(&command->arguments.front()->node))
      return Callee{text->text, command->arguments.front()->range, true};
  }
  return std::nullopt;
}

void collectCallees(const gibbs::Statement& statement, std::vector<Callee>& out) {
  if (std::optional<Callee> callee = calleeOf(statement)) out.push_back(std::move(*callee));
  const auto* branch = std::get_if<gibbs::If>(&statement.node);
  if (branch == nullptr) return;
  if (branch->then) collectCallees(*branch->then, out);
  if (branch->elseStatement) collectCallees(*branch->elseStatement, out);
  for (const auto* block : {&branch->thenBlock, &branch->elseBlock}) {
    for (const gibbs::Line& line : *block) {
      if (line.statement) collectCallees(*line.statement, out);
    }
  }
}

template <class File> void addOnce(std::vector<const File*>& files, const File* file) {
  if (file != nullptr && std::find(files.begin(), files.end(), file) == files.end()) files.push_back(file);
}

// Takes a macro and, once each, the macros that it includes or calls; they become files of the cycle.
void addWithCallees(const gibbs::Macro& macro, CycleFolder& folder, const gibbs::ParseContext& context) {
  gibbs::Cycle& cycle = *folder.cycle;
  std::vector<const gibbs::Macro*> waiting{&macro};
  std::vector<const gibbs::Macro*> done;
  while (!waiting.empty()) {
    const gibbs::Macro* next = waiting.back();
    waiting.pop_back();
    if (std::find(done.begin(), done.end(), next) != done.end()) continue;
    done.push_back(next);
    const auto included = folder.loader->included(*next);
    folder.checked.emplace_back(*next, included, context);
    std::vector<Callee> callees;
    for (const gibbs::Line& line : next->lines) {
      if (line.statement) collectCallees(*line.statement, callees);
    }
    for (const Callee& callee : callees) {
      if (callee.dialog) {
        // A file of the folder that is missing was reported; checkCycle says what CycleData.mac misses.
        const bool plain = callee.name.find_first_of("/\\") == std::string::npos;
        const bool told =
            gibbs::foldCase(callee.name) == "CYCLEDATA.DLG" || (cycle.cycleData && next == &*cycle.cycleData);
        if (plain && told && !folder.loader->hasDialog(callee.name)) continue;
        const gibbs::Dialog* dialog = folder.loader->dialog(callee.name, callee.range);
        if (!cycle.dialog || dialog != &*cycle.dialog) addOnce(cycle.otherDialogs, dialog);
      } else if (const gibbs::Macro* called = folder.loader->macro(callee.name, callee.range)) {
        waiting.push_back(called);
      }
    }
    for (const gibbs::Macro* one : included) {
      addOnce(cycle.others, one);
      waiting.push_back(one);
    }
    if (next != &macro) addOnce(cycle.others, next);
  }
}

} // namespace

namespace {

// "`mill/O1`, `mill/b.nc` and more"; "" where the folder holds no program.
std::string programsIn(const fs::path& folder, Session& session) {
  constexpr std::size_t kNames = 3;
  std::vector<std::string> paths;
  std::error_code error;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    std::error_code ignored;
    if (at->is_regular_file(ignored)) paths.push_back(at->path().generic_string());
  }
  std::sort(paths.begin(), paths.end());
  std::string out;
  std::size_t count = 0;
  for (const std::string& path : paths) {
    Diagnostics unread;
    const Recognition* const kind = session.kindOf(path, unread);
    if (kind == nullptr || (kind->kind != InputKind::Nc && kind->kind != InputKind::Suf)) continue;
    if (count++ == kNames) return out + " and more";
    out += (out.empty() ? "`" : ", `") + path + "`";
  }
  return out;
}

} // namespace

std::optional<fs::path> cycleFile(const fs::path& folder, std::string_view name) {
  return findEntry(folder, name);
}

bool isCycleFolder(const fs::path& path) {
  std::error_code error;
  if (!fs::is_directory(path, error)) return false;
  return std::any_of(kFiles.begin(), kFiles.end(), [&](std::string_view name) {
    const auto file = findEntry(path, name);
    return file && !isStream(file->generic_string()); // a pipe in a folder is not read
  });
}

namespace {

// A folder that holds those of cycles is easily named in their place.
void noteCyclesWithin(Diagnostic& missing, const std::string& path, const fs::path& folder) {
  std::error_code error;
  std::vector<std::string> cycles;
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (isCycleFolder(entry.path()))
      cycles.push_back((fs::path(path) / entry.path().filename()).generic_string());
  if (cycles.empty()) return;
  std::sort(cycles.begin(), cycles.end());
  constexpr std::size_t kShown = 4;
  std::string names;
  for (std::size_t i = 0; i < cycles.size() && i < kShown; ++i)
    names += (i > 0 ? ", `" : "`") + cycles[i] + "`";
  if (cycles.size() > kShown) names += fmt::format(" and {} more", cycles.size() - kShown);
  missing.note({}, "cycles are in folders of this one; name one of them: " + names);
}

} // namespace

bool isFolderOfPrograms(const std::string& path, Session& session) {
  std::error_code error;
  if (!fs::is_directory(path, error) || isCycleFolder(path)) return false;
  const std::string programs = programsIn(path, session);
  if (!programs.empty()) session.diagnostics().report<diag::FolderOfPrograms>({}, path, programs);
  return !programs.empty();
}

CycleFolder loadCycleFolder(const std::string& path, Session& session, bool checked) {
  CycleFolder folder;
  std::error_code error;
  fs::path real(path);
  if (!fs::exists(real, error)) {
    session.diagnostics().report<diag::FileNotFound>({}, path);
    return folder;
  }
  if (!fs::is_directory(real, error)) {
    session.diagnostics().report<diag::NotAFolder>({}, path);
    return folder;
  }
  if (!real.has_filename()) real = real.parent_path();
  folder.name = real.filename().string();
  if (folder.name == "." || folder.name == "..") folder.name = fs::canonical(real, error).filename().string();
  folder.place = session.sources().add(SourceFile(path, "", Encoding::Utf8));
  folder.complete = true;

  std::array<std::optional<FileId>, 4> ids;
  std::string missing;
  for (std::size_t i = 0; i < kFiles.size(); ++i) {
    const std::optional<fs::path> file = findEntry(real, kFiles[i]);
    if (!file) {
      missing += (missing.empty() ? "`" : ", `") + std::string(kFiles[i]) + "`";
      folder.complete = false;
      continue;
    }
    if (!refusesStream(file->generic_string(), {}, session))
      ids[i] = session.read(file->generic_string(), Encoding::Cp1250);
    if (!ids[i]) folder.complete = false;
  }
  const bool none = std::none_of(ids.begin(), ids.end(), [](const auto& id) { return id.has_value(); });
  const std::string programs = none ? programsIn(real, session) : "";
  if (!programs.empty())
    session.diagnostics().report<diag::FolderOfPrograms>({folder.place, 0, 0}, path, programs);
  else if (!missing.empty())
    noteCyclesWithin(
        session.diagnostics().report<diag::CycleFileMissing>({folder.place, 0, 0}, path, missing), path,
        real);
  folder.cycle = std::make_unique<gibbs::Cycle>();
  gibbs::Cycle& cycle = *folder.cycle;
  cycle.name = folder.name;
  cycle.folder = path;
  for (const auto& entry : fs::directory_iterator(real, error))
    cycle.files.insert(gibbs::foldCase(entry.path().filename().string()));
  // Told already where it is missing.
  for (const std::string_view name : kFiles)
    cycle.files.insert(gibbs::foldCase(std::string(name)));
  folder.loader = std::make_unique<MacroLoader>(session, real);
  const gibbs::ParseContext context = contextOf(session);
  const auto pathOf = [&](FileId id) { return session.sources().file(id).name(); };
  if (ids[0]) cycle.defineData = gibbs::parseDefineData(*ids[0], context);
  if (ids[1]) {
    cycle.dialog = gibbs::parseDialog(*ids[1], context);
    folder.loader->know(pathOf(*ids[1]), *cycle.dialog);
  }
  if (ids[2]) {
    cycle.cycleData = gibbs::parseMacro(*ids[2], context);
    folder.loader->know(pathOf(*ids[2]), *cycle.cycleData);
  }
  if (ids[3]) {
    cycle.toolPath = gibbs::parseMacro(*ids[3], context);
    folder.loader->know(pathOf(*ids[3]), *cycle.toolPath);
  }
  if (cycle.defineData) folder.checked.emplace_back(*cycle.defineData, context);
  if (cycle.dialog) folder.checked.emplace_back(*cycle.dialog, context);
  for (const auto* macro : {&cycle.cycleData, &cycle.toolPath}) {
    if (*macro) addWithCallees(**macro, folder, context);
  }
  if (checked) {
    for (const gibbs::CheckedFile& file : folder.checked)
      runChecks(gibbs::fileChecks(), file, session.diagnostics());
    gibbs::checkCycle(cycle, context);
  }
  return folder;
}

} // namespace dotek::project
