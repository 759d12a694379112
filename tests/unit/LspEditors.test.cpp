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
-- A lens opens its result beside the text, and the text keeps the cursor.
local uri, buffer = vim.uri_from_bufnr(0), vim.api.nvim_get_current_buf()
vim.lsp.commands["dotek.run"]({ command = "dotek.run", arguments = { uri } }, { bufnr = 0 })
local beside = function() return vim.fn.bufwinid("^dotek://run$") end
vim.wait(20000, function() return beside() ~= -1 end, 20)
io.write("run: ", table.concat(vim.api.nvim_buf_get_lines(vim.api.nvim_win_get_buf(beside()), 0, -1, false), "|"), "\n")
io.write("cursor: ", tostring(vim.api.nvim_get_current_buf() == buffer), "\n")
vim.cmd("3")
vim.cmd("Dotek explain")
vim.wait(20000, function() return vim.fn.bufwinid("^dotek://goto-target-missing$") ~= -1 end, 20)
io.write("page: ", tostring(vim.fn.bufwinid("^dotek://goto-target-missing$") ~= -1), "\n")
io.write("key: ", vim.fn.maparg("gd", "n"), "\n")
vim.cmd("qa!")
)LUA");
  const ShellResult result =
      folder.run("PATH=\"$(dirname \"$DOTEK\"):$PATH\" nvim --headless -u NONE -i NONE --cmd 'luafile " +
                 (root() / "editors/nvim/dotek.lua").string() + "' O7301.nc -c 'luafile look.lua'");
  const std::string text = result.out + result.err;
  CHECK_MESSAGE(text.find("2 goto-target-missing") != std::string::npos, text);
  CHECK_MESSAGE(text.find("**G0** positioning") != std::string::npos, text);
  CHECK_MESSAGE(text.find("run: rapid X0.000000 Y0.000000 Z5.000000|alarm 128") != std::string::npos, text);
  CHECK_MESSAGE(text.find("cursor: true") != std::string::npos, text);
  CHECK_MESSAGE(text.find("page: true") != std::string::npos, text);
  CHECK_MESSAGE(text.find("vim.lsp.buf.definition") != std::string::npos, text);
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
