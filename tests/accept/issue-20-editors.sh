#!/usr/bin/env bash
# Issue 20: clients that are not ours against `dotek lsp`: Neovim without a window, and the libraries of Visual Studio
# Code, for which `npm ci` has run in editors/vscode. The package of the extension is made, too.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
. tests/accept/checks.sh

tests=$(dirname "$DOTEK")/dotek_tests
export DOTEK
timeout 300 "$tests" -tc='lsp: a headless Neovim*,lsp: the extension*' >"$out" 2>&1 && status=0 || status=$?
check "Neovim and the client of Visual Studio Code see what the server sends" hasStatus 0
check "both were there" says "other cases skipped: 0"

(cd editors/vscode && timeout 120 npm run package) >"$out" 2>"$err" && status=0 || status=$?
check "the extension is packed without the network" hasStatus 0
check "as a .vsix" says ".vsix"

finish
