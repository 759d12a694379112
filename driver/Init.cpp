// The beginning of a project's settings.
#include "driver/Command.h"
#include "project/Lowering.h"
#include "stdlib/ControlFiles.h"
#include "support/WholeName.h"
#include "support/messages/Commands.h"

#include <filesystem>
#include <fmt/format.h>

namespace dotek::driver {
namespace {

// Each setting is a comment: settings that nobody chose change nothing.
constexpr std::string_view kBeginning =
    R"(# Settings of Dotek for this folder and all below it (docs/lint.md). Take the `# ` away from a setting to use it.
schema = 1

# The control that the programs here are written for; `dotek list controls` prints those that Dotek knows, and
# `dotek new control NAME --from ...` begins one of your own.
{}
# The post of the cycles' folders here, and what its Form decides (`dotek list forms`).
# prog = "posts/mill.txt"
# form = "thesis-a"

# Folders of data of your own: controls, macros, forms.
# data = ["data"]

[lint]
# The exit status is 1 from this severity on: note, warning, error or never.
# fail-on = "warning"

# Only these codes, or all; `dotek list rules` prints them, `dotek explain CODE` says why one matters.
# select = ["all"]
# ignore = ["number-without-point"]

# [lint.severity]
# feed-on-rapid = "warning"

# Parts of the folder with a machine of their own, or that nobody checks.
# [[lint.path]]
# path = ["lathe/**", "O91??.nc"]
# control = "fanuc-6m"
# ignore = ["number-without-point"]

# [[lint.path]]
# path = "backup/**"
# exclude = true
)";

// A file of a control is named from the folder of the dotek.toml.
std::string controlIn(const InitOptions& options) {
  if (!stdlib::isDataPath(options.control)) return options.control;
  const std::string path = std::filesystem::path(wholeName(options.control))
                               .lexically_relative(wholeName(options.folder + "/."))
                               .generic_string();
  return stdlib::isDataPath(path) ? path : "./" + path;
}

} // namespace

Outcome init(const InitOptions& options) {
  return guarded(options.common, [&](Session& session) {
    const std::string path = (std::filesystem::path(options.folder) / "dotek.toml").generic_string();
    std::error_code error;
    if (!options.force && std::filesystem::exists(std::filesystem::symlink_status(path, error)))
      session.diagnostics().report<diag::SettingsExist>({}, path);
    if (!options.control.empty()) static_cast<void>(loadControl(options.control, session));
    if (session.diagnostics().hasErrors()) return outcomeOf(session, "");
    const std::string control = options.control.empty()
                                    ? "# control = \"fanuc-31i-b\"\n"
                                    : fmt::format("control = \"{}\"\n", controlIn(options));
    Outcome outcome = outcomeOf(session, "");
    outcome.files.push_back({path, fmt::format(fmt::runtime(kBeginning), control)});
    outcome.summary = fmt::format("`{}` is written; `dotek lint {}` checks the folder", path, options.folder);
    return outcome;
  });
}

} // namespace dotek::driver
