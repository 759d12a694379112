#!/usr/bin/env bash
# smoke.sh DEB: installs the package in a bare Debian 12 of its own and uses the program there. Root and mmdebstrap, and a mirror.
set -euo pipefail
deb=$(realpath "$1")
root=$(mktemp -d)
trap 'rm -rf "$root"' EXIT
chmod 755 "$root"
printf 'bare Debian 12, with the package and what it depends on\n'
sources=()
[[ -z ${DOTEK_MIRROR:-} ]] || sources=("$DOTEK_MIRROR")
mmdebstrap --quiet --variant=minbase bookworm "$root" "${sources[@]}"
cp "$deb" "$root/dotek.deb"
chroot "$root" apt-get update -qq
chroot "$root" apt-get install -y -qq --no-install-recommends /dotek.deb >"$root/log" 2>&1 || { cat "$root/log" >&2; exit 1; }
chroot "$root" /bin/bash -euo pipefail <<'TXT'
cd /usr/share/doc/dotek/examples
dotek --version
dotek lint surface-x --quiet
dotek post surface-x --prog post.txt --routine probe --clearance 5 --set G=54 | tail -n 3
dotek convert surface-x --prog post.txt --to fanuc --verify -o /surface-x.nc
dotek sim macros/bore.nc --call "D30. Z-5. S55" --part macros/plate.toml --machine macros/mill.toml --at 30,40,10 --var 520=5.97 --quiet \
  --html /bore.html
test -s /surface-x.nc -a -s /bore.html
test -s /usr/share/man/man1/dotek-lint.1.gz -a -s /usr/share/bash-completion/completions/dotek
if ldd /usr/bin/dotek | grep 'not found'; then exit 1; fi
TXT
chroot "$root" dpkg --verify dotek
chroot "$root" apt-get remove -y -qq dotek >"$root/log" 2>&1
test ! -e "$root/usr/bin/dotek"
printf 'installed, used and removed\n'
