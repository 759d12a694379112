// Real clients of the language server, where they are installed: Neovim, and the libraries of Visual Studio
// Code.
#include "tests/GoldenRunner.h"
#include "tests/Process.h"
#include "tests/Skips.h"

#include <doctest/doctest.h>
#include <filesystem>

using namespace dotek::tests;

TEST_CASE("lsp: a headless Neovim shows findings and hover") {
  const ProcessFolder folder;
  if (folder.run("command -v nvim").status != 0) {
    skip("there is no nvim");
    return;
  }
  folder.write("O7301.nc", "O7301(VICE)\nG0Z5.\nGOTO40\nN30M99\n");
  folder.write("look.lua", R"LUA(
vim.wait(20000, function() return #vim.diagnostic.get(0) > 0 end, 20)
for _, d in ipairs(vim.diagnostic.get(0)) do io.write(d.lnum, " ", d.code or "", "\n") end
local params = { textDocument = vim.lsp.util.make_text_document_params(), position = { line = 1, character = 1 } }
for _, answer in pairs(vim.lsp.buf_request_sync(0, "textDocument/hover", params, 20000) or {}) do
  io.write(answer.result.contents.value:match("[^\n]*"), "\n")
end
vim.cmd("qa!")
)LUA");
  const ShellResult result =
      folder.run("PATH=\"$(dirname \"$DOTEK\"):$PATH\" nvim --headless -u NONE -i NONE --cmd 'luafile " +
                 (root() / "editors/nvim/dotek.lua").string() + "' O7301.nc -c 'luafile look.lua'");
  const std::string text = result.out + result.err;
  CHECK_MESSAGE(text.find("2 goto-target-missing") != std::string::npos, text);
  CHECK_MESSAGE(text.find("**G0** positioning") != std::string::npos, text);
}

TEST_CASE("lsp: the extension for Visual Studio Code, its grammars and its protocol") {
  const std::filesystem::path folder = root() / "editors/vscode";
  if (!std::filesystem::exists(folder / "node_modules/vscode-jsonrpc")) {
    skip("`npm ci` was not run in editors/vscode");
    return;
  }
  const ProcessFolder shell;
  for (const char* test : {"grammars.mjs", "server.mjs"}) {
    const ShellResult result = shell.run("export DOTEK; node " + (folder / "test" / test).string());
    CHECK_MESSAGE(result.status == 0, result.out << result.err);
  }
}
