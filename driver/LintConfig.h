// dotek.toml: what a project wants of the linter.
#pragma once

#include "driver/Command.h"
#include "driver/Driver.h"

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>

namespace dotek::driver {

struct LintConfig {
  std::optional<std::set<std::string>> select;
  std::set<std::string> ignore;
  std::map<std::string, std::optional<Severity>, std::less<>> severity; // nothing: off
  std::optional<FailOn> failOn;
  std::string control, form; // "": not said
};

// The dotek.toml of each file: the first one in its folder or above.
class LintConfigs {
public:
  explicit LintConfigs(Session& session) : session_(session) {}

  // For a file or a folder, by its path. A defect of the file is reported. Never null.
  const LintConfig* of(const std::string& path);

private:
  std::shared_ptr<const LintConfig> load(const std::string& path);
  std::shared_ptr<const LintConfig> inFolder(const std::string& folder);

  Session& session_;
  std::map<std::string, std::shared_ptr<const LintConfig>> folders_; // by absolute path
};

// Whether findings of this code are wanted, and with which severity.
bool isWanted(std::string_view code, const LintOptions& options, const LintConfig& config);

} // namespace dotek::driver
