# Sourced by issue-2.sh: damaged inputs give a diagnostic, exit status 1 or 2, and no output.
# shellcheck shell=bash disable=SC2154

# damaged NAME: a fresh copy of a good folder, its path in $folder, and of the post, repaired, in $post.
damaged() {
  folder=$scratch/bad/$1/MERENI.OSA.X
  post=$scratch/bad/$1/post.txt
  mkdir -p "$scratch/bad/$1"
  cp -r "$cycles/MERENI.OSA.X" "$folder"
  sed '75i END' "$prog" >"$post"
}

# refusedPost WHAT: posts what was damaged.
refusedPost() {
  dotek post "$folder" --prog "$post" --routine defProbeCycle --seq 90:10 --clearance 5 --set X=10
  check "bad input, $1: refused" hasStatus 1 2
  check "bad input, $1: nothing written" printsNothing
  check "bad input, $1: a diagnostic" says "error:"
}

# foundByLint WHAT FILE: lint reports it, at the file.
foundByLint() {
  dotek lint "$folder"
  check "bad input, $1: lint" hasStatus 1 2
  check "bad input, $1: lint names the file" says "$2"
}

repeated() { head -c "$2" /dev/zero | tr '\0' "$1"; }

damaged good
dotek post "$folder" --prog "$post" --routine defProbeCycle --seq 90:10 --clearance 5 --set X=10
check "the repaired post needs no --recover" samePost MERENI.OSA.X

for file in DefineData.txt CycleData.dlg CycleData.mac ToolPath.mac; do
  damaged "missing-$file"
  rm "$folder/$file"
  foundByLint "$file is missing" "$file"
  damaged "utf16-$file"
  iconv -f UTF-8 -t UTF-16 "$cycles/MERENI.OSA.X/$file" >"$folder/$file"
  foundByLint "$file is UTF-16" "$file"
  damaged "nul-$file"
  printf '\0' >>"$folder/$file"
  foundByLint "$file holds a zero byte" "$file"
done
for file in DefineData.txt CycleData.dlg; do
  damaged "empty-$file"
  : >"$folder/$file"
  foundByLint "$file is empty" "$file"
done
damaged truncated
head -c -8 "$cycles/MERENI.OSA.X/CycleData.mac" | sed '$d' >"$folder/CycleData.mac"
printf 'if abs(' >>"$folder/CycleData.mac"
foundByLint "a statement is cut off" CycleData.mac
refusedPost "a statement is cut off"
damaged quotes
sed 's/"CycleData.dlg"/“CycleData.dlg”/' "$cycles/MERENI.OSA.X/CycleData.mac" >"$folder/CycleData.mac"
foundByLint "typographic quotes" CycleData.mac
refusedPost "typographic quotes"
damaged long-line
{ printf 'k = 1'; for _ in {1..100}; do repeated ' ' 10000; done; printf '\n'; } >>"$folder/CycleData.mac"
foundByLint "a line of 1 MB" CycleData.mac
damaged brackets
{ printf 'k = '; repeated '(' 100000; printf '1'; repeated ')' 100000; printf '\n'; } >>"$folder/CycleData.mac"
foundByLint "100,000 brackets" CycleData.mac
damaged include
printf '#INCLUDE "ToolPath.mac"\n' >>"$folder/ToolPath.mac"
foundByLint "an #INCLUDE of itself" ToolPath.mac
damaged for
printf 'for k = 1 to 3\n' >>"$folder/CycleData.mac"
foundByLint "a FOR without NEXT" CycleData.mac
damaged goto
printf 'goto nowhere\n' >>"$folder/CycleData.mac"
foundByLint "a GOTO to nowhere" CycleData.mac
damaged ok
sed -i '/^ok /d' "$folder/CycleData.dlg"
foundByLint "a dialog without OK" CycleData.dlg

damaged picture
sed -i "s/'###.##;0'/'##.;'/" "$post"
refusedPost "a picture with nothing after its point"
damaged digits
dotek post "$folder" --prog "$post" --routine defProbeCycle --seq 90:10 --clearance 5 --set X=12345
check "a value with more digits than its picture: refused" hasStatus 1
check "a value with more digits than its picture: nothing written" printsNothing
dotek post "$folder" --prog "$post" --routine defProbeCycle --seq 90:10 --clearance 5 --set X=10.126
check "a value that loses decimals: posted" hasStatus 0
check "a value that loses decimals: a warning with both values" says "warning:" 10.126 10.13
damaged post-quotes
sed -i "s/' M31'/‘ M31’/" "$post"
refusedPost "typographic quotes in the post"
damaged post-open
sed -i '0,/^RETURN/{/^RETURN/d}' "$post"
refusedPost "a routine without RETURN"
damaged post-empty
: >"$post"
refusedPost "an empty post"
damaged post-literal
sed -i "s/' (MERENI OSA X)' EOL/' (MERENI OSA X) EOL/" "$post"
refusedPost "an open literal"
damaged post-utf16
iconv -f UTF-8 -t UTF-16 "$prog" >"$post"
refusedPost "a post in UTF-16"
damaged post-binary
head -c 65536 "$DOTEK" >"$post"
refusedPost "a binary as the post"
