// What the editor has open, and what Dotek finds there.
#pragma once

#include "driver/Driver.h"
#include "lsp/Index.h"
#include "lsp/Places.h"

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace dotek::lsp {

struct Document {
  std::string path; // absolute, without dots
  std::string uri;  // as the editor writes it
  std::string language;
  std::int64_t version = 0;
};

// One finding as the editor gets it, with what its repairs are made from.
struct Found {
  Json diagnostic;
  std::string code;
  SourceRange range;      // of the file's text when it was checked
  std::uint32_t line = 0; // from 0
  bool safe = false;
  std::string title;                 // of the repair; "" where there is none
  std::map<std::string, Json> edits; // by path: TextEdits
};

class Workspace {
public:
  // `scriptProgram`: runs scripts, as in CommonOptions.
  explicit Workspace(std::string scriptProgram);

  Units units = Units::Utf16;
  bool showsDisabled = false; // the editor shows actions that cannot be made, with the reason

  // false: no file of this machine, which is not looked at.
  bool open(const std::string& uri, const std::string& language, std::int64_t version, std::string text);
  // Changes as didChange gives them. false: the document is not open, or a change is no such.
  bool change(const std::string& uri, std::int64_t version, const Json& changes);
  void close(const std::string& uri);
  // Something changed outside of the editor: all is looked at again.
  void touchAll();

  const Document* find(const std::string& uri) const; // nullptr: not open
  const std::string& text(const Document& document) const { return buffers_->at(document.path); }
  const std::map<std::string, Document>& documents() const { return documents_; }

  // Lints what has changed since the last time; notifications of textDocument/publishDiagnostics.
  std::vector<Json> check();
  bool hasChanges() const { return !changed_.empty(); }
  const std::vector<Found>& found(const std::string& path) const;

  // Names, symbols and hints of a document as it is now; kept until it changes.
  const Index& index(const Document& document);
  // The same of a file that may not be open; of such a file it is kept until the file changes.
  const Index& indexOf(const std::string& path);
  // The other files of the document's cycle.
  std::vector<std::string> companions(const Document& document) const;
  // Files of this kind in the folder of the document, itself left out.
  std::vector<std::string> beside(const Document& document, project::InputKind kind);
  // Folders of GibbsCAM cycles beside the file and one folder up.
  static std::vector<std::string> cycleFolders(const std::string& path);
  // The Prog that dotek.toml names for a file or a folder; "": none.
  static std::string postOf(const std::string& path);

  // Options that a command takes for inputs of this workspace.
  driver::CommonOptions options(const std::vector<std::string>& inputs) const;
  // The folder of the GibbsCAM cycle that the file is part of, else the file.
  static std::string unitOf(const std::string& path);

private:
  // The unit with what is checked together with it: a cycle's folder with the Prog that dotek.toml names for
  // it, such a Prog with the folders that it prints. The unit is the first.
  static std::vector<std::string> inputsOf(const std::string& unit);
  Json publish(const std::string& path, const std::vector<Found>& found) const;
  // What was found in the first input, not in the others; `otherwise`: the path that takes what has no place
  // in a text.
  void keep(const driver::Outcome& outcome, const std::vector<std::string>& inputs,
            const std::string& otherwise, std::map<std::string, std::vector<Found>>& byPath) const;
  std::string& writable(const std::string& path);
  void readKinds();
  void changed(const std::string& path);

  std::string scriptProgram_;
  std::map<std::string, Document> documents_; // by uri
  // Replaced and not changed where a command may still read it.
  std::shared_ptr<std::map<std::string, std::string>> buffers_;
  std::shared_ptr<const std::map<std::string, std::string>> kinds_; // CommonOptions::bufferKinds
  std::set<std::string> changed_;                                   // units
  std::map<std::string, std::set<std::string>> told_;               // by unit: paths that have findings
  std::map<std::string, std::vector<Found>> found_;                 // by path
  std::map<std::string, std::unique_ptr<Index>> indices_;           // by path
  struct OnDisk {
    std::filesystem::file_time_type time;
    std::uintmax_t size = 0;
    std::unique_ptr<Index> index;
  };
  std::map<std::string, OnDisk> onDisk_; // of files that are not open
};

} // namespace dotek::lsp
