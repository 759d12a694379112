// `dotek preview`: the dialog of a cycle's folder, or of a file of the cycle language, as a page.
#pragma once

#include "driver/Driver.h"

namespace dotek::driver {

struct PreviewOptions {
  std::vector<std::string> folders; // one: with the files of a GibbsCAM cycle; or NAME.cycle
  CommonOptions common;             // `set` and `host`: what the page shows instead of the defaults
};

// One HTML page without scripts: the controls of CycleData.dlg at their places with the values, what
// CycleData.mac says to these values, and the path that ToolPath.mac draws for them. What is not shown is a
// note in the page. Of a file of the cycle language the folder is that which `convert --to gibbs` writes.
Outcome preview(const PreviewOptions& options);

} // namespace dotek::driver
