#include "support/OutputCheck.h"

#include "support/FileIdentity.h"
#include "support/messages/Output.h"

#include <algorithm>
#include <fstream>
#include <map>
#include <string_view>
#include <unistd.h>

namespace dotek {
namespace {

// Two that go to one stream of the process, or into one file or pipe.
bool meet(const OutputName& a, const OutputName& b) {
  const int stream = descriptorOf(a.path);
  if (stream >= 0 && stream == descriptorOf(b.path)) return true;
  const auto file = identify(a.path);
  return file && file == identify(b.path);
}

// Only files that are there: an input that is missing is reported by who reads it.
std::map<FileIdentity, std::string> filesOf(const std::vector<std::string>& inputs) {
  std::map<FileIdentity, std::string> out;
  for (const std::string& input : inputs)
    if (const auto file = identify(input == "-" ? "/dev/stdin" : input); file && file->name.empty())
      out.emplace(*file, input);
  return out;
}

bool overwrites(const std::string& path, const std::map<FileIdentity, std::string>& inputs,
                Diagnostics& diagnostics) {
  if (descriptorOf(path) >= 0) return false;
  const auto file = identify(path);
  const auto at = file ? inputs.find(*file) : inputs.end();
  if (at == inputs.end()) return false;
  diagnostics.report<diag::OutputIsInput>({}, path, at->second);
  return true;
}

} // namespace

bool checkOutputs(const std::vector<OutputName>& outputs, const std::vector<std::string>& inputs, bool force,
                  Diagnostics& diagnostics) {
  const std::map<FileIdentity, std::string> files = filesOf(inputs);
  const OutputName messages{"standard error", "/dev/stderr"};
  bool good = true;
  for (auto one = outputs.begin(); one != outputs.end(); ++one) {
    // An input is reported as such, also where it is write-protected.
    if (overwrites(one->path, files, diagnostics) || !Output::check(one->path, force, diagnostics)) {
      good = false;
      continue;
    }
    const auto twin =
        std::find_if(outputs.begin(), one, [&](const OutputName& other) { return meet(*one, other); });
    const bool withMessages = descriptorOf(one->path) < 0 && meet(*one, messages);
    if (twin == one && !withMessages) continue;
    diagnostics.report<diag::OutputGivenTwice>({}, twin == one ? messages.name : twin->name, one->name);
    good = false;
  }
  return good;
}

std::set<std::string> heldByOthers(const std::vector<OutputFile>& files, const std::string& folder,
                                   Diagnostics& diagnostics) {
  std::set<std::string> out;
  for (const OutputFile& file : files) {
    const std::string path = folder + "/" + file.name;
    if (folder.empty() || file.mark.empty()) continue;
    std::ifstream stream(path, std::ios::binary);
    constexpr std::size_t kMost = 4096; // a mark is at the head of its file
    std::string head(kMost, '\0');
    stream.read(head.data(), static_cast<std::streamsize>(kMost));
    head.resize(static_cast<std::size_t>(stream.gcount()));
    std::erase(head, '\r');
    if (head.empty() || ("\n" + head).find("\n" + file.mark + "\n") != std::string::npos) continue;
    // Its first line with a word says what it is.
    std::string_view line;
    for (std::string_view rest = head; !rest.empty() && line.size() < 3;) {
      line = rest.substr(0, rest.find('\n'));
      rest.remove_prefix(std::min(rest.size(), line.size() + 1));
    }
    constexpr std::size_t kMostShown = 60;
    diagnostics.report<diag::OutputOfAnother>({}, path, line.substr(0, kMostShown));
    out.insert(file.name);
  }
  return out;
}

bool checkRead(const std::vector<std::string>& paths, const SourceMap& sources, Diagnostics& diagnostics) {
  if (std::all_of(paths.begin(), paths.end(),
                  [](const std::string& path) { return descriptorOf(path) >= 0; }))
    return true;
  std::vector<std::string> inputs;
  for (FileId file = 0; file < sources.size(); ++file)
    inputs.push_back(sources.file(file).name());
  const std::map<FileIdentity, std::string> files = filesOf(inputs);
  return std::none_of(paths.begin(), paths.end(),
                      [&](const std::string& path) { return overwrites(path, files, diagnostics); });
}

} // namespace dotek
