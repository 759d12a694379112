-- Starts `dotek lsp` for the files that Dotek reads. Neovim 0.7 or later:
--   :luafile editors/nvim/dotek.lua       or copy it to ~/.config/nvim/plugin/dotek.lua
local patterns = {
  "*.nc", "*.NC", "*.cnc", "*.CNC", "*.tap", "*.TAP", "*.eia", "*.EIA", "*.prg", "*.PRG", "O[0-9][0-9][0-9][0-9]*",
  "*.suf", "*.SUF", "*.cycle", "*.mac", "*.dlg", "DefineData.txt", "*post*.txt",
}

vim.api.nvim_create_autocmd({ "BufReadPost", "BufNewFile" }, {
  pattern = patterns,
  callback = function(event)
    local client = vim.g.dotek_client
    if client == nil or vim.lsp.get_client_by_id(client) == nil then
      client = vim.lsp.start_client({ name = "dotek", cmd = { "dotek", "lsp" }, root_dir = vim.fn.getcwd() })
      vim.g.dotek_client = client
    end
    if client ~= nil then
      vim.lsp.buf_attach_client(event.buf, client)
    end
  end,
})
