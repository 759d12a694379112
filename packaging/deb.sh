#!/usr/bin/env bash
# deb.sh BUILD OUT: the Debian package of the program in BUILD as OUT/dotek_VERSION_ARCH.deb; prints its path. Builds nothing. The same
# program and the same commit give the same bytes.
set -euo pipefail
source=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=$(cd "$1" && pwd)
mkdir -p "$2"
out=$(cd "$2" && pwd)
umask 022
export LC_ALL=C.UTF-8 TZ=UTC
if [[ -z ${SOURCE_DATE_EPOCH:-} ]]; then
  SOURCE_DATE_EPOCH=$(git -C "$source" log -1 --format=%ct 2>/dev/null) || SOURCE_DATE_EPOCH=$(stat -c %Y "$source/CHANGELOG.md")
fi
export SOURCE_DATE_EPOCH
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
tree=$folder/tree

DESTDIR=$tree cmake --install "$build" --prefix /usr --component program --strip >"$folder/log" 2>&1 || { cat "$folder/log" >&2; exit 1; }
if grep -A3 Warning "$folder/log" >&2; then exit 1; fi
version=$("$build/dotek" --version | cut -d' ' -f2)
arch=$(dpkg --print-architecture)
doc=$tree/usr/share/doc/dotek
{
  printf 'Dotek itself:\n\n'
  cat "$doc/LICENSE"
  printf '\n'
  cat "$doc/notices.txt"
} >"$doc/copyright"
rm "$doc/LICENSE" "$doc/notices.txt"
gzip -9n "$doc/CHANGELOG.md" && mv "$doc/CHANGELOG.md.gz" "$doc/changelog.gz"
find "$tree" -type d -exec chmod 755 {} +
find "$tree" -type f ! -path '*/bin/*' -exec chmod 644 {} +

# dpkg-shlibdeps asks for a source package around it.
mkdir -p "$folder/debian" "$tree/DEBIAN"
printf 'Source: dotek\n\nPackage: dotek\nArchitecture: any\n' >"$folder/debian/control"
depends=$(cd "$folder" && dpkg-shlibdeps -O -etree/usr/bin/dotek 2>"$folder/log") || { cat "$folder/log" >&2; exit 1; }
size=$(find "$tree/usr" -type f -printf '%s\n' | awk '{ sum += int(($1 + 1023) / 1024) } END { print sum }')
(cd "$tree" && find usr -type f -print0 | sort -z | xargs -0 md5sum) >"$tree/DEBIAN/md5sums"
cat >"$tree/DEBIAN/control" <<TXT
Package: dotek
Version: $version
Architecture: $arch
Maintainer: The Dotek authors <dotek@localhost>
Installed-Size: $size
Depends: ${depends#shlibs:Depends=}
Section: devel
Priority: optional
Description: reads, runs, checks and translates programs of CNC probing
 Macro B, GibbsCAM custom drill cycles, ComPost posts, Mikroprog and parts of
 Fusion posts: findings before the spindle moves, a run on a virtual part,
 translations that are verified against their source, a language server.
TXT
find "$tree" -exec touch --no-dereference --date="@$SOURCE_DATE_EPOCH" {} +
file=$out/dotek_${version}_$arch.deb
dpkg-deb --root-owner-group -Zxz -z2 --build "$tree" "$file" >/dev/null
printf '%s\n' "$file"
