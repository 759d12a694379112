-- Starts `dotek lsp` for the files that Dotek reads. Neovim 0.7 or later:
--   :luafile editors/nvim/dotek.lua       or copy it to ~/.config/nvim/plugin/dotek.lua
-- Keys and the command :Dotek are in docs/editor.md; `vim.g.dotek_keys = false` leaves the keys out,
-- `vim.g.dotek_path` is the program where it is not on PATH.
local patterns = {
  "*.nc", "*.NC", "*.cnc", "*.CNC", "*.tap", "*.TAP", "*.eia", "*.EIA", "*.prg", "*.PRG", "*.min", "*.MIN", "*.ncc", "*.NCC",
  "*.ncf", "*.NCF", "*.iso", "*.ISO", "*.dnc", "*.DNC", "*.fan", "*.FAN", "*.pim", "*.PIM",
  "O[0-9][0-9][0-9][0-9]*", "o[0-9][0-9][0-9][0-9]*",
  "*.suf", "*.SUF", "*.sou", "*.SOU", "*.fcb", "*.FCB", "*.cycle", "*.cps", "*.mac", "*.MAC", "*.dlg", "*.DLG",
  "[Dd]efine[Dd]ata.txt", "DEFINEDATA.TXT", "*[Pp]ost*.txt", "*[Pp]rog*.txt",
}
local commands = { "post", "convert", "run", "verify", "preview" }
local last_messages = ""

-- What a command gives, beside the text: a window that `q` closes, or for a page the browser.
local function show(result)
  if result.language == "html" then
    local file = vim.fn.tempname() .. ".html"
    vim.fn.writefile(vim.split(result.text, "\n"), file)
    if vim.ui.open then
      vim.ui.open(file)
    else
      vim.fn.jobstart({ vim.fn.has("mac") == 1 and "open" or "xdg-open", file }, { detach = true })
    end
    print("Dotek: the page is " .. file .. " until Neovim ends")
    return
  end
  local origin = vim.api.nvim_get_current_win()
  local name = "dotek://" .. result.title
  local buffer = vim.fn.bufnr("^" .. name .. "$")
  if buffer == -1 then
    buffer = vim.api.nvim_create_buf(false, true)
    vim.api.nvim_buf_set_name(buffer, name)
  end
  local window = vim.fn.bufwinid(buffer)
  if window == -1 then
    vim.cmd("vertical belowright split")
    window = vim.api.nvim_get_current_win()
    vim.api.nvim_win_set_buf(window, buffer)
  end
  vim.bo[buffer].modifiable = true
  local text = result.text:gsub("\r?\n$", "")
  vim.api.nvim_buf_set_lines(buffer, 0, -1, false, vim.split(text, "\r?\n"))
  vim.bo[buffer].modifiable = false
  vim.bo[buffer].bufhidden = "wipe"
  vim.bo[buffer].filetype = result.language == "markdown" and "markdown" or ""
  vim.api.nvim_buf_set_keymap(buffer, "n", "q", "<Cmd>close<CR>", { silent = true })
  if vim.api.nvim_win_is_valid(origin) then
    vim.api.nvim_set_current_win(origin)
  end
end

local function client_of(buffer)
  for _, client in pairs((vim.lsp.get_clients or vim.lsp.buf_get_clients)(vim.lsp.get_clients and { bufnr = buffer } or buffer)) do
    if client.name == "dotek" then
      return client
    end
  end
end

local function request(client, method, params, buffer, done)
  local handler = function(failure, result)
    if failure then
      vim.notify("Dotek: " .. failure.message, vim.log.levels.ERROR)
    elseif result then
      done(result)
    end
  end
  if vim.fn.has("nvim-0.11") == 1 then
    client:request(method, params, handler, buffer)
  else
    client.request(method, params, handler, buffer)
  end
end

-- The gravest of the messages of a command, and how many there are.
local function told(result)
  last_messages = result.messages or ""
  local lines, worst = {}, 1
  for _, line in ipairs(vim.split(result.messages or "", "\n")) do
    for rank, kind in ipairs({ ": error: ", ": warning: ", ": note: " }) do
      if line:find(kind, 1, true) then
        table.insert(lines, { rank, line })
        if rank < lines[worst][1] then
          worst = #lines
        end
        break
      end
    end
  end
  if #lines == 0 or (result.status == 0 and lines[worst][1] == 3) then
    return
  end
  local more = #lines > 1 and string.format(" (1 of %d messages; :Dotek messages shows all)", #lines) or ""
  vim.notify("Dotek: " .. lines[worst][2] .. more, vim.log.levels.WARN)
end

-- Runs a command on the text of a buffer. Values that it refuses to do without are asked for, once each.
local function run(name, options, buffer, asked)
  buffer = (buffer == nil or buffer == 0) and vim.api.nvim_get_current_buf() or buffer
  local client = client_of(buffer)
  if not client then
    vim.notify("Dotek does not serve this buffer", vim.log.levels.WARN)
    return
  end
  local params = vim.tbl_extend("force", { command = name, format = name == "preview" and "html" or "text" }, options or {})
  params.textDocument = { uri = vim.uri_from_bufnr(buffer) }
  -- In a Prog the cycle of the branch that the cursor is in.
  params.position = params.position or { line = vim.api.nvim_win_get_cursor(0)[1] - 1, character = 0 }
  request(client, "dotek/run", params, buffer, function(result)
    asked = asked or {}
    local given = false
    for _, one in ipairs(result.missing or {}) do
      local key = one.option .. " " .. one.name
      if not asked[key] and #vim.api.nvim_list_uis() > 0 then
        asked[key] = true
        local answer = vim.fn.input(one.title .. "\n" .. one.name .. " = ")
        if answer ~= "" and one.option == "call" then
          params.call, given = answer, true
        elseif answer ~= "" then
          params[one.option] = params[one.option] or {}
          params[one.option][one.name], given = answer, true
        end
      end
    end
    if given then
      run(name, params, buffer, asked)
      return
    end
    show(result)
    told(result)
  end)
end

local function explain(code)
  local client = client_of(vim.api.nvim_get_current_buf())
  if client then
    request(client, "workspace/executeCommand", { command = "dotek.explain", arguments = { code } }, 0, function(result)
      if result.status == 0 then
        show(result)
      else
        told(result)
      end
    end)
  end
end

-- Lenses and code actions call these by name.
for _, name in ipairs(commands) do
  vim.lsp.commands["dotek." .. name] = function(command, context)
    local given = command.arguments or {}
    local target = given[2] ~= vim.NIL and given[2] or nil
    run(name, { target = target, cycle = given[3] }, context and context.bufnr)
  end
end
vim.lsp.commands["dotek.explain"] = function(command)
  explain(command.arguments[1])
end

-- :Dotek run [html] [target], :Dotek explain [code], :Dotek messages
local function dotek(arguments)
  local name, options = arguments[1] or "run", {}
  if name == "explain" then
    local here = vim.diagnostic.get(0, { lnum = vim.api.nvim_win_get_cursor(0)[1] - 1 })[1]
    local code = arguments[2] or (here and here.code)
    if code then
      explain(code)
    else
      vim.notify("Dotek: no finding is in this line", vim.log.levels.WARN)
    end
    return
  end
  if name == "messages" then
    show({ title = "messages", language = "plaintext", text = last_messages })
    return
  end
  for i = 2, #arguments do
    if arguments[i] == "html" or arguments[i] == "text" then
      options.format = arguments[i]
    else
      options.target = arguments[i]
    end
  end
  run(name, options)
end

local function attached(buffer)
  vim.bo[buffer].omnifunc = "v:lua.vim.lsp.omnifunc"
  vim.bo[buffer].tagfunc = "v:lua.vim.lsp.tagfunc"
  if vim.api.nvim_buf_create_user_command then
    vim.api.nvim_buf_create_user_command(buffer, "Dotek", function(call)
      dotek(call.fargs)
    end, {
      nargs = "*",
      complete = function()
        return { "post", "convert", "run", "verify", "preview", "explain", "messages" }
      end,
    })
  end
  vim.api.nvim_create_autocmd({ "BufEnter", "InsertLeave", "BufWritePost" }, {
    buffer = buffer,
    callback = function()
      if client_of(buffer) then
        pcall(vim.lsp.codelens.refresh)
      end
    end,
  })
  if vim.g.dotek_keys == false then
    return
  end
  local keys = {
    K = "vim.lsp.buf.hover()",
    gd = "vim.lsp.buf.definition()",
    gr = "vim.lsp.buf.references()",
    ["[d"] = "vim.diagnostic.goto_prev()",
    ["]d"] = "vim.diagnostic.goto_next()",
    ["<LocalLeader>d"] = "vim.diagnostic.open_float()",
    ["<LocalLeader>a"] = "vim.lsp.buf.code_action()",
    ["<LocalLeader>n"] = "vim.lsp.buf.rename()",
    ["<LocalLeader>l"] = "vim.lsp.codelens.run()",
    ["<LocalLeader>s"] = "vim.lsp.buf.document_symbol()",
  }
  for key, call in pairs(keys) do
    vim.api.nvim_buf_set_keymap(buffer, "n", key, "<Cmd>lua " .. call .. "<CR>", { silent = true })
  end
  vim.api.nvim_buf_set_keymap(buffer, "n", "<LocalLeader>e", "<Cmd>Dotek explain<CR>", { silent = true })
  vim.api.nvim_buf_set_keymap(buffer, "n", "<LocalLeader>r", "<Cmd>Dotek run<CR>", { silent = true })
end

vim.api.nvim_create_autocmd({ "BufReadPost", "BufNewFile" }, {
  pattern = patterns,
  callback = function(event)
    local client = vim.g.dotek_client
    if client == nil or vim.lsp.get_client_by_id(client) == nil then
      client = vim.lsp.start_client({
        name = "dotek",
        cmd = { vim.g.dotek_path or "dotek", "lsp" },
        root_dir = vim.fn.getcwd(),
        on_attach = function(_, buffer)
          attached(buffer)
          pcall(vim.lsp.codelens.refresh)
        end,
      })
      vim.g.dotek_client = client
    end
    if client ~= nil then
      vim.lsp.buf_attach_client(event.buf, client)
    end
  end,
})
